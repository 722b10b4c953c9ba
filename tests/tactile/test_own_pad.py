"""A reader's CSV is read as it stands, or refused with the line that is wrong."""

import numpy as np
import pytest

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import data_file
from softgrip.tactile.own_pad import PadReadings, read_readings
from softgrip.units import GRAM_FORCE

GOOD = "# my pad\ne1,e2,kind\n0.1,0.2,point\n0.3,0.4, line\n"


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / "mine.csv"
        path.write_text(text)
        return path

    return write


def test_columns_are_found_by_name(file):
    found = read_readings(file(GOOD), label="kind")
    assert found.channels == ("e1", "e2")
    assert found.voltages.tolist() == [[0.1, 0.2], [0.3, 0.4]]
    assert found.labels.tolist() == ["point", "line"]


def test_channels_can_be_chosen_in_another_order(file):
    text = "time,e2,kind,e1\n0,0.2,point,0.1\n"
    found = read_readings(file(text), label="kind", channels=("e1", "e2"))
    assert found.voltages.tolist() == [[0.1, 0.2]]


def test_weights_become_newtons(file):
    found = read_readings(file("v,weight\n1.5,70\n0.2,0\n"), label="weight", unit=GRAM_FORCE)
    assert found.labels == pytest.approx([0.6864655, 0.0])  # 70 gf


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "column names, then rows"),
        ("e1,kind\n", "column names, then rows"),
        (GOOD.replace("kind", "what"), "line 2: expected a column 'kind', got 'e1', 'e2', 'what'"),
        (GOOD.replace("point", ""), "line 3: expected a label under kind, got an empty cell"),
        (GOOD.replace("e1", "e1 [s]"), "line 2: expected e1 as a voltage: V, mV, uV, kV, got 's'"),
        (GOOD.replace("0.3", "0,3"), "line 4: expected 3 cells, got 4"),
        (GOOD.replace("0.3,0.4", "0.3"), "line 4: expected 3 cells, got 2"),
        (GOOD.replace("0.4", "nan"), "line 4: expected a finite number under e2, got 'nan'"),
        (GOOD.replace("0.1", "high"), "line 3: expected a finite number under e1, got 'high'"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(file, text, message):
    with pytest.raises(DataFileError, match=message):
        read_readings(file(text), label="kind")


def test_weight_that_is_no_number_is_refused(file):
    with pytest.raises(DataFileError, match="line 2: expected a finite number under weight"):
        read_readings(file("v,weight\n1.5,heavy\n"), label="weight", unit=GRAM_FORCE)


def test_no_file_is_refused(tmp_path):
    with pytest.raises(DataFileError, match="expected a file"):
        read_readings(tmp_path / "none.csv", label="kind")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"channels": ("e1", "e1")}, "different names"),
        ({"channels": ("e1",)}, "voltages"),
        ({"labels": ["point"]}, "labels"),
        ({"labels": [np.nan, 1.0]}, "NaN"),
        ({"voltages": [[0.1, np.inf], [0.3, 0.4]]}, "NaN"),
        ({"voltages": np.empty((0, 2)), "labels": []}, "N > 0"),
    ],
)
def test_readings_that_do_not_fit_together_are_refused(change, message):
    given = {
        "channels": ("e1", "e2"),
        "voltages": [[0.1, 0.2], [0.3, 0.4]],
        "labels": ["point", "line"],
    }
    with pytest.raises(InvalidInputError, match=message):
        PadReadings(**given | change)


def test_log_of_the_rig_is_refused_with_what_reads_it():
    with pytest.raises(DataFileError, match=r"a column 'kind'.*read by softgrip\.logs\.contacts"):
        read_readings(data_file("simulated/pad-objects.csv").path, label="kind")


@pytest.mark.parametrize("given", [[0, 1], np.array([0, 5], dtype=np.uint8), [0, 1.5]])
def test_whole_numbers_are_forces(given):
    found = PadReadings(("e",), [[0.1], [0.2]], given).labels
    assert found.dtype == np.float64
    assert found.tolist() == [float(x) for x in given]


