"""How a force is shared among the elements: a quadratic program, symmetries and limits."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, nnls

from softgrip.errors import InvalidInputError
from softgrip.simulator.pad import make_pad, press
from softgrip.simulator.pad_contact import bed_points, element_forces, spring_stiffness
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose, gap
from softgrip.units import DEG, MM

IDEAL = make_pad(PadParameters())


def by_least_energy(gaps, k, c, force):
    """Share a force by the least energy of springs that only push, in series with elements."""
    elements, springs = gaps.shape
    inside = np.isfinite(gaps).ravel()
    owner = np.repeat(np.eye(elements), springs, axis=0)[inside]
    stiff = np.sqrt(1 / k)
    # The energy is |A f - b|^2 / 2 but for a constant, with A'A the compliance of all springs.
    matrix = np.vstack([stiff * np.eye(inside.sum()), np.sqrt(c)[:, None] * owner.T])

    def pushed(depth):
        right = np.append((depth - gaps.ravel()[inside]) / stiff, np.zeros(elements))
        return nnls(matrix, right)[0] @ owner

    low, high = gaps.min(), gaps[np.isfinite(gaps)].max() + 0.1
    depth = brentq(lambda d: pushed(d).sum() - force, low, high, xtol=1e-12)
    return pushed(depth)


@pytest.mark.parametrize(("name", "angle"), [("egg", 0), ("small carrot", 35), ("melon cube", 10)])
def test_share_is_that_of_least_energy(name, angle):
    item, pose = pad_object(name), Pose((2 * MM, 1 * MM), angle * DEG, (0.01, 0.0))
    gaps = gap(item, pose, bed_points(IDEAL.parameters), np.random.default_rng(1))
    k = spring_stiffness(IDEAL.parameters, item.softness)
    found = element_forces(gaps[None], np.array([k]), IDEAL.compliance, np.array([0.2]))[0]
    # The tolerance of the roots: 1e-9 m by the 180 N/m of an element is 2e-7 N.
    np.testing.assert_allclose(found, by_least_energy(gaps, k, IDEAL.compliance, 0.2), atol=1e-6)
    assert (found > 0).sum() >= 2


@settings(max_examples=50)
@given(
    name=st.sampled_from(["egg", "walnut", "small carrot", "tofu", "block 30 mm"]),
    x=st.floats(-10, 10), angle=st.floats(-90, 90), force=st.floats(0.01, 0.5),
)  # fmt: skip
def test_elements_bear_the_whole_force_and_none_pulls(name, x, angle, force):
    pad = make_pad(PadParameters(), seed=5)
    pose = Pose((x * MM, 0.0), angle * DEG)
    found = press(pad, pad_object(name), pose, force, np.random.default_rng(2))
    assert (found >= 0).all()
    assert found.sum() == pytest.approx(force, rel=1e-6)


def test_level_block_is_borne_by_all_alike():
    found = press(IDEAL, pad_object("block 40 mm"), Pose((0.0, 0.0)), 0.24)
    np.testing.assert_allclose(found, 0.03, rtol=1e-6)


def test_small_ball_on_an_element_is_borne_by_it_alone():
    place = tuple(IDEAL.parameters.layout.places[3])
    found = press(IDEAL, pad_object("blueberry"), Pose(place), 0.1)
    assert found == pytest.approx(0.1 * np.eye(8)[3], abs=1e-9)


def test_mirrored_contact_gives_the_mirrored_share():
    one = press(IDEAL, pad_object("small carrot"), Pose((3 * MM, 1 * MM), 20 * DEG), 0.15)
    other = press(IDEAL, pad_object("small carrot"), Pose((-3 * MM, 1 * MM), -20 * DEG), 0.15)
    np.testing.assert_allclose(other, one[[2, 1, 0, 4, 3, 7, 6, 5]], atol=1e-8)


def test_soft_object_is_shared_more_evenly_than_a_hard_one():
    ball = pad_object("ball 40 mm")
    soft = replace(ball, young_modulus=20e3, depth=10 * MM)
    hard_share, soft_share = (
        press(IDEAL, item, Pose((0.0, 3 * MM)), 0.2).max() for item in (ball, soft)
    )
    assert soft_share < hard_share


def test_object_beside_the_elements_and_negative_force_are_refused():
    with pytest.raises(InvalidInputError, match="meet an element"):
        press(IDEAL, pad_object("blueberry"), Pose((0.1, 0.0)), 0.1)
    with pytest.raises(InvalidInputError, match="force"):
        press(IDEAL, pad_object("egg"), Pose((0.0, 0.0)), -0.1)
