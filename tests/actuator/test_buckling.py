"""The buckling pressure: by definition, in the linear limit, against three printed facts."""

from math import pi

import pytest
from scipy.optimize import brentq

from softgrip.actuator.bending import Finger
from softgrip.actuator.buckling import buckling_pressure, buckling_pressures
from softgrip.actuator.section import Section, chamber_area, wall_stress_ratio
from softgrip.materials import ludwick
from softgrip.materials.table import material
from softgrip.units import MM, MPa

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)


def finger(name, length=94 * MM, section=DESIGN_1):
    rubber = material(name)
    return Finger(section, length, rubber.young_modulus, rubber.fractional_power)


def test_a_linear_finger_is_a_column_of_euler():
    """By hand: I = 30 * 24**3 / 12 mm^4, A_c = 18.5 * 27 mm^2, half of 94 mm."""
    load = pi**2 * 0.34 * MPa * 30 * 24**3 / 12 * MM**4 / (47 * MM) ** 2
    expected = load / (18.5 * 27 * MM**2)
    assert buckling_pressure(Finger(DESIGN_1)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", ["Dragon Skin 20", "Ecoflex 00-10"])
def test_it_is_where_push_and_column_are_equal(name):
    """The tangent modulus by a difference of Ludwick's law, the pressure by a root."""
    made = finger(name, section=Section(15 * MM, 3 * MM, 12 * MM, 1.5 * MM))
    E, n = made.young_modulus, made.fractional_power

    def excess(pressure):
        strain = (wall_stress_ratio(made.section) * pressure / E) ** (1 / n)
        step = 1e-6 * strain
        rise = ludwick.stress(strain + step, E, n) - ludwick.stress(strain - step, E, n)
        moment = 18 * MM * (12 * MM) ** 3 / 12  # it buckles aside: narrower than high
        resists = pi**2 * rise / (2 * step) * moment / (0.5 * made.length) ** 2
        return pressure * chamber_area(made.section) / resists - 1

    found = buckling_pressure(made)
    assert found == buckling_pressures(made)[1]
    assert found == pytest.approx(brentq(excess, found / 9, found * 9, xtol=1e-9), rel=1e-6)


def test_three_printed_facts():
    """Section 3.4: Design 3 buckles between 0.1 and 0.25 MPa, Design 1 not up to 0.25 MPa."""
    assert 0.1 * MPa < buckling_pressure(finger("Dragon Skin FX Pro")) < 0.25 * MPa
    assert buckling_pressure(finger("Dragon Skin 20")) > 0.25 * MPa


@pytest.mark.parametrize("end_factor", [0.7, 1.0, 2.0])
def test_other_ends_are_refuted_by_design_1(end_factor):
    assert buckling_pressure(finger("Dragon Skin 20"), end_factor) < 0.25 * MPa


def test_longer_is_worse_by_a_power():
    n = material("Dragon Skin 20").fractional_power
    ratio = buckling_pressure(finger("Dragon Skin 20")) / buckling_pressure(
        finger("Dragon Skin 20", 188 * MM)
    )
    assert ratio == pytest.approx(2 ** (2 * n), rel=1e-12)
