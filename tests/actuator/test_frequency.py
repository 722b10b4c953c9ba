"""Natural frequency, Eq. (3.14) to (3.19)."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.actuator.bending import Finger
from softgrip.actuator.frequency import (
    natural_frequency,
    rubber_mass,
    spring_constant,
    stiffness_product,
    stiffness_product_for,
)
from softgrip.actuator.section import Section

DESIGN_1 = Section(0.02, 0.004, 0.03, 0.0015)


def test_spring_at_n_1_is_that_of_a_tip_loaded_cantilever():
    """``theta = F L**2 / (2 E I)`` of the textbook."""
    inertia = 0.03 * 0.024**3 / 12
    assert spring_constant(Finger(DESIGN_1)) == pytest.approx(
        2 * 0.34e6 * inertia / 0.094**2, rel=1e-14
    )


@given(st.floats(1, 3), st.floats(0.01, 1.0), st.floats(0.012, 0.025), st.floats(0.01, 0.04))
def test_band_of_eq_3_19_is_the_frequency_of_eq_3_16(n, mass, top, width):
    section = Section(top, 0.004, width, 0.0015)
    finger = Finger(section, fractional_power=n)
    found = stiffness_product_for(natural_frequency(finger, mass), mass, n, finger.length)
    assert found == pytest.approx(stiffness_product(section, finger.young_modulus, n), rel=1e-12)


def test_table_3_3_asks_for_the_weight_in_newtons_as_kilograms():
    """0.35 N is 36 g: with it the frequency is three times the printed 2.62 rad/s."""
    finger = Finger(DESIGN_1, fractional_power=1.05)
    as_mass = natural_frequency(finger, 0.35)
    as_weight = natural_frequency(finger, 0.35 / 9.80665)
    assert as_mass == pytest.approx(2.61, abs=0.005)
    assert as_weight / as_mass == pytest.approx(9.80665**0.5, rel=1e-12)


def test_rubber_alone_weighs_less_than_the_printed_weight():
    """Volume by hand: (720 - 499.5) mm^2 times 94 mm is 20.7 mL; 0.35 N would be 35.7 g."""
    assert rubber_mass(DESIGN_1, 0.094, 1080.0) == pytest.approx(1080 * 20.727e-6, rel=1e-4)
