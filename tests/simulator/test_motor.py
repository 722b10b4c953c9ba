"""The stepper motor and the plunger."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.simulator import motor
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import REV

PUMP = PumpParameters()
speeds = st.floats(-8 * REV, 8 * REV)
within = st.floats(-5 * REV, 5 * REV)


@given(start=within, command=speeds, end=st.floats(1e-3, 1.0))
def test_travel_is_the_integral_of_the_speed(start, command, end):
    times = np.linspace(0, end, 4001)
    speed = motor.speed(np.float64(start), np.float64(command), times, PUMP)
    way = motor.travel(np.float64(start), np.float64(command), np.float64(end), PUMP)
    # One bend of the speed inside one interval: less than a (h / 2)^2 / 2 is missed.
    missed = PUMP.advance * PUMP.acceleration_limit * (end / 4000) ** 2
    assert way == pytest.approx(PUMP.advance * np.trapezoid(speed, times), abs=missed + 1e-12)


@given(start=within, command=speeds)
def test_limits_of_speed_and_acceleration_hold(start, command):
    times = np.linspace(0, 1, 201)
    speed = motor.speed(np.float64(start), np.float64(command), times, PUMP)
    assert abs(speed).max() <= PUMP.speed_limit * (1 + 1e-12)
    assert abs(np.diff(speed)).max() <= PUMP.acceleration_limit * times[1] * (1 + 1e-9)
    assert speed[-1] == pytest.approx(np.clip(command, -PUMP.speed_limit, PUMP.speed_limit))


def test_one_turn_moves_the_plunger_by_the_lead():
    fast = PumpParameters(acceleration_limit=1e12)
    way = motor.travel(np.float64(0), np.float64(REV), np.float64(1.0), fast)
    assert way == pytest.approx(fast.lead)


@given(start=within, command=speeds)
def test_screw_turns_round_where_its_speed_is_zero(start, command):
    time = motor.turning_time(np.float64(start), np.float64(command), PUMP)
    if start * command < 0:
        speed = motor.speed(np.float64(start), np.float64(command), time, PUMP)
        assert speed == pytest.approx(0.0, abs=1e-12)
    else:
        assert time == 0


def test_plunger_follows_a_screw_with_play():
    # By hand: pushed to 10 mm with 1 mm of play, drawn back by half of it, then by 2 mm.
    places = [0.0]
    for screw in (0.010, 0.0095, 0.007, 0.0085):
        places.append(float(motor.follow(places[-1], screw, 1e-3)))
    assert places[1:] == pytest.approx([0.009, 0.009, 0.007, 0.0075])
