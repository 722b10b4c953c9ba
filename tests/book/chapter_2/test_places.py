"""Errors of place and angle on the ideal pad: what must be exact, and what cannot be."""

import numpy as np
import pytest

from book.chapter_2.places import ideal_responses, place_errors
from softgrip.logs.contacts import read_contacts
from softgrip.provenance import data_file
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import angle_between, line_angle, place
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.units import DEG, MM


def errors_of(name):
    return place_errors(read_contacts(data_file(f"simulated/pad-{name}.csv").path), PAD)


@pytest.mark.parametrize("k", range(8))
def test_ball_on_an_element_is_found_there(k):
    felt = ideal_responses("ball 20 mm", Pose(tuple(PAD.places[k])), 0.1)
    np.testing.assert_allclose(place(felt, PAD), PAD.places[k], atol=1e-9)


@pytest.mark.parametrize(("x", "y", "degrees"), [(0, 10, 0), (0, 0, 0), (0, -10, 0), (0, 0, 90)])
def test_rod_over_a_row_or_the_middle_is_found_with_its_angle(x, y, degrees):
    felt = ideal_responses("rod 20 mm", Pose((x * MM, y * MM), degrees * DEG), 0.2)
    assert angle_between(line_angle(felt, PAD), degrees * DEG) < 0.1 * DEG


def test_errors_are_by_hand():
    felt = np.zeros((3, 8))
    felt[0, 1], felt[1, [1, 6]] = 0.5, 0.5  # (0, 10) mm; the y axis
    found = place_errors(
        Contacts(
            felt, ["point", "line", "surface"], ["a", "b", "c"],
            [[3e-3, 6e-3], [4e-3, 1e-3], [0, 0]], [np.nan, np.pi / 2, np.nan], [0.1, 0.1, 0.1],
        ),
        PAD,
    )  # fmt: skip
    # A 3-4-5 triangle; a line along y that is 4 mm off; nothing felt.
    np.testing.assert_allclose(found.place, [5e-3, 4e-3, np.nan], atol=1e-12)
    np.testing.assert_allclose(found.angle, [np.nan, 0, np.nan], atol=1e-12)
    assert found.elements.tolist() == [1, 2, 0]


def test_point_in_the_log_is_found_within_an_elements_pitch():
    """A contact that one element feels is at most about half a pitch away from it."""
    log = read_contacts(data_file("simulated/pad-training.csv").path)
    off = errors_of("training").place[log.kinds == "point"]
    assert np.median(off) < 11 * MM / 2
    # Better than the middle of the pad, whatever is felt: the centroid tells something.
    blind = np.hypot(*log.places[log.kinds == "point"].T)
    assert np.median(off) < np.median(blind) / 2


def test_line_in_the_log_has_its_angle_better_than_a_guess():
    """A guess is off by 45 degrees in the median."""
    angle = errors_of("training").angle
    told = angle[np.isfinite(angle)]
    assert told.size > 150
    assert np.median(told) < 15 * DEG
