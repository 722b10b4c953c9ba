"""The two simulated logs of the pad, and what reading one refuses."""

import numpy as np
import pytest

from book.chapter_2.logs import PAD_TESTS, TRAINING, contacts, errors
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.contacts import read_contacts
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_COLUMNS, LogHeader
from softgrip.provenance import Provenance, data_file
from softgrip.simulator.pad import to_volts
from softgrip.simulator.pad_hand import FORCES
from softgrip.simulator.pad_objects import FOODS
from softgrip.simulator.pad_parameters import PadParameters
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


def changed(tmp_path, old, new, count=-1):
    path = tmp_path / "log.csv"
    text = OBJECTS.read_text()
    assert old in text
    path.write_text(text.replace(old, new, count))
    return path


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("# set_up: pad\n", "", "command in rad/s, got N"),
        ("# set_up: pad", "# set_up: hand", "set_up"),
        ("element_8_counts [count]", "element_9_counts [count]", "element_8_counts"),
        ("contact_angle [rad]", "contact_slope [rad]", "contact_angle"),
        ("press: element 4", "pressed", "element 4"),
        (",rest\n", ",\n", "rest"),
        ("\n100.0,0.233,514,", "\n100.0,0.233,1023,", "element_1_counts.*1023 at 100 s: saturated"),
        ("\n100.0,0.233,514,", "\n100.0,0.233,nan,", "finite numbers"),
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
