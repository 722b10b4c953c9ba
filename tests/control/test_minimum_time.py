"""Bounds on any controller: closed forms of time-optimal control, and what PIDs do beside them."""

import math

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.control.loop import SPEED_LIMIT, run_loop
from softgrip.control.minimum_time import farthest, largest_step, minimum_settling_time
from softgrip.control.pid import PID, Gains, pid_state_space
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.errors import InvalidInputError
from softgrip.units import DEG

FINGER = SecondOrder(2.86, 0.7, 206 * DEG / 0.15e6)
FULL = full_state_space(FINGER, 3600.0)
IDENTIFIED = full_state_space(SecondOrder(1.65, 0.86, 1.49e-4), 980.0)


def integrators(n):
    return control.ss(np.eye(n, k=1), np.eye(n)[:, -1:], np.eye(n)[:1], 0)


@pytest.mark.parametrize(("n", "factor"), [(1, 1), (2, 2), (3, 6)])
def test_farthest_of_integrators(n, factor):
    time = np.array([0.0, 0.5, 2.0])
    found = farthest(integrators(n), 3.0, time)
    np.testing.assert_allclose(found, 3.0 * time**n / factor, rtol=1e-5)


def test_farthest_uses_both_signs_where_the_impulse_response_does():
    # w / (s^2 + w^2): the integral of |sin| over one turn is 4 / w.
    swing = control.ss([[0, 2], [-2, 0]], [[0], [1]], [[1, 0]], 0)
    assert farthest(swing, 1.0, np.pi) == pytest.approx(2.0, rel=1e-5)


def test_farthest_of_the_finger_in_its_first_moments_is_that_of_three_integrators():
    jerk = FINGER.gain * 2.86**2 * 3600.0 * SPEED_LIMIT
    assert farthest(FULL, SPEED_LIMIT, 0.01) == pytest.approx(jerk * 0.01**3 / 6, rel=0.02)


@pytest.mark.parametrize(
    ("n", "time"), [(1, 1.0), (2, 2.0), (3, 32 ** (1 / 3))], ids=["one", "two", "three"]
)
def test_rest_to_rest_of_integrators(n, time):
    # A unit step with a unit limit: t, 2 sqrt(1), cube root of 32 (full, back, full).
    band, period = 1e-5, 0.02
    found = minimum_settling_time(integrators(n), 1.0, 1.0, band=band, period=period, hold=0.5)
    # Crossing the band, 2e-5 wide, under the full command takes at most this long.
    early = (math.factorial(n) * 2 * band) ** (1 / n)
    assert time - early - period <= found <= time + period


def test_bound_falls_with_the_limit_and_the_band():
    def least(limit, band):
        return minimum_settling_time(FULL, 0.5, limit, band=band * 0.5)

    assert least(60.0, 0.05) < least(30.0, 0.05) < least(15.0, 0.05)
    assert least(30.0, 0.1) <= least(30.0, 0.05) <= least(30.0, 0.02)


def test_settling_is_no_faster_than_reaching_the_band():
    time = minimum_settling_time(FULL, 0.5, SPEED_LIMIT, band=0.025)
    assert farthest(FULL, SPEED_LIMIT, time) >= 0.475


@settings(max_examples=40)
@given(kp=st.floats(1, 100), ki=st.floats(0, 3), kd=st.floats(0, 1), step=st.floats(0.1, 3))
def test_no_pid_settles_before_the_bound(kp, ki, kd, step):
    pid = PID(Gains(kp, ki * kp, kd * kp), limits=(-SPEED_LIMIT, SPEED_LIMIT))
    result = run_loop(StateSpacePlant(FULL), pid, step, duration=4.0, limit=SPEED_LIMIT)
    settled = float(settling_time(result.time, result.measured, final=step, band=0.05))
    bound = (
        settled if settled > 3 else minimum_settling_time(FULL, step, SPEED_LIMIT, band=0.05 * step)
    )
    # The crossing is interpolated between two samples, the bound is a sample.
    assert settled >= bound - 0.025


@given(kp=st.floats(1e-2, 1e3), ki=st.floats(1e-2, 1e2), kd=st.floats(1e-2, 1e1))
def test_sum_of_poles_bounds_the_slowest(kp, ki, kd):
    # The filter's pole only moves to the left, and the others share -2 zeta omega_n.
    for gains, count in ((Gains(kp, ki * kp, kd * kp), 4), (Gains(kp, 0.0, kd * kp), 3)):
        poles = control.feedback(FULL * pid_state_space(gains), 1).poles()
        assert poles.real.max() >= -2 * 0.7 * 2.86 / count - 1e-6


def test_never_within_the_time_given():
    assert minimum_settling_time(FULL, 100.0, 1.0, band=0.1, longest=0.5) == np.inf


@pytest.mark.parametrize("options", [{"change": -1.0}, {"band": 0.0}, {"limit": np.nan}])
def test_arguments_out_of_range(options):
    arguments = {"change": 1.0, "limit": 1.0, "band": 0.1} | options
    with pytest.raises(InvalidInputError):
        minimum_settling_time(FULL, **arguments)


def test_negative_time_is_refused():
    with pytest.raises(InvalidInputError):
        farthest(FULL, 1.0, -1.0)


@pytest.mark.parametrize(("n", "share"), [(1, 1), (2, 1 / 4), (3, 1 / 32)])
def test_largest_step_from_rest_to_rest_of_integrators(n, share):
    # A unit command for a time T: T, T^2 / 4, T^3 / 32 (full, back, full).
    found = largest_step(integrators(n), 3.0, 2.0, band=1e-6, period=0.025)
    # Samples alone count, so that it may come to rest up to a period later.
    assert 3.0 * 2.0**n * share <= found * (1 + 1e-5)
    assert found <= 3.0 * 2.025**n * share


@pytest.mark.parametrize("band", [0.02, 0.1])
def test_largest_step_settles_in_this_time_and_a_larger_one_does_not(band):
    step = largest_step(IDENTIFIED, 31.4, 0.8, band=band)
    slower = minimum_settling_time(IDENTIFIED, 1.01 * step, 31.4, band=band * 1.01 * step)
    assert (
        minimum_settling_time(IDENTIFIED, 0.99 * step, 31.4, band=band * 0.99 * step) <= 0.8 + 1e-9
    )
    assert slower > 0.8 + 1e-9
    assert (1 - band) * step <= farthest(IDENTIFIED, 31.4, 0.8)


def test_largest_step_is_in_proportion_to_the_limit():
    one, two = (largest_step(IDENTIFIED, limit, 0.8, band=0.05) for limit in (10.0, 20.0))
    assert two == pytest.approx(2 * one, rel=1e-6)


@pytest.mark.parametrize("options", [{"time": 0.001}, {"band": 1.0}, {"limit": 0.0}])
def test_largest_step_refuses_arguments_out_of_range(options):
    with pytest.raises(InvalidInputError):
        largest_step(IDENTIFIED, **({"limit": 1.0, "time": 1.0, "band": 0.1} | options))
