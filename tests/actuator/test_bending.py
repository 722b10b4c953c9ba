"""Bending of the free finger, Eq. (3.7) to (3.10)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from softgrip.actuator.bending import (
    Finger,
    bending_angle,
    elongation,
    free_bending,
    modified_moment,
)
from softgrip.actuator.section import Section, torque
from softgrip.errors import InvalidInputError
from softgrip.units import DEG, MM, MPa

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)


@given(st.floats(1, 3), st.floats(0.01, 0.1), st.floats(0.005, 0.05), st.floats(0.1, 50))
def test_modified_moment_is_the_moment_of_ludwicks_stress(n, width, height, curvature):
    """Eq. (3.8): stress ``(kappa y)**n`` over a rectangle, about its middle, by quadrature."""
    half = height / 2
    moment = 2 * width * quad(lambda y: y * (curvature * y) ** n, 0, half)[0]
    assert moment == pytest.approx(modified_moment(n, width, height) * curvature**n, rel=1e-8)


def test_modified_moment_at_n_1_is_that_of_a_rectangle():
    assert modified_moment(1.0, 0.03, 0.024) == pytest.approx(0.03 * 0.024**3 / 12, rel=1e-15)


def test_bending_at_n_1_is_half_of_a_beam_under_a_constant_moment():
    """Eq. (3.7) takes the torque as that of a force at the tip: n / (n + 1) of T L / (E I)."""
    finger = Finger(DESIGN_1)
    beam = torque(DESIGN_1, 1e4) * finger.length / (0.34 * MPa * modified_moment(1, 0.03, 0.024))
    assert bending_angle(finger, 1e4, elongated=False) == pytest.approx(beam / 2, rel=1e-14)


def test_elongation_balances_the_pull_of_the_end():
    """Eq. (3.9): a bar of the wall's area stretches by ``P A_c / (A_w E)``, here 0.9994."""
    assert elongation(DESIGN_1, 0.15 * MPa, 0.34 * MPa) - 1 == pytest.approx(
        0.15 / 0.34 * 499.5 / 220.5, rel=1e-12
    )


@given(st.floats(1, 3), st.floats(1e3, 2e5))
def test_bending_is_the_curvature_summed_along_the_longer_finger(n, pressure):
    """Eq. (3.10): a force T / L at the tip, whose lever falls from L to 0, by quadrature."""
    moment, stiffness = torque(DESIGN_1, pressure), 0.34 * MPa * modified_moment(n, 0.03, 0.024)
    longer = 94 * MM * (1 + pressure * 499.5 / 220.5 / (0.34 * MPa))
    angle = longer * quad(lambda s: (moment * (1 - s) / stiffness) ** (1 / n), 0, 1)[0]
    found = bending_angle(Finger(DESIGN_1, fractional_power=n), pressure)
    # The curvature falls to 0 with an infinite slope, which costs the quadrature digits.
    assert found == pytest.approx(angle, rel=1e-6)


@given(st.floats(1, 3), st.floats(1e3, 2e5), st.floats(1.001, 10))
def test_more_pressure_bends_further(n, pressure, factor):
    angles = free_bending(Finger(DESIGN_1, fractional_power=n), [pressure, factor * pressure])
    assert angles[1] > angles[0]


def test_no_one_power_gives_the_printed_angle_sum_and_frequency():
    """290 deg, 2.36 and 2.62 rad/s of one finger: each asks for another n."""
    from scipy.optimize import brentq

    from softgrip.actuator.design import DesignProblem, objective
    from softgrip.actuator.frequency import natural_frequency

    def finger(n):
        return Finger(DESIGN_1, fractional_power=n)

    angle = brentq(lambda n: bending_angle(finger(n), 0.15 * MPa) - 290 * DEG, 1, 3)
    total = brentq(lambda n: objective(DesignProblem(fractional_power=n), DESIGN_1) - 2.36, 1, 3)
    frequency = brentq(lambda n: natural_frequency(finger(n), 0.35) - 2.62, 1, 3)
    assert (angle, total, frequency) == pytest.approx((1.56, 2.08, 1.05), abs=0.02)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: Finger(DESIGN_1, length=0.0), "length"),
        (lambda: Finger(DESIGN_1, young_modulus=-1.0), "young_modulus"),
        (lambda: Finger(DESIGN_1, fractional_power=0.9), "fractional_power"),
        (lambda: free_bending(Finger(DESIGN_1), -1.0), "pressure"),
        (lambda: free_bending(Finger(DESIGN_1), np.inf), "pressure"),
        (lambda: free_bending(Finger(Section(0.02, 0.001, 0.03, 0.0015)), 1e5), "bottom"),
        (lambda: free_bending(Finger(Section(0.02, 0.004, 0.03, 0.016)), 1e5), "wall"),
    ],
)
def test_what_has_no_angle_is_refused(call, name):
    with pytest.raises(InvalidInputError, match=f"^{name}: expected"):
        call()
