"""Eq. (5.9)-(5.11) and (5.17)."""

import numpy as np
import pytest
from scipy.integrate import quad

from softgrip.dynamics import linear
from softgrip.dynamics.ludwick import LudwickFinger, acceleration, pressure_response
from softgrip.dynamics.second_order import response
from softgrip.errors import InvalidInputError


def test_moment_is_the_integral_over_the_section():
    """Eq. (5.11) by quadrature."""
    integral, _ = quad(lambda y: 0.03 * y**2, -0.012, 0.012)
    assert linear.moment_of_inertia(0.03, 0.024) == pytest.approx(integral, rel=1e-12)


def test_spring_is_that_of_a_cantilever_with_a_force_at_its_tip():
    """Eq. (5.9) with the spring of Eq. (5.10): theta = F L**2 / (2 E I), any textbook."""
    E, b, h, L, F = 0.34e6, 0.030, 0.024, 0.094, 0.7
    angle = F * L**2 / (2 * E * b * h**3 / 12)
    assert linear.force(angle, linear.spring_constant(E, b, h, L)) == pytest.approx(F)


def test_both_forms_of_the_linear_model_move_alike():
    """Eq. (5.17): exact between the samples on one side, Runge-Kutta on the other."""
    finger = linear.linear_finger(0.04, 0.11, 0.1)
    time = np.linspace(0, 6, 241)
    pressure = 7e3 * np.minimum(1, time / 0.3)
    found = pressure_response(finger, time, pressure, force_per_pressure=1.5e-5)
    exact = response(linear.second_order(finger, 1.5e-5), time, pressure)
    np.testing.assert_allclose(found, exact, atol=1e-6)


def test_damping_ratio_and_frequency_leave_the_equation_of_motion_as_it_is():
    """Eq. (3.12) at n = 1: its left side is the force by mass in any state of motion."""
    mass, force = 0.04, 0.2
    finger = linear.linear_finger(mass, 0.11, 0.1)
    found = linear.second_order(finger, 1e-5)
    w, z = found.natural_frequency, found.damping_ratio
    for angle, rate in np.random.default_rng(0).normal(size=(5, 2)):
        left = acceleration(finger, angle, rate, force) + 2 * z * w * rate + w**2 * angle
        assert left == pytest.approx(force / mass)


def test_nonlinear_finger_is_refused():
    with pytest.raises(InvalidInputError, match="power of 1"):
        linear.second_order(LudwickFinger(1.0, 1.0, 1.0, 2.0), 1.0)
