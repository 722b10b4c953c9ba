"""The two designs of Section 4.3, and the two ways from a pressure to a motor speed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.designs import actuator_design, full_design, linear_loop, unit_step
from softgrip.control.loop import SPEED_LIMIT, run_loop
from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed, PressureByPlunger
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.step_metrics import final_value
from softgrip.dynamics.second_order import SecondOrder, full_state_space, state_space, step_response
from softgrip.errors import InvalidInputError
from softgrip.units import DEG
from tests.control.test_loop import Constant

FINGER = SecondOrder(1.65, 0.86, 1.5e-4)
PUMP_GAIN = 978.0


def test_unit_step_is_the_closed_form_response():
    time, angle = unit_step(state_space(FINGER))
    np.testing.assert_allclose(angle, 1.5e-4 * step_response(time, 1.65, 0.86), atol=1e-12)


def test_full_model_starts_from_the_rule_in_closed_form():
    # The ramp of Eq. (4.15): L = 2 zeta / omega_n, R = gain * pump_gain, kp = 1.2 / (R L).
    start = full_design(FINGER, PUMP_GAIN, evaluations=1).tuned.start
    delay = 2 * 0.86 / 1.65
    # 1e-2: after ten time constants the response is not quite on its ramp.
    assert start.kp == pytest.approx(1.2 / (1.5e-4 * PUMP_GAIN * delay), rel=1e-2)
    assert start.ki == pytest.approx(start.kp / (2 * delay), rel=1e-2)
    assert start.kd == pytest.approx(start.kp * delay / 2, rel=1e-2)


def test_actuator_model_starts_from_its_tangent_at_the_inflexion():
    start = actuator_design(FINGER, evaluations=1).tuned.start
    time = np.linspace(0, 10, 200001)
    angle = 1.5e-4 * step_response(time, 1.65, 0.86)
    slopes = np.gradient(angle, time)
    at = np.argmax(slopes)
    delay = time[at] - angle[at] / slopes[at]
    assert start.kp == pytest.approx(1.2 / (slopes[at] * delay), rel=1e-2)


@pytest.mark.parametrize("pump_gain", [None, PUMP_GAIN])
def test_tuning_improves_on_the_rule_within_the_limit(pump_gain):
    design = (
        full_design(FINGER, pump_gain, evaluations=40)
        if pump_gain
        else actuator_design(FINGER, evaluations=40)
    )
    assert design.tuned.history[-1] < 0.7 * design.tuned.history[0]
    loop = linear_loop(design.system, design.gains, design.limit, duration=20.0)
    assert np.max(np.abs(loop.command)) <= design.limit
    # 5 deg: an integral gain near zero creeps.
    assert abs(60 * DEG - float(final_value(loop.time, loop.measured)[0])) < 5 * DEG


def test_design_knows_nothing_of_the_rig_but_its_model():
    # Angle and command scale out: a finger twice as soft wants half the gains.
    one = actuator_design(FINGER, evaluations=1).tuned.start
    two = actuator_design(SecondOrder(1.65, 0.86, 3e-4), evaluations=1).tuned.start
    assert two.kp == pytest.approx(one.kp / 2)
    assert two.derivative_filter == pytest.approx(one.derivative_filter)


@given(share=st.floats(-1, 1))
def test_share_of_set_pressure_becomes_share_of_set_speed(share):
    speed = PressureAsSpeed(Constant(share * SET_PRESSURE)).update(0.0, 0.0)
    assert float(speed) == pytest.approx(share * SPEED_LIMIT, abs=1e-12)


@given(pressure=st.floats(-60e3, 60e3))
def test_plunger_comes_to_the_pressure_and_stops(pressure):
    pump = PressureByPlunger(Constant(pressure), PUMP_GAIN)
    # At 5 rev/s a pressure of 60 kPa takes 60e3 / (978 * 31.4) = 2 s, or 79 periods.
    speeds = [float(pump.update(0.0, 0.0)) for _ in range(90)]
    assert PUMP_GAIN * PERIOD * sum(speeds) == pytest.approx(pressure, abs=1e-6)
    assert abs(speeds[-1]) < 1e-6
    assert max(map(abs, speeds)) <= SPEED_LIMIT


def test_plunger_in_place_is_the_actuator_loop_where_the_motor_is_fast():
    # Without a speed limit the pressure is there one period late at most: as a limit case the
    # slow loop on the full model follows that on the actuator alone.
    gains = Gains(kp=2e3, ki=4e3)
    plant = StateSpacePlant(full_state_space(FINGER, PUMP_GAIN))
    pump = PressureByPlunger(PID(gains), PUMP_GAIN, speed_limit=1e6)
    full = run_loop(plant, pump, 1.0, duration=20.0)
    alone = run_loop(StateSpacePlant(state_space(FINGER)), PID(gains), 1.0, duration=20.0)
    np.testing.assert_allclose(full.measured, alone.measured, atol=0.02)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan])
def test_pressure_commands_refuse_what_is_not_above_zero(bad):
    with pytest.raises(InvalidInputError):
        PressureAsSpeed(Constant(0.0), set_speed=bad)
    with pytest.raises(InvalidInputError):
        PressureByPlunger(Constant(0.0), bad)
