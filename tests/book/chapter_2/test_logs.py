"""The two simulated logs of the pad, and what reading one refuses."""

import numpy as np
import pytest

from book.chapter_2.logs import TRAINING, contacts, errors
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.contacts import read_contacts
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_COLUMNS, LogHeader
from softgrip.provenance import Provenance, data_file
from softgrip.simulator.pad import to_volts
from softgrip.simulator.pad_hand import FORCES
from softgrip.simulator.pad_objects import FOODS
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_tests import PAD_TESTS
from softgrip.units import DEG, MM

OBJECTS = data_file("simulated/pad-objects.csv").path


@pytest.mark.parametrize("name", PAD_TESTS)
def test_log_says_its_set_up_and_its_counts_give_its_voltages(name):
    log = read_log(data_file(f"simulated/{name}.csv").path)
    assert (log.header.set_up, log.repairs) == ("pad", ())
    assert list(log.columns)[: len(PAD_COLUMNS)] == list(PAD_COLUMNS)
    counts = log["element_3_counts"].astype(int)
    np.testing.assert_allclose(to_volts(counts, PadParameters()), log["element_3"])


def test_training_has_as_many_contacts_as_printed():
    """Section 2.3: 630 responses."""
    log = contacts(TRAINING)
    assert len(log) == 630
    objects, times = np.unique(log.objects, return_counts=True)
    assert (objects.size, set(times.tolist())) == (21, {30})
    assert (log.forces >= FORCES[0]).all()
    assert (log.forces <= FORCES[1]).all()


def test_each_food_is_touched_ten_times():
    """Section 2.4: eight foods, ten times each; egg and tomato points, sponge and tofu surfaces."""
    log = read_contacts(OBJECTS)
    for food in FOODS:
        chosen = log.objects == food.name
        assert (chosen.sum(), set(log.kinds[chosen].tolist())) == (10, {food.kind})
    kinds = [(log.kinds == kind).sum() for kind in ("point", "line", "surface")]
    assert kinds == [20, 40, 20]


def test_header_says_a_set_up_that_is_not_the_grippers():
    common = (Provenance.LOGGED, "a rig", "board", 0.1)
    assert "set_up" not in LogHeader(*common).lines()
    assert LogHeader(*common, set_up="pad").lines()["set_up"] == "pad"
    with pytest.raises(InvalidInputError, match="set_up"):
        LogHeader(*common, set_up="hand")


FOODS_FIRST = f"{FOODS[0].kind}: {FOODS[0].name}"
"""Event of the first contact."""


def changed(tmp_path, old, new, count=-1):
    path = tmp_path / "log.csv"
    text = OBJECTS.read_text()
    assert old in text
    path.write_text(text.replace(old, new, count))
    return path


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("# set_up: pad\n", "", "the columns time, command, pressure_counts"),
        ("# set_up: pad", "# set_up: hand", "set_up"),
        ("element_8_counts [count]", "element_9_counts [count]", "element_8_counts"),
        ("contact_angle [rad]", "contact_slope [rad]", "contact_angle"),
        ("press: element 4", "pressed", "element 4"),
        (",rest\n", ",\n", "rest"),
        ("surface: tofu", "surface tofu", None),
    ],
)
def test_log_that_is_not_right_is_refused(tmp_path, old, new, message):
    path = changed(tmp_path, old, new)
    if message is None:
        # Words that are no contact are no contact.
        assert len(read_contacts(path)) == 70
        return
    with pytest.raises(DataFileError, match=message):
        read_contacts(path)


def with_counts(tmp_path, counts, rows):
    """Write the log with other counts of element 1 in some rows of contacts, and read it."""
    lines = OBJECTS.read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.endswith(FOODS_FIRST))
    for row in rows:
        cells = lines[first + row].split(",")
        lines[first + row] = ",".join([*cells[:2], counts, *cells[3:]])
    path = tmp_path / "log.csv"
    path.write_text("\n".join(lines) + "\n")
    return read_contacts(path)


@pytest.mark.parametrize(
    ("counts", "rows", "message"),
    [
        ("0", [5], "element_1_counts between 1 and 1023, got 0 at .* s: saturated, or a broken"),
        ("nan", [5], "a finite number under element_1_counts"),
        ("1023", range(9), "1023 in 8 of 80 contacts or less, got in 9: saturated"),
    ],
)
def test_channel_that_tells_nothing_is_refused(tmp_path, counts, rows, message):
    with pytest.raises(DataFileError, match=message):
        with_counts(tmp_path, counts, rows)


def test_contact_may_bring_an_element_to_the_end_of_the_converter(tmp_path):
    assert len(with_counts(tmp_path, "1023", range(8))) == 80


def test_element_at_the_end_of_the_converter_responds_with_one():
    log = read_log(data_file(TRAINING).path)
    rows = np.flatnonzero([":" in words and "press" not in words for _, words in log.events])
    counts = np.stack([log[f"element_{k + 1}_counts"][rows] for k in range(8)], axis=1)
    assert (counts == 1023).any()
    assert (contacts(TRAINING).responses[counts == 1023] == 1).all()


def test_dead_element_is_named(tmp_path):
    line = next(row for row in OBJECTS.read_text().splitlines() if row.endswith("element 2"))
    cells = line.split(",")
    rest = next(row for row in OBJECTS.read_text().splitlines() if row.endswith(",rest"))
    cells[12] = rest.split(",")[12]
    path = changed(tmp_path, line, ",".join(cells))
    with pytest.raises(DataFileError, match="element_2 to rise"):
        read_contacts(path)


def test_log_of_the_gripper_is_no_log_of_the_pad():
    with pytest.raises(DataFileError, match="set-up pad"):
        read_contacts(data_file("simulated/step-60-1.csv").path)


def test_point_in_the_log_is_found_within_an_elements_pitch():
    """A contact that one element feels is at most about half a pitch away from it."""
    log = contacts(TRAINING)
    off = errors(TRAINING).place[log.kinds == "point"]
    assert np.median(off) < 11 * MM / 2
    # Better than the middle of the pad, whatever is felt: the centroid tells something.
    blind = np.hypot(*log.places[log.kinds == "point"].T)
    assert np.median(off) < np.median(blind) / 2


def test_line_in_the_log_has_its_angle_better_than_a_guess():
    """A guess is off by 45 degrees in the median."""
    angle = errors(TRAINING).angle
    told = angle[np.isfinite(angle)]
    assert told.size > 150
    assert np.median(told) < 15 * DEG
