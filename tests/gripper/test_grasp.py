"""Contact of an arc with a disc: geometry by brute force, energy, symmetry."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.gripper.grasp import DiscBetweenFingers, ElasticDisc, touch
from softgrip.units import MM

LENGTH, DEPTH = 0.1, 0.075
DISC = ElasticDisc(200.0)

angles = st.floats(0.01, 2.0)
places = st.floats(0.0, 0.06)


def nearest(angle, ahead):
    """Return the least distance from the disc's centre to 20,001 points of the arc."""
    turned = np.linspace(0, angle, 20_001)
    radius = LENGTH / angle
    arc = radius * np.array([1 - np.cos(turned), np.sin(turned)])
    return np.hypot(arc[0] - ahead, arc[1] - DEPTH).min()


@given(angles, places)
def test_dent_is_that_of_the_nearest_point(angle, ahead):
    found = touch(angle, ahead, DEPTH, LENGTH, DISC)
    # Points are 5 micrometres apart: a distance of a millimetre is missed by 3 nanometres.
    expected = max(DISC.radius - nearest(angle, ahead), 0.0)
    assert float(found.dent) == pytest.approx(expected, abs=3e-6)


@given(angles, places)
def test_torque_and_force_are_the_slopes_of_the_energy(angle, ahead):
    def energy(a, x):
        return DISC.stiffness * touch(a, x, DEPTH, LENGTH, DISC).dent ** 2 / 2

    # An arc through the centre has no direction to push in.
    assume(nearest(angle, ahead) > 1 * MM)
    found, h = touch(angle, ahead, DEPTH, LENGTH, DISC), 1e-6
    by_angle = (energy(angle + h, ahead) - energy(angle - h, ahead)) / (2 * h)
    by_place = (energy(angle, ahead + h) - energy(angle, ahead - h)) / (2 * h)
    assert float(found.torque) == pytest.approx(-by_angle, abs=2e-5)
    assert float(found.sideways) == pytest.approx(-by_place, abs=1e-3)


def test_a_straight_finger_is_a_line():
    near = touch(0.0, 0.015, DEPTH, LENGTH, DISC)
    assert float(near.dent) == pytest.approx(5 * MM, rel=1e-3)
    # Of a cantilever that starts to bend, the point at depth y moves by y^2 / (2 L) a radian.
    assert float(near.torque) == pytest.approx(-near.sideways * DEPTH**2 / (2 * LENGTH), rel=1e-3)


def test_equal_fingers_leave_the_disc_in_the_middle_and_a_finger_alone_pushes_it():
    contact = DiscBetweenFingers(DISC)
    own, slope = np.zeros((2, 3)), np.empty((2, 3))
    torque = contact.slopes(np.array([[0.3, 0.8, 0.8], [0.3, 0.8, 0.2]]), own, slope)
    assert (torque[:, 0] == 0).all()
    assert torque[0, 1] == torque[1, 1] < 0
    assert (slope[1, :2] == 0).all()
    assert slope[1, 2] > 0
    assert torque[1, 2] == 0


def test_moving_disc_is_braked_by_its_weight_times_friction():
    contact = DiscBetweenFingers(DISC)
    slope = np.empty((2, 1))
    contact.slopes(np.zeros((2, 1)), np.array([[0.0], [1.0]]), slope)
    assert slope[:, 0] == pytest.approx([1.0, -DISC.friction * 9.80665], rel=1e-4)


@pytest.mark.parametrize("settings", [{"stiffness": 0.0}, {"stiffness": 1.0, "mass": -1.0}])
def test_bad_discs_are_refused(settings):
    with pytest.raises(InvalidInputError):
        ElasticDisc(**settings)
