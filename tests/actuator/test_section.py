"""Section geometry and torque, Eq. (3.1) to (3.6), against integrals over the section."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from softgrip.actuator.section import (
    Section,
    chamber_area,
    check_section,
    torque,
    wall_area,
    wall_stress_ratio,
)
from softgrip.errors import InvalidInputError
from softgrip.units import MM, MPa

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)


@st.composite
def sections(draw):
    wall = draw(st.floats(0.5, 3.0))
    top = wall + draw(st.floats(0.5, 25.0))
    bottom = draw(st.floats(0.5, 8.0))
    width = 2 * wall + draw(st.floats(0.5, 40.0))
    return Section(top * MM, bottom * MM, width * MM, wall * MM)


def _integrals(section, pressure):
    """T_P and T_Pw of Eq. (3.5) and (3.6), by quadrature over y."""
    a, b, w, t = section.top, section.bottom, section.width, section.wall
    pull = (a - t) * (w - 2 * t) / (b * w + w * t + 2 * a * t - 2 * t**2) * pressure  # Eq. (3.3)

    def wall_width(y):
        return w if y < 0 or y > a - t else 2 * t

    pushed = quad(lambda y: y * pressure * (w - 2 * t), 0, a - t)[0]
    pulled = quad(lambda y: y * pull * wall_width(y), -b, a, points=[0, a - t])[0]
    return pushed, pulled


@given(sections())
def test_torque_is_the_difference_of_the_two_integrals(section):
    """Eq. (3.4): moments, Eq. (3.2), by quadrature, of chamber and wall, Eq. (3.5) and (3.6)."""
    pushed, pulled = _integrals(section, 1e5)
    # The difference may be far smaller than its terms: the tolerance is of these.
    assert torque(section, 1e5) == pytest.approx(pushed - pulled, abs=1e-9 * (pushed + abs(pulled)))


@given(sections())
def test_wall_tension_balances_the_pressure(section):
    """Eq. (3.1): the force on the chamber's end is that of the wall."""
    pull = wall_stress_ratio(section)
    assert pull * wall_area(section) == pytest.approx(chamber_area(section), rel=1e-12)
    whole = section.width * section.height
    solid = whole - chamber_area(section)
    assert wall_area(section) == pytest.approx(solid, rel=1e-12)


def test_wall_tension_of_design_1_by_hand():
    """Eq. (3.3): bottom, two sides and top of the wall, as four rectangles in mm."""
    wall = 4 * 30 + 2 * 1.5 * 18.5 + 1.5 * 30
    assert wall_stress_ratio(DESIGN_1) == pytest.approx(18.5 * 27 / wall, rel=1e-12)


def test_up_to_half_a_newton_metre_at_a_quarter_megapascal():
    assert torque(DESIGN_1, 0.25 * MPa) == pytest.approx(0.50969, abs=1e-5)


def test_other_readings_of_the_signs_do_not_give_the_printed_half_newton_metre():
    pushed, pulled = _integrals(DESIGN_1, 0.25 * MPa)
    assert pushed + pulled == pytest.approx(1.80, abs=0.005)
    assert pushed == pytest.approx(1.155, abs=0.005)


@given(sections())
def test_torque_is_positive_if_and_only_if_the_bottom_is_thicker_than_the_wall(section):
    found = torque(section, 1e5)
    assert np.sign(found) == np.sign(section.bottom - section.wall)


def test_laws_take_arrays_and_symbols():
    a = np.array([20.0, 21.0]) * MM
    found = torque(Section(a, 4 * MM, 30 * MM, 1.5 * MM), 1e5)
    assert found.shape == (2,)
    x = ca.SX.sym("a")
    symbol = torque(Section(x, 4 * MM, 30 * MM, 1.5 * MM), 1e5)
    assert float(ca.Function("T", [x], [symbol])(a[1])) == pytest.approx(found[1], rel=1e-14)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"wall": -1 * MM}, "wall: expected a finite length > 0"),
        ({"wall": 15 * MM}, "less than half the width"),
        ({"bottom": 0.0}, "bottom"),
        ({"top": 1 * MM}, "less than the height above neutral"),
        ({"width": np.nan}, "width"),
    ],
)
def test_dimensions_that_form_no_chamber_are_refused(changed, message):
    with pytest.raises(InvalidInputError, match=message):
        check_section(Section(**{**vars(DESIGN_1), **changed}))
