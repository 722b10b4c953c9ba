"""Eq. (4.5), (4.6) and (4.7)."""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from softgrip.errors import InvalidInputError
from softgrip.pump.flow import PARAMETER_SETS, TABLE_4_1, Pump, flow
from softgrip.pump.gas import ATMOSPHERE, capacity, closed_volume_pressure
from softgrip.pump.pressure import (
    modified_capacity,
    modified_pressure,
    modified_pressure_rate,
    pressure,
    pressure_rate,
    pressure_system,
)

C = 1e-9
TIME = np.linspace(0, 6, 31)
factors = st.floats(0.1, 10)


@given(a=factors, b=factors, w=factors)
def test_rate_is_proportional_to_area_lead_and_speed(a, b, w):
    """Eq. (4.5): and 8.7252 mL/s into 1 mL/kPa is 8.7252 kPa/s."""
    run = PARAMETER_SETS["default"]
    scaled = flow(w * run.motor_speed, Pump(a * run.pump.area, b * run.pump.lead))
    assert pressure_rate(scaled, C) == pytest.approx(a * b * w * 8725.2)


@given(factor=factors)
def test_small_lead_on_large_area_does_as_large_lead_on_small_area(factor):
    (area, _), (lead, _), (speed, _) = TABLE_4_1.values()
    exchanged = flow(speed, Pump(area * factor, lead / factor))
    assert exchanged == pytest.approx(flow(speed, Pump(area, lead)))


@pytest.mark.parametrize(
    ("name", "factor"),
    [("larger area", 6.61 / 16.62), ("smaller lead", 4.0), ("higher speed", 0.5)],
)
def test_time_to_a_pressure_follows_table_4_1(name, factor):
    """A quarter of the lead takes four times as long: it does not shorten the response."""
    times = [0.1e6 / pressure_rate(PARAMETER_SETS[n].flow, C) for n in ("default", name)]
    assert times[1] / times[0] == pytest.approx(factor)


def test_pressure_is_the_step_response_of_the_state_space():
    run = PARAMETER_SETS["default"]
    response = control.forced_response(
        pressure_system(run.pump, C), TIME, np.full(TIME.size, run.motor_speed), squeeze=False
    )
    np.testing.assert_allclose(response.outputs[0], pressure(TIME, run.flow, C), rtol=1e-9)


def test_state_space_is_eq_4_6():
    pump = PARAMETER_SETS["default"].pump
    system = pressure_system(pump, C)
    s = 0.3 + 2j
    assert system(s) == pytest.approx(pump.area * pump.lead / (2 * np.pi * C) / s)
    assert (system.input_labels, system.output_labels) == (["motor_speed"], ["pressure"])


@pytest.mark.parametrize("growth", [-8e-6, 1e-7, 8e-6])
def test_closed_form_integrates_eq_4_7(growth):
    args = (PARAMETER_SETS["default"].flow, C, growth)
    area, _ = quad(modified_pressure_rate, 0, 6, args=args, epsrel=1e-12)
    assert modified_pressure(6.0, *args) == pytest.approx(area, rel=1e-10)
    path = solve_ivp(lambda t, P: [modified_pressure_rate(t, *args)], (0, 6), [0], rtol=1e-9)
    assert path.y[0, -1] == pytest.approx(area, rel=1e-6)


def test_growth_to_zero_is_the_constant_capacity():
    Q = PARAMETER_SETS["default"].flow
    np.testing.assert_array_equal(modified_pressure(TIME, Q, C, 0.0), pressure(TIME, Q, C))
    # next term of the logarithm: relative error c Q t / (2 C) <= 3e-8
    np.testing.assert_allclose(
        modified_pressure(TIME, Q, C, 1e-12), pressure(TIME, Q, C), rtol=4e-8
    )


@given(c=st.floats(1e-8, 1e-4), t=st.floats(0.1, 20))
def test_growing_capacity_slows_the_rise(c, t):
    Q = PARAMETER_SETS["default"].flow
    assert modified_pressure(t, Q, C, c) < pressure(t, Q, C)


def test_both_models_start_on_the_exact_curve_of_a_rigid_volume_and_leave_it():
    """With C = V/P and c = -2/P of the start, Eq. (4.7) has the second derivative too."""
    V, Q = 100e-6, 1e-6
    C0 = capacity(ATMOSPHERE, V)
    errors = []
    for t in (1.0, 2.0):
        exact = closed_volume_pressure(Q * t, V) - ATMOSPHERE
        errors.append(
            (exact - pressure(t, Q, C0), exact - modified_pressure(t, Q, C0, -2 / ATMOSPHERE))
        )
    orders = np.log2(np.abs(np.array(errors[1]) / np.array(errors[0])))
    # Errors of second and of third order in time; a tenth is what the next orders leave.
    assert orders == pytest.approx([2.0, 3.0], abs=0.1)


def test_capacity_must_stay_above_zero():
    assert modified_capacity(4.0, 1e-6, 1e-9, -2e-4) == pytest.approx(2e-10)
    with pytest.raises(InvalidInputError, match="at all times"):
        modified_pressure(np.array([0.0, 6.0]), 1e-6, 1e-9, -2e-4)


@pytest.mark.parametrize("bad", [0.0, -1e-9, float("nan"), np.array([1e-9, 0])])
def test_bad_capacity_is_refused(bad):
    with pytest.raises(InvalidInputError, match="capacity"):
        pressure_rate(1e-6, bad)