def test_strings_of_a_table_of_objects_are_kinds():
    kinds = np.array(["point", "line"], dtype=object)
    assert PadReadings(("e",), [[0.1], [0.2]], kinds).labels.tolist() == ["point", "line"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([True, False], "kinds as strings, or forces as numbers, got .True"),
        ([1j, 2j], "got .1j"),
        (["point", " "], "a kind each, got 'an empty one'"),
    ],
)
def test_labels_that_are_neither_kinds_nor_forces_are_refused(given, message):
    with pytest.raises(InvalidInputError, match=message):
        PadReadings(("e",), [[0.1], [0.2]], given)


def test_groups_go_with_their_readings():
    mine = PadReadings(("e",), [[0.1], [0.2], [0.3]], [1, 2, 3], [7, 7, 8])
    assert mine.groups.tolist() == ["7", "7", "8"]
    assert mine.take([2, 0]).groups.tolist() == ["8", "7"]
    with pytest.raises(InvalidInputError, match="groups"):
        PadReadings(("e",), [[0.1], [0.2]], [1, 2], [7])


def test_group_that_is_no_column_is_refused(file):
    with pytest.raises(DataFileError, match="a column 'press'"):
        read_readings(file(GOOD), label="kind", group="press")


@pytest.mark.parametrize(
    "text",
    [
        "e1, e2, kind\n0.1, 0.2, point\n0.3, 0.4, line\n",
        "\ufeffe1;e2;kind\r\n0,1;0,2;point\r\n0,3;0,4;line\r\n",
        'e1\te2\tkind\n"0.1"\t"0.2"\t"point"\n"0.3"\t"0.4"\t"line"\n',
        "e1 [mV],e2 (V),kind\n100,0.2,point\n300,0.4,line\n",
        "e1,e2,kind\n(mV),(V),\n100,0.2,point\n300,0.4,line\n",
    ],
)
def test_readings_saved_by_other_programs_are_the_same(file, text):
    found = read_readings(file(text), label="kind")
    assert found.channels == ("e1", "e2")
    assert found.voltages == pytest.approx(np.array([[0.1, 0.2], [0.3, 0.4]]))
    assert found.labels.tolist() == ["point", "line"]


def test_a_label_with_a_unit_is_a_force(file):
    text = "v,weight [gf]\n1.5,70\n0.2,0\n"
    for unit in (None, GRAM_FORCE):
        found = read_readings(file(text), label="weight", unit=unit)
        assert found.labels == pytest.approx([0.6864655, 0.0])
    for wrong, words in ((1e-3, "in units of 0.001 N"), (None, "a force: N, mN")):
        with pytest.raises(DataFileError, match=words):
            read_readings(
                file(text if wrong else text.replace("gf", "g")), label="weight", unit=wrong
            )


def kinds(column, name="e0", rows=12):
    """Return readings with noise in two channels, and one more column."""
    noise = np.random.default_rng(1).normal(2, 0.2, (rows, 2)).round(3)
    lines = [f"{column(k)},{a},{b},{'pl'[k % 2]}" for k, (a, b) in enumerate(noise)]
    return "\n".join([f"{name},e1,e2,kind", *lines, ""])


@pytest.mark.parametrize(
    ("column", "name", "words"),
    [
        (lambda k: 0.025 * k, "e0", "e0: it rises by 0.025 from row to row"),
        (lambda k: 17.5 * 10**9 + k**2, "when", "when: it never falls"),
        (lambda k: 3.3, "supply", "supply: it is 3.3 throughout"),
        (lambda k: k % 4, "Time", "Time: its name"),
        (lambda k: k, "", ": its name"),  # as pandas saves its index
    ],
)
def test_columns_that_are_no_channels_are_refused_unless_named(file, column, name, words):
    with pytest.raises(DataFileError, match=f"name all: channels=.*{words}"):
        read_readings(file(kinds(column, name)), label="kind")
    assert read_readings(file(kinds(column, name)), label="kind", channels=("e1", "e2")).channels
    if name:
        found = read_readings(file(kinds(column, name)), label="kind", channels=(name, "e1"))
        assert found.channels == (name, "e1")


def test_a_channel_may_rise_with_weights_that_are_laid_on_in_their_order(file):
    text = "v,weight\n" + "".join(f"{0.01 * k**2:.2f},{5 * k}\n" for k in range(1, 12))
    found = read_readings(file(text), label="weight", unit=GRAM_FORCE)
    assert found.voltages[:, 0].tolist() == pytest.approx([0.01 * k**2 for k in range(1, 12)])
