"""Natural frequency, Eq. (3.14) to (3.19)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from softgrip.actuator.bending import Finger
from softgrip.actuator.frequency import (
    natural_frequency,
    rubber_mass,
    spring_constant,
    stiffness_product,
    stiffness_product_for,
)
from softgrip.actuator.printed import FREQUENCY_POWER, WEIGHT_POWER
from softgrip.actuator.section import Section

DESIGN_1 = Section(0.02, 0.004, 0.03, 0.0015)


def test_spring_at_n_1_is_that_of_a_tip_loaded_cantilever():
    """Eq. (3.14) at n = 1: ``theta = F L**2 / (2 E I)`` of the textbook."""
    inertia = 0.03 * 0.024**3 / 12
    assert spring_constant(Finger(DESIGN_1)) == pytest.approx(
        2 * 0.34e6 * inertia / 0.094**2, rel=1e-14
    )


def test_a_finger_let_go_swings_at_its_natural_frequency():
    """Eq. (3.15) at n = 1, integrated until the finger is straight: a quarter of a period."""
    inertia, mass = 0.03 * 0.024**3 / 12, 0.35
    stiffness = 2 * 0.34e6 * inertia / 0.094**2

    def straight(_t, state):
        return state[0]

    straight.terminal = True
    swing = solve_ivp(
        lambda _t, state: [state[1], -stiffness / mass * state[0]],
        *((0, 2), [0.5, 0.0]),
        events=straight,
        rtol=1e-10,
        atol=1e-12,
    )
    quarter = swing.t_events[0][0]
    assert natural_frequency(Finger(DESIGN_1), mass) == pytest.approx(np.pi / 2 / quarter, rel=1e-8)


@given(st.floats(1, 3), st.floats(0.5, 2), st.floats(0.5, 2))
def test_squared_frequency_goes_with_the_powers_of_its_factors(n, factor, scale):
    """Eq. (3.18): as E, w, 1 / M, the height to n + 2 and the length to -(n + 1)."""

    def squared(modulus=1.0, width=1.0, height=1.0, mass=1.0, length=1.0):
        section = Section(0.02 * height, 0.004 * height, 0.03 * width, 0.0015)
        finger = Finger(section, 0.094 * length, 0.34e6 * modulus, n)
        return natural_frequency(finger, 0.35 * mass) ** 2

    base = squared()
    assert squared(modulus=factor, mass=scale) / base == pytest.approx(factor / scale)
    assert squared(width=factor, height=scale) / base == pytest.approx(factor * scale ** (n + 2))
    assert squared(length=factor) / base == pytest.approx(factor ** -(n + 1))


@given(st.floats(1, 3), st.floats(0.01, 1.0), st.floats(0.012, 0.025), st.floats(0.01, 0.04))
def test_band_of_eq_3_19_is_the_frequency_of_eq_3_16(n, mass, top, width):
    section = Section(top, 0.004, width, 0.0015)
    finger = Finger(section, fractional_power=n)
    found = stiffness_product_for(natural_frequency(finger, mass), mass, n, finger.length)
    assert found == pytest.approx(stiffness_product(section, finger.young_modulus, n), rel=1e-12)


def test_table_3_3_comes_out_with_kilograms_and_one_power_or_newtons_and_another():
    """0.35 N is 36 g; the 2.62 rad/s alone cannot tell which M was meant."""
    as_mass = natural_frequency(Finger(DESIGN_1, fractional_power=FREQUENCY_POWER), 0.35)
    as_weight = natural_frequency(Finger(DESIGN_1, fractional_power=WEIGHT_POWER), 0.35 / 9.80665)
    assert [as_mass, as_weight] == pytest.approx([2.62, 2.62], abs=0.005)


def test_rubber_alone_weighs_less_than_the_printed_weight():
    """Volume by hand: (720 - 499.5) mm^2 times 94 mm is 20.7 mL; 0.35 N would be 35.7 g."""
    assert rubber_mass(DESIGN_1, 0.094, 1080.0) == pytest.approx(1080 * 20.727e-6, rel=1e-4)
