"""Eq. (4.1), (4.2) and Table 4.1."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.pump.flow import PARAMETER_SETS, TABLE_4_1, Pump, flow, parameter_set, slider_speed
from softgrip.units import REV

positive = st.floats(1e-6, 1e3)


@given(lead=positive)
def test_one_turn_moves_the_slider_by_the_lead(lead):
    """Eq. (4.1)."""
    assert slider_speed(2 * pi, lead) == pytest.approx(lead)


@given(area=st.floats(1e-6, 0.1), lead=st.floats(1e-4, 0.2), speed=st.floats(-100, 100))
def test_flow_is_area_times_slider_speed(area, lead, speed):
    pump = Pump(area, lead)
    assert flow(speed, pump) == pytest.approx(area * slider_speed(speed, lead))
    assert flow(speed, pump) == pytest.approx(pump.displacement * speed)


def test_flow_of_a_batch_is_that_of_its_runs():
    speeds = np.linspace(-10, 10, 7).reshape(7, 1)
    pump = Pump(6.61e-4, 0.008)
    np.testing.assert_array_equal(flow(speeds, pump)[:, 0], [flow(w, pump) for w in speeds[:, 0]])


def test_table_4_1_ratios():
    ratios = {name: second / first for name, (first, second) in TABLE_4_1.items()}
    assert ratios["area"] == pytest.approx(16.62 / 6.61)
    assert (ratios["lead"], ratios["motor_speed"]) == pytest.approx((1 / 4, 2))


def test_each_set_of_fig_4_3_changes_one_parameter_of_the_default():
    default = PARAMETER_SETS["default"].flow
    relative = {name: run.flow / default for name, run in PARAMETER_SETS.items()}
    assert relative == pytest.approx(
        {
            "default": 1.0,
            "larger area": 16.62 / 6.61,
            "smaller lead": 0.25,
            "higher speed": 2.0,
            "optimal": 2 * 16.62 / 6.61,
        }
    )


def test_default_flow_in_litres_by_hand():
    """Eq. (4.2): 1.65 turns of 8 mm a second over 6.61 cm^2."""
    assert PARAMETER_SETS["default"].flow == pytest.approx(1.65 * 0.8 * 6.61 * 1e-6)
    assert PARAMETER_SETS["default"].motor_speed == pytest.approx(1.65 * REV)


def test_unknown_set_lists_the_known_ones():
    with pytest.raises(UnknownNameError, match="smaller lead"):
        parameter_set("best")


@pytest.mark.parametrize(("area", "lead"), [(0, 1), (1, -1), (float("nan"), 1), (1, float("inf"))])
def test_bad_pump_is_refused(area, lead):
    with pytest.raises(InvalidInputError, match="expected a finite number"):
        Pump(area, lead)


@pytest.mark.parametrize(
    ("area", "lead", "meant"),
    [
        (661, 0.008, r"661: probably mm\^2 \(0\.000661 m\^2\)"),
        (6.61, 0.008, r"6\.61: probably cm\^2 \(0\.000661 m\^2\) or mm\^2"),
        (6.61e-4, 8, r"8: probably mm \(0\.008 m\) or cm \(0\.08 m\)"),
    ],
)
def test_pump_in_other_units_is_refused_with_what_was_meant(area, lead, meant):
    with pytest.raises(InvalidInputError, match=meant):
        Pump(area, lead)


def test_pump_may_be_given_with_its_units():
    found = Pump("6.61 cm^2", "8 mm")
    assert (found.area, found.lead) == pytest.approx((6.61e-4, 8e-3))
    with pytest.raises(InvalidInputError, match=r"area: expected an area: m.2, .*got 'mm'"):
        Pump("6.61 mm", "8 mm")
