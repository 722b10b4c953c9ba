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
        ("", "column names and readings"),
        ("e1,kind\n", "column names and readings"),
        (GOOD.replace("kind", "what"), "line 2: expected columns kind, got e1, e2, what"),
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
    with pytest.raises(DataFileError, match=r"columns kind.*read by softgrip\.logs\.contacts"):
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
        ([True, False], "kinds as strings, or forces as numbers, got 'bool'"),
        ([1j, 2j], "got 'complex128'"),
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
    with pytest.raises(DataFileError, match="expected columns press"):
        read_readings(file(GOOD), label="kind", group="press")
