"""Reaction curve and Ziegler-Nichols rule on processes whose answer is known in closed form."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import binom, gamma

from softgrip.control.pid import pid_state_space
from softgrip.control.ziegler_nichols import (
    ReactionCurve,
    integrating_reaction_curve,
    reaction_curve,
    ziegler_nichols,
)
from softgrip.dynamics.second_order import SecondOrder, full_state_space, step_response
from softgrip.errors import FitWarning, InvalidInputError

TIME = np.arange(0, 20, 0.001)


def first_order_with_delay(gain, T, L):
    return gain * (1 - np.exp(-np.maximum(TIME - L, 0) / T))


@pytest.mark.parametrize(("gain", "T", "L"), [(2.0, 3.0, 0.5), (-1.5, 1.0, 1.0), (1e-5, 0.5, 0.1)])
def test_first_order_with_delay(gain, T, L):
    curve = reaction_curve(TIME, 3.0 * first_order_with_delay(gain, T, L), step=3.0, window=2)
    # The tangent is a chord over one sample: off by half a sample's share of T.
    assert curve.delay == pytest.approx(L, abs=1e-3)
    assert curve.slope == pytest.approx(gain / T, rel=2e-3)
    assert curve.gain / curve.slope == pytest.approx(T, rel=1e-2)


def test_three_equal_lags():
    # 1 / (s + 1)^3: inflexion at t = 2 with slope 2 e^-2, hence L = (e^2 - 5) / 2.
    curve = reaction_curve(TIME, 1 - np.exp(-TIME) * (1 + TIME + TIME**2 / 2), window=2)
    assert curve.slope == pytest.approx(2 * np.exp(-2), rel=1e-5)
    assert curve.delay == pytest.approx(2 - (1 - 5 * np.exp(-2)) / (2 * np.exp(-2)), rel=1e-5)


def test_finger_alone():
    # Eq. (4.14): the rate is greatest at arccos(zeta) / omega_d.
    w, z = 2.86, 0.7
    wd = w * np.sqrt(1 - z**2)
    at = np.arccos(z) / wd
    slope = w * np.exp(-z * w * at)
    curve = reaction_curve(TIME, step_response(TIME, w, z), window=2)
    assert curve.slope == pytest.approx(slope, rel=1e-5)
    assert curve.delay == pytest.approx(at - step_response(at, w, z) / slope, rel=1e-4)


def test_window_that_is_given_is_taken():
    noisy = first_order_with_delay(1.0, 3.0, 1.0)[::25]
    noisy = noisy + np.random.default_rng(0).normal(0, 0.01, noisy.size)
    curve = reaction_curve(TIME[::25], noisy, window=25)
    # A window of 0.6 s on a lag of 3 s takes the slope a tenth too low.
    assert curve.slope == pytest.approx(1 / 3, rel=0.15)
    assert curve.delay == pytest.approx(1.0, abs=0.15)
    assert curve.delay_interval is None


SLOW = 0.025 * np.arange(-120, 1200)


def noisy(response, share, seed=0):
    """Return a response with noise that is a share of its rise."""
    scale = np.ptp(response)
    return response + np.random.default_rng(seed).normal(0, share * scale, response.size)


def lag_with_delay(gain, T, L, time=SLOW):
    return gain * -np.expm1(-np.maximum(time - L, 0) / T)


@pytest.mark.parametrize("share", [0.001, 0.005, 0.02, 0.05])
@pytest.mark.parametrize(("gain", "T", "L"), [(2.0, 3.0, 0.5), (-1.0, 1.5, 1.5), (1e-5, 4.0, 0.2)])
def test_measured_lag_with_a_dead_time(gain, T, L, share):
    curve = reaction_curve(SLOW, noisy(lag_with_delay(gain, T, L), share), step_time=0.0)
    (low, high), slopes = curve.delay_interval, curve.slope_interval
    # Three half-widths: each of 24 intervals of 95 % may miss.
    assert abs(curve.delay - L) < 1.5 * (high - low)
    assert abs(curve.slope - gain / T) < 1.5 * (slopes[1] - slopes[0])
    assert high - low < 12 * share * T
    assert curve.slope == pytest.approx(gain / T, rel=4 * share)
    assert (curve.method, curve.warning) == ("first order with dead time", "")


def test_intervals_of_the_tangent_hold_the_truth_95_times_in_100():
    clean, runs = lag_with_delay(2.0, 3.0, 0.5), 25
    hits = np.zeros(2, int)
    for seed in range(runs):
        found = reaction_curve(SLOW, noisy(clean, 0.005, seed), step_time=0.0)
        intervals = (found.delay_interval, 0.5), (found.slope_interval, 2 / 3)
        hits += [low <= true <= high for (low, high), true in intervals]
    # Wider than 95 % where chance makes neighbours look alike: the upper bound is all of them.
    assert np.all(hits >= binom.ppf(0.001, runs, 0.95)), hits


@pytest.mark.parametrize("damping", [0.3, 0.7, 1.0, 2.0])
def test_measured_finger_with_a_dead_time(damping):
    w, L = 2.86, 0.3
    clean = step_response(np.maximum(SLOW - L, 0), w, damping)
    curve = reaction_curve(SLOW, noisy(clean, 0.003), step_time=0.0)
    exact = reaction_curve(SLOW[SLOW >= 0], clean[SLOW >= 0], window=2)
    # A chord over one sample of 25 ms is the tangent to a few thousandths.
    assert curve.slope == pytest.approx(exact.slope, rel=0.02)
    assert curve.delay == pytest.approx(exact.delay, abs=0.015)


@pytest.mark.parametrize("lags", [3, 5, 8])
@pytest.mark.parametrize("share", [0.0, 0.0003, 0.005, 0.02])
def test_process_of_more_lags_is_met_within_a_few_hundredths(lags, share):
    """The response of n equal lags is the incomplete gamma function; its slope a gamma density."""
    clean = gamma.cdf(SLOW, lags)
    slope = gamma.pdf(lags - 1, lags)
    delay = lags - 1 - gamma.cdf(lags - 1, lags) / slope
    curve = reaction_curve(SLOW, noisy(clean, share) if share else clean, step_time=0.0)
    assert curve.slope == pytest.approx(slope, rel=0.03)
    assert curve.delay == pytest.approx(delay, rel=0.06)


def test_counts_of_a_converter_are_no_staircase():
    clean = lag_with_delay(2.0, 3.0, 0.5)
    curve = reaction_curve(SLOW, np.round(clean / 0.02) * 0.02, step_time=0.0)
    assert curve.slope == pytest.approx(2 / 3, rel=0.02)
    assert curve.delay == pytest.approx(0.5, abs=0.03)


def test_uneven_times_are_used():
    time = np.sort(np.random.default_rng(2).uniform(-3, 30, 900))
    curve = reaction_curve(time, noisy(lag_with_delay(2.0, 3.0, 0.5, time), 0.005), step_time=0.0)
    assert (curve.delay, curve.slope) == pytest.approx((0.5, 2 / 3), rel=0.05)


@given(begin=st.floats(-50, 50), level=st.floats(-3, 3))
@settings(max_examples=5)
def test_clock_and_level_change_nothing(begin, level):
    y = noisy(lag_with_delay(2.0, 3.0, 0.5), 0.005)
    one = reaction_curve(SLOW, y, step_time=0.0)
    other = reaction_curve(SLOW + begin, y + level, step_time=begin)
    assert (other.delay, other.slope) == pytest.approx((one.delay, one.slope), rel=1e-4)


def test_lag_without_a_dead_time_has_no_gains_or_says_so():
    with pytest.raises(InvalidInputError, match="one lag without a dead time"):
        reaction_curve(SLOW, lag_with_delay(2.0, 3.0, 0.0), step_time=0.0)
    # The noise of seed 0 makes a delay of it, within the noise.
    with pytest.warns(FitWarning, match="cannot be told from none"):
        curve = reaction_curve(SLOW, noisy(lag_with_delay(2.0, 3.0, 0.0), 0.02), step_time=0.0)
    assert "cannot be told from none" in curve.warning


def test_response_that_first_goes_backwards_is_warned_of():
    back = 1 - np.exp(-np.maximum(SLOW, 0)) * (1 + 4 * np.maximum(SLOW, 0))
    with pytest.warns(FitWarning, match="no process of one lag or two"):
        assert reaction_curve(SLOW, noisy(back, 0.005), step_time=0.0).warning


@pytest.mark.parametrize("begin", [-4.0, 30.0, 29.9, np.nan])
def test_step_outside_the_record_is_refused(begin):
    with pytest.raises(InvalidInputError, match="step_time: expected a"):
        reaction_curve(SLOW, lag_with_delay(2.0, 3.0, 0.5), step_time=begin)


def test_measured_ramp_after_a_rest():
    ramp = 1.4 * np.maximum(SLOW - 1.3, 0)
    y = ramp + np.random.default_rng(0).normal(0, 0.05, ramp.size)
    curve = integrating_reaction_curve(SLOW, y, step=2.0, step_time=0.0)
    low, high = curve.delay_interval
    assert low < 1.3 < high
    assert curve.slope_interval[0] < 0.7 < curve.slope_interval[1]
    assert high - low < 0.1


def test_ramp_whose_delay_is_within_the_noise_is_warned_of():
    y = np.maximum(SLOW - 0.01, 0) + np.random.default_rng(3).normal(0, 0.5, SLOW.size)
    with pytest.warns(FitWarning, match="cannot be told from none"):
        integrating_reaction_curve(SLOW, y, step_time=0.0)


def test_integrator_with_delay():
    curve = integrating_reaction_curve(TIME, 2.0 * 0.7 * np.maximum(TIME - 1.3, 0), step=2.0)
    assert (curve.slope, curve.delay) == pytest.approx((0.7, 1.3))
    assert curve.gain == np.inf


@pytest.mark.parametrize("damping", [0.6, 0.7, 0.8, 1.5])
def test_full_model_has_the_delay_of_its_lag(damping):
    # Eq. (4.15): a ramp through a second-order lag stays 2 zeta / omega_n behind.
    system = full_state_space(SecondOrder(2.86, damping, 2.4e-5), 3000.0)
    y = control.step_response(system, TIME[::10]).outputs
    curve = integrating_reaction_curve(TIME[::10], y)
    assert curve.slope == pytest.approx(0.072, rel=1e-3)
    assert curve.delay == pytest.approx(2 * damping / 2.86, rel=1e-2)


def test_rule_of_1942():
    curve = ReactionCurve(delay=0.5, slope=2.0)
    p, pi, pid = (ziegler_nichols(curve, kind) for kind in ("P", "PI", "PID"))
    assert (p.kp, p.ki, p.kd) == pytest.approx((1.0, 0.0, 0.0))
    assert (pi.kp, pi.kp / pi.ki, pi.kd) == pytest.approx((0.9, 0.5 / 0.3, 0.0))
    assert (pid.kp, pid.kp / pid.ki, pid.kd / pid.kp) == pytest.approx((1.2, 1.0, 0.25))
    assert pid.derivative_filter == pytest.approx(0.025)


@given(unit=st.floats(1e-6, 1e6), pace=st.floats(0.1, 10))
def test_gains_follow_the_units(unit, pace):
    one = ziegler_nichols(ReactionCurve(0.4, 2.0))
    other = ziegler_nichols(ReactionCurve(0.4 * pace, 2.0 * unit / pace))
    assert other.kp * unit == pytest.approx(one.kp)
    assert other.ki * unit * pace == pytest.approx(one.ki)
    assert other.kd * unit / pace == pytest.approx(one.kd)


@pytest.mark.parametrize("scale", np.geomspace(1e-7, 10, 15))
@pytest.mark.parametrize("kind", ["PI", "PID"])
def test_rule_for_the_finger_alone_cannot_be_scaled_to_hold_it_with_its_pump(scale, kind):
    # Routh: near a double integrator the phase is lost unless ki / kp < omega_n / (2 zeta).
    finger = SecondOrder(2.86, 0.7, 2.4e-5)
    gains = ziegler_nichols(
        reaction_curve(TIME, finger.gain * step_response(TIME, 2.86, 0.7), window=2), kind
    )
    assert gains.ki / gains.kp > 2.86 / 1.4
    loop = full_state_space(finger, 3000.0) * pid_state_space(gains) * scale
    assert control.feedback(loop, 1).poles().real.max() > 0


def test_ramp_is_no_response_at_rest():
    with pytest.raises(InvalidInputError, match="integrating_reaction_curve"):
        reaction_curve(TIME, np.maximum(TIME - 1, 0))


def test_bent_end_is_no_ramp():
    with pytest.raises(InvalidInputError, match="straight ramp"):
        integrating_reaction_curve(TIME, TIME**2)


@pytest.mark.parametrize("function", [reaction_curve, integrating_reaction_curve])
@pytest.mark.parametrize(
    ("time", "output", "step"),
    [
        (TIME[:5], TIME[:5], 1.0),
        (TIME, TIME[:-1], 1.0),
        (TIME[::-1], TIME, 1.0),
        (TIME, np.full_like(TIME, np.nan), 1.0),
        (TIME, 0 * TIME, 1.0),
        (TIME, TIME, 0.0),
    ],
)
def test_records_that_are_no_step_response(function, time, output, step):
    with pytest.raises(InvalidInputError):
        function(time, output, step=step)


def test_no_delay_no_gains():
    with pytest.raises(InvalidInputError, match="after the step"):
        integrating_reaction_curve(TIME, TIME + 1 - np.exp(-5 * TIME))


def test_unknown_kind_and_options():
    with pytest.raises(InvalidInputError, match="PID"):
        ziegler_nichols(ReactionCurve(1.0, 1.0), "PD")
    with pytest.raises(InvalidInputError, match="window"):
        reaction_curve(TIME, TIME, window=1)
    with pytest.raises(InvalidInputError, match="tail"):
        integrating_reaction_curve(TIME, TIME, tail=0.0)
