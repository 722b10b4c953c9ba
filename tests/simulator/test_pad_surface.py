"""Surfaces of objects over the pad: circles, turns, edges and roughness."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.simulator.pad_objects import FOODS, OTHERS, pad_object
from softgrip.simulator.pad_surface import Pose, gap, rise, roughness
from softgrip.units import DEG, MM

POINTS = np.random.default_rng(0).uniform(-8, 8, (200, 2)) * MM


def test_rise_is_the_circle():
    x = np.linspace(-5, 5, 101) * MM
    # A point of the circle is one radius from its middle.
    height = rise(x, 5 * MM)
    np.testing.assert_allclose(x**2 + (5 * MM - height) ** 2, (5 * MM) ** 2, rtol=1e-12)
    assert np.isinf(rise(np.array([5.1 * MM]), 5 * MM)).all()
    assert (rise(x, np.inf) == 0).all()


def test_ball_is_the_same_at_any_angle_and_close_to_a_sphere():
    ball = pad_object("ball 40 mm")
    one, other = (gap(ball, Pose((0.0, 0.0), angle), POINTS) for angle in (0.0, 1.0))
    r = np.hypot(*POINTS.T)
    sphere = 20 * MM - np.sqrt((20 * MM) ** 2 - r**2)
    # Two circles added leave out u^2 v^2 / (4 R^3): at most 8^4 / (4 20^3) = 0.13 mm here.
    np.testing.assert_allclose(one, sphere, atol=0.2 * MM)
    np.testing.assert_allclose(one, other, atol=0.2 * MM)


def test_rod_is_level_along_itself_and_ends():
    rod, pose = pad_object("rod 10 mm"), Pose((1 * MM, 2 * MM), 30 * DEG)
    along = np.array([np.cos(pose.angle), np.sin(pose.angle)])
    on = np.array(pose.place) + np.array([-24, 0, 24])[:, None] * MM * along
    np.testing.assert_allclose(gap(rod, pose, on), 0, atol=1e-15)
    beyond = np.array(pose.place) + 26 * MM * along
    assert np.isinf(gap(rod, pose, beyond))


def test_tilt_raises_one_end():
    pose = Pose((0.0, 0.0), 90 * DEG, (0.02, 0.0))
    found = gap(pad_object("rod 10 mm"), pose, np.array([[0, 10 * MM], [0, -10 * MM]]))
    assert found == pytest.approx([0.2 * MM, -0.2 * MM])


def test_roughness_has_the_deviation_that_is_asked_for():
    chance = np.random.default_rng(3)
    u, v = POINTS.T
    drawn = [roughness(u, v, 0.3 * MM, chance) for _ in range(200)]
    # 200 surfaces of 12 waves: the deviation is known to about 2 %.
    assert np.std(drawn) == pytest.approx(0.3 * MM, rel=0.05)


def test_rough_object_is_a_smooth_one_and_its_roughness():
    rod, pose, on = pad_object("rod 10 mm"), Pose((0.0, 0.0), 0.0), POINTS * [1.0, 0.5]
    rough = gap(replace(rod, roughness=0.1 * MM), pose, on, np.random.default_rng(1))
    alone = roughness(*on.T, 0.1 * MM, np.random.default_rng(1))
    np.testing.assert_allclose(rough, gap(rod, pose, on) + alone, atol=1e-12)


def test_seven_objects_of_each_kind():
    kinds = [item.kind for item in (*FOODS, *OTHERS)]
    assert {kind: kinds.count(kind) for kind in kinds} == {"point": 7, "line": 7, "surface": 7}
