"""Eq. (3.13) against the cantilever at any rotation."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

from softgrip.actuator.bending import Finger, bending_angle, modified_moment
from softgrip.actuator.cantilever import (
    angle_limit,
    bend,
    closed_form_error,
    constant_moment_angle,
    load_number,
    tip_force_angle,
)
from softgrip.actuator.section import Section, torque
from softgrip.errors import InvalidInputError

DESIGN_1 = Finger(Section(0.020, 0.004, 0.030, 0.0015))
powers = st.floats(1.0, 3.0)


def finger_of(n):
    return replace(DESIGN_1, fractional_power=n)


def stiffness(finger):
    n, section = finger.fractional_power, finger.section
    return finger.young_modulus * modified_moment(n, section.width, section.height)


def force_of(load, finger):
    return load * stiffness(finger) / finger.length ** (finger.fractional_power + 1)


def elastica(tip_angle):
    """Load number and tip of the linear cantilever, Bisshopp and Drucker (1945)."""
    k2 = (1 + np.sin(tip_angle)) / 2
    start = np.arcsin(1 / np.sqrt(2 * k2))
    root = ellipk(k2) - ellipkinc(start, k2)
    down = 1 - 2 * (ellipe(k2) - ellipeinc(start, k2)) / root
    return root**2, np.sqrt(2 * np.sin(tip_angle)) / root, down


# F L^2 / (E I), 1 - x/L, y/L, theta: Mattiasson (1981), elliptic integrals to five decimals.
MATTIASSON = [
    (1, 0.05643, 0.30172, 0.46135),
    (2, 0.16064, 0.49346, 0.78175),
    (5, 0.38763, 0.71379, 1.21537),
    (10, 0.55500, 0.81061, 1.43029),
]


@pytest.mark.parametrize(("load", "shortening", "deflection", "angle"), MATTIASSON)
def test_linear_cantilever_against_the_published_table(load, shortening, deflection, angle):
    shape = bend(DESIGN_1, force=force_of(load, DESIGN_1))
    x, y = np.array(shape.tip) / DESIGN_1.length
    # Half a unit of the fifth decimal.
    assert [1 - x, y, shape.tip_angle] == pytest.approx([shortening, deflection, angle], abs=5.1e-6)


@given(tip_angle=st.floats(0.02, 1.5))
@settings(max_examples=30)
def test_linear_cantilever_against_elliptic_integrals(tip_angle):
    load, x, y = elastica(tip_angle)
    assert load_number(tip_angle, 1.0) == pytest.approx(load, rel=1e-9)
    shape = bend(DESIGN_1, force=force_of(load, DESIGN_1))
    assert shape.tip_angle == pytest.approx(tip_angle, rel=1e-7)
    assert shape.tip == pytest.approx((x * DESIGN_1.length, y * DESIGN_1.length), rel=1e-7)


@given(n=powers, tip_angle=st.floats(0.02, 1.5), follower=st.booleans())
@settings(max_examples=60)
def test_boundary_value_problem_agrees_with_the_quadrature(n, tip_angle, follower):
    tip_angle *= 1.95 if follower else 1.0
    load = load_number(tip_angle, n, follower=follower)
    shape = bend(finger_of(n), force=force_of(load, finger_of(n)), follower=follower)
    assert shape.tip_angle == pytest.approx(tip_angle, rel=1e-7)


@given(n=powers, load=st.floats(0.01, 10.0), end=st.floats(0.0, 1.5))
@settings(max_examples=30)
def test_moment_is_that_of_the_lever_arm_everywhere(n, load, end):
    finger = finger_of(n)
    force = force_of(load, finger)
    moment = stiffness(finger) * (end / finger.length) ** n
    shape = bend(finger, force=force, moment=moment)
    # Rounding can leave the free end bent back by 1e-17.
    inside = stiffness(finger) * np.sign(shape.curvature) * np.abs(shape.curvature) ** n
    outside = force * (shape.tip[0] - shape.x) + moment
    np.testing.assert_allclose(inside, outside, atol=1e-6 * outside.max())


@given(n=powers, angle=st.floats(0.01, 5.0))
@settings(max_examples=30)
def test_tip_moment_bends_an_arc(n, angle):
    finger = finger_of(n)
    moment = stiffness(finger) * (angle / finger.length) ** n
    assert constant_moment_angle(finger, moment) == pytest.approx(angle)
    shape = bend(finger, moment=moment)
    assert shape.tip_angle == pytest.approx(angle, rel=1e-8)
    radius = finger.length / angle
    arc = radius * np.sin(shape.angle), radius * (1 - np.cos(shape.angle))
    np.testing.assert_allclose((shape.x, shape.y), arc, atol=1e-8 * finger.length)


@given(n=powers, tip_angle=st.floats(1e-3, 0.05))
def test_error_begins_as_the_series_by_hand(n, tip_angle):
    dead = (1 - n / (2 * n + 1) + n / (9 * n + 6)) / (2 * n)
    follower = 1 / (18 * n + 12)
    # The next term is of the fourth order: below 1 % of the first up to 0.05 rad.
    assert closed_form_error(tip_angle, n) == pytest.approx(dead * tip_angle**2, rel=0.01)
    found = closed_form_error(tip_angle, n, follower=True)
    assert found == pytest.approx(follower * tip_angle**2, rel=0.01)


def test_linear_error_begins_with_eleven_thirtieths():
    # theta'' = -a cos(theta) to the third order in a: theta_tip = a/2 - 11 a^3 / 240.
    a = 0.05
    assert bend(DESIGN_1, force=force_of(a, DESIGN_1)).tip_angle == pytest.approx(
        a / 2 - 11 * a**3 / 240, rel=1e-6
    )
    assert closed_form_error(a / 2, 1.0) == pytest.approx(11 / 30 * (a / 2) ** 2, rel=1e-3)


@pytest.mark.parametrize("n", [1.0, 1.05, 1.538, 2.0, 2.5])
def test_small_loads_bend_as_the_closed_form(n):
    """Eq. (3.13) is the limit of the solved shape: its error falls with the angle squared."""
    finger = finger_of(n)
    errors = []
    for angle in (0.4, 0.1, 0.025):
        force = force_of(angle**n, finger)
        errors.append(tip_force_angle(finger, force) / bend(finger, force=force).tip_angle - 1)
    assert 0 < errors[2] < errors[1] < errors[0]
    # A quarter of the angle, a sixteenth of the error.
    assert errors[1] / errors[2] == pytest.approx(16, rel=0.01)


@given(n=powers, angle=st.floats(0.05, 1.4))
def test_closed_form_always_says_too_much_and_more_for_a_dead_load(n, angle):
    assert closed_form_error(angle, n) > closed_form_error(angle, n, follower=True) > 0
    assert closed_form_error(angle * 1.05, n) > closed_form_error(angle, n)


@pytest.mark.parametrize("follower", [False, True])
@pytest.mark.parametrize("error", [0.05, 0.10])
@pytest.mark.parametrize("n", [1.0, 1.05, 1.538, 2.0, 2.5])
def test_limit_is_where_the_solved_shape_is_off_by_so_much(n, error, follower):
    finger, limit = finger_of(n), angle_limit(error, n, follower=follower)
    force = force_of(load_number(limit, n, follower=follower), finger)
    solved = bend(finger, force=force, follower=follower).tip_angle
    assert tip_force_angle(finger, force) / solved - 1 == pytest.approx(error, abs=1e-6)


def test_linear_closed_form_holds_to_21_and_29_degrees():
    # Without the series: the roots of a/2 / theta(a) - 1 by elliptic integrals.
    for error, degrees in ((0.05, 20.71), (0.10, 28.69)):
        limit = angle_limit(error, 1.0)
        assert np.degrees(limit) == pytest.approx(degrees, abs=0.005)
        assert elastica(limit)[0] / 2 / limit - 1 == pytest.approx(error, abs=1e-8)


@given(n=powers)
def test_pressure_model_has_the_angle_of_a_tip_force(n):
    # Eq. (3.7) puts the angle of F = T / L where a constant moment T acts.
    finger, pressure = finger_of(n), 0.1e6
    moment = torque(finger.section, pressure)
    printed = bending_angle(finger, pressure, elongated=False)
    assert printed == pytest.approx(tip_force_angle(finger, moment / finger.length))
    assert printed / constant_moment_angle(finger, moment) == pytest.approx(n / (n + 1))


def test_no_load_leaves_it_straight():
    shape = bend(DESIGN_1)
    assert shape.tip == pytest.approx((DESIGN_1.length, 0.0))
    assert not shape.angle.any()


def test_shape_runs_from_the_base_to_the_tip():
    shape = bend(finger_of(2.0), force=0.3)
    assert shape.arc_length[[0, -1]] == pytest.approx([0, DESIGN_1.length])
    assert (np.diff(shape.arc_length) > 0).all()
    ends = [shape.angle[0], shape.x[0], shape.y[0], shape.curvature[-1]]
    assert ends == pytest.approx([0, 0, 0, 0], abs=1e-9)


@pytest.mark.parametrize(
    "call",
    [
        lambda: bend(DESIGN_1, force=-1.0),
        lambda: bend(DESIGN_1, moment=np.inf),
        lambda: bend(DESIGN_1, force=1e9),
        lambda: load_number(np.pi / 2, 1.0),
        lambda: load_number(3.2, 1.0, follower=True),
        lambda: load_number(-0.1, 1.0),
        lambda: load_number(0.5, 0.9),
        lambda: closed_form_error(np.nan, 1.0),
        lambda: angle_limit(0.0, 1.0),
        lambda: angle_limit(np.inf, 1.0),
    ],
)
def test_loads_angles_powers_and_errors_out_of_range_are_refused(call):
    with pytest.raises(InvalidInputError, match="expected"):
        call()
