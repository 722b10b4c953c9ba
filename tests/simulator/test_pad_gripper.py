"""The simulated gripper: its contacts against formulas, its servo against an integrator."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from softgrip.errors import InvalidInputError
from softgrip.simulator.pad import make_pad, press
from softgrip.simulator.pad_contact import bed_points, force_at_depth, spring_stiffness
from softgrip.simulator.pad_gripper import (
    GraspGripper,
    pad_side,
    plain_side,
    servo_position,
    squeeze,
)
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose, gap
from softgrip.tactile.element import compliance
from softgrip.units import MM

GRIPPER, IDEAL = GraspGripper(), make_pad(PadParameters())
MIDDLE = Pose((0.0, 0.0))
DEPTH = np.array([0.5, 1.0, 2.0]) * MM


def test_level_block_presses_eight_elements_in_parallel():
    """By hand: each is a pyramid in series with the 25 springs of its square."""
    item, own = pad_object("tofu"), IDEAL.parameters
    soft = compliance(own.element, own.young_modulus)
    one = 1 / (soft + 1 / (25 * spring_stiffness(own, item.softness)))
    np.testing.assert_allclose(pad_side(IDEAL, item, MIDDLE, DEPTH), 8 * one * DEPTH, rtol=1e-9)


def test_elements_of_the_pad_are_all_as_deep_as_the_object():
    """`press` shares a force among the elements; each share asks for the depth of the whole."""
    item, pose = pad_object("egg"), Pose((0.0, 2 * MM))
    pad = make_pad(PadParameters(), 2024)
    depth = np.linspace(0, 3, 3001) * MM
    whole = np.interp(0.3, pad_side(pad, item, pose, depth), depth)
    gaps = gap(item, pose, bed_points(pad.parameters)) - pad.height[:, None]
    ordered = np.sort(gaps - gaps.min(), axis=-1)
    shares = press(pad, item, pose, 0.3)
    k = np.full(depth.size, spring_stiffness(pad.parameters, item.softness))
    for share, own, soft in zip(shares, ordered, pad.compliance, strict=True):
        if share > 0.01:
            alone = force_at_depth(depth, np.tile(own, (depth.size, 1)), k, 0 * k + soft)
            assert np.interp(share, alone, depth) == pytest.approx(whole, abs=2e-6)
    assert (shares > 0.01).sum() >= 2


@pytest.mark.parametrize("name", ["egg", "cherry tomato"])
def test_plain_rubber_under_a_ball_is_a_mattress(name):
    """A paraboloid on a mattress: pi s sqrt(R1 R2) depth^2, s its stiffness by area."""
    item = pad_object(name)
    depth = np.array([0.5, 0.8]) * MM
    s = 1 / (GRIPPER.plain_thickness / GRIPPER.plain_modulus + item.softness)
    want = np.pi * s * np.sqrt(item.radii[0] * item.radii[1]) * depth**2
    # Cells of 1 mm under a dent of 7 to 13 mm across; the sphere is steeper than that.
    np.testing.assert_allclose(plain_side(GRIPPER, item, MIDDLE, depth), want, rtol=0.06)


@pytest.mark.parametrize("name", ["egg", "tofu", "small carrot"])
def test_both_sides_bear_the_same_force(name):
    item = pad_object(name)
    found = squeeze(IDEAL, item, MIDDLE, GRIPPER)
    depth = np.linspace(0, 4, 4001) * MM
    sides = (pad_side(IDEAL, item, MIDDLE, depth), plain_side(GRIPPER, item, MIDDLE, depth))
    closing = sum(np.interp(0.08, side, depth) for side in sides)
    assert found.at(np.array(closing)) == pytest.approx(0.08, rel=2e-3)
    assert found.at(np.array(-1 * MM)) == 0
    assert (np.diff(found.closing) > 0).all()


def test_tofu_is_far_softer_than_egg_and_carrot():
    egg, tofu, carrot = (
        squeeze(IDEAL, pad_object(n), MIDDLE, GRIPPER).stiffness(0.08)
        for n in ("egg", "tofu", "small carrot")
    )
    assert 3 * tofu < min(egg, carrot)


@pytest.mark.parametrize("start", [-0.01, 0.0, 0.0199, 0.05])
@pytest.mark.parametrize("time", [0.0, 0.025, 0.3])
def test_servo_is_a_lag_with_a_speed_limit(start, time):
    def speed(_, position):
        return np.clip((0.02 - position) / GRIPPER.lag, -GRIPPER.speed, GRIPPER.speed)

    want = start
    if time:
        want = solve_ivp(speed, (0, time), [start], rtol=1e-9, atol=1e-12, max_step=1e-3).y[0, -1]
    found = servo_position(np.array([start]), np.array([0.02]), time, GRIPPER)[0]
    assert found == pytest.approx(want, abs=1e-8)


@pytest.mark.parametrize("name", ["lag", "speed", "resolution"])
def test_gripper_that_cannot_be_is_refused(name):
    with pytest.raises(InvalidInputError, match=name):
        replace(GRIPPER, **{name: 0.0})
    with pytest.raises(InvalidInputError, match="opening"):
        replace(GRIPPER, opening=-1 * MM)
