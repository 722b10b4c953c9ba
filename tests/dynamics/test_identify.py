"""Second-order identification: known systems come back, within intervals that mean 95 %."""

import re
import warnings

import numpy as np
import pytest
from scipy.optimize import curve_fit
from scipy.stats import binom

from softgrip.dynamics.identify import identify
from softgrip.dynamics.second_order import SecondOrder, response, step_response
from softgrip.errors import FitWarning, InvalidInputError

TIME = np.arange(0, 6, 0.025)
RISING = np.where(TIME < 0.5, 0.0, 1e5 * (1 - np.exp(-(TIME - 0.5) / 0.4)))
"""A pressure as a pump makes it: no perfect step."""


@pytest.mark.parametrize("damping", [0.1, 0.7, 1.0, 2.5])
@pytest.mark.parametrize("gain", [2.4e-5, -2.4e-5])
def test_exact_record_gives_the_system_back(damping, gain):
    true = SecondOrder(2.86, damping, gain)
    found = identify(TIME, RISING, 0.05 + response(true, TIME, RISING))
    assert found.natural_frequency.value == pytest.approx(2.86, rel=1e-6)
    assert found.damping_ratio.value == pytest.approx(damping, rel=1e-6)
    assert found.gain.value == pytest.approx(gain, rel=1e-6)
    assert found.offset.value == pytest.approx(0.05, abs=1e-6)
    assert found.fit_percent == pytest.approx(100, abs=1e-4)
    assert found.system.natural_frequency == found.natural_frequency.value


def test_intervals_hold_the_truth_95_times_in_100():
    true = SecondOrder(2.86, 0.7, 2.4e-5)
    clean = 0.05 + response(true, TIME, RISING)
    runs, hits = 50, np.zeros(4, int)
    for seed in range(runs):
        noise = np.random.default_rng(seed).normal(0, 0.035, TIME.size)  # 2 deg
        counts = np.round((clean + noise) / 0.006) * 0.006  # 10 bits over about 350 deg
        found = identify(TIME, RISING, counts, dead_time=0.0)
        estimates = (found.natural_frequency, found.damping_ratio, found.gain, found.offset)
        truths = (2.86, 0.7, 2.4e-5, 0.05)
        hits += [e.low <= v <= e.high for e, v in zip(estimates, truths, strict=True)]
    low, high = binom.interval(0.999, runs, 0.95)
    assert np.all((hits >= low) & (hits <= high)), hits


def test_agrees_with_a_general_fitter_on_a_perfect_step():
    y = 1.5 * step_response(TIME, 2.0, 0.5) + np.random.default_rng(5).normal(0, 0.02, TIME.size)

    def model(t, w, z, k, offset):
        return offset + k * step_response(t, w, z)

    values, covariance = curve_fit(model, TIME, y, p0=(1, 1, 1, 0), bounds=([0.1, 0, 0, -1], 9))
    found = identify(TIME, np.ones_like(TIME), y, initial_input=0.0)
    estimates = (found.natural_frequency, found.damping_ratio, found.gain, found.offset)
    assert [e.value for e in estimates] == pytest.approx(values, rel=1e-4, abs=1e-5)
    # 2 %: the two take the derivatives by different finite differences.
    errors = [e.standard_error for e in estimates]
    assert errors == pytest.approx(np.sqrt(np.diag(covariance)), rel=0.02)


def test_numbers_of_a_short_record_are_those_of_the_textbook():
    """Student's t, 12 samples less 4 parameters: 2.306 in any table."""
    t = np.linspace(0, 6, 12)
    u = np.interp(t, TIME, RISING)
    y = response(SecondOrder(2.86, 0.7), t, u) + np.random.default_rng(0).normal(0, 1e3, t.size)
    found = identify(t, u, y)
    for e in (found.natural_frequency, found.damping_ratio, found.gain, found.offset):
        half = pytest.approx(2.306 * e.standard_error, rel=3e-4)
        assert (e.high - e.value, e.value - e.low) == (half, half)
    left = found.fitted - y
    assert found.rms == pytest.approx(np.sqrt(left @ left / 12))
    explained = 1 - np.linalg.norm(left) / np.linalg.norm(y - y.mean())
    assert found.fit_percent == pytest.approx(100 * explained)


def test_motion_is_told_up_to_half_the_sampling_rate():
    t = np.arange(40.0)
    u = np.random.default_rng(2).normal(size=t.size)
    found = identify(t, u, response(SecondOrder(2.5, 0.3), t, u))
    assert found.natural_frequency.value == pytest.approx(2.5, rel=1e-6)
    with pytest.raises(InvalidInputError, match="determines the parameters"):
        identify(t, u, response(SecondOrder(3.2, 0.3), t, u))


@pytest.mark.parametrize(("turn", "damping"), [(0.15, 0.3), (0.2, 1.5), (0.5, 0.3), (1.5, 0.7)])
def test_a_record_of_less_than_a_radian_is_right_or_refused(turn, damping):
    """Without noise: the search used to end at half the frequency, with an interval of a tenth."""
    t = np.arange(0, 6, 0.1)
    y = response(SecondOrder(turn / t[-1], damping, 2.4e-5), t, 0 * t + 1e5, initial_pressure=0.0)
    if turn < 1:
        with pytest.raises(InvalidInputError, match="determines the parameters"):
            identify(t, 0 * t + 1e5, y, initial_input=0.0)
    else:
        found = identify(t, 0 * t + 1e5, y, initial_input=0.0)
        assert found.natural_frequency.value == pytest.approx(turn / t[-1], rel=1e-3)


def test_units_scale_the_gain_only():
    y = response(SecondOrder(2.86, 0.7, 2.4e-5), TIME, RISING)
    y = y + np.random.default_rng(1).normal(0, 0.03, y.size)
    si, other = identify(TIME, RISING, y), identify(TIME, RISING / 1e6, np.rad2deg(y))
    assert other.gain.value == pytest.approx(np.rad2deg(si.gain.value) * 1e6, rel=1e-6)
    assert other.damping_ratio.low == pytest.approx(si.damping_ratio.low, rel=1e-5)


def test_held_command_is_not_taken_for_a_ramp():
    t = np.arange(0, 6, 0.1)
    u = np.where(t < 0.95, 0.0, 1.0)
    y = response(SecondOrder(2.86, 0.7), t, u, hold="zero")
    assert identify(t, u, y, hold="zero").natural_frequency.value == pytest.approx(2.86, rel=1e-6)
    ramp = identify(t, u, y, dead_time=0.0)
    assert abs(ramp.natural_frequency.value / 2.86 - 1) > 0.02


STEP = np.where(TIME < 1.0, 0.0, 1e5)


@pytest.mark.parametrize("hold", ["zero", "linear"])
@pytest.mark.parametrize(("late", "damping"), [(0.1, 0.7), (0.013, 1.2), (0.4, 0.3)])
def test_exact_record_gives_its_dead_time_back(late, damping, hold):
    system = SecondOrder(2.86, damping, 2.4e-5)
    moved = np.union1d(TIME, TIME - late)
    moved = moved[moved >= 0]
    held = STEP[np.searchsorted(TIME, moved, side="right") - 1]
    pressure = held if hold == "zero" else np.interp(moved, TIME, RISING)
    earlier = response(system, moved, pressure, hold=hold)
    angle = 0.05 + np.interp(TIME - late, moved, earlier, left=0.0)
    found = identify(TIME, STEP if hold == "zero" else RISING, angle, hold=hold)
    assert found.dead_time.value == pytest.approx(late, rel=1e-4)
    assert found.natural_frequency.value == pytest.approx(2.86, rel=1e-4)
    assert found.damping_ratio.value == pytest.approx(damping, rel=1e-4)
    known = identify(TIME, STEP if hold == "zero" else RISING, angle, hold=hold, dead_time=late)
    assert known.natural_frequency.value == pytest.approx(2.86, rel=1e-4)
    assert (known.dead_time.value, known.dead_time.standard_error) == (late, 0.0)


def test_dead_time_lies_in_its_interval_and_leaves_the_frequency_alone():
    """The response to a step a dead time later, by the closed form of Eq. (4.11)."""
    runs, hits = 20, np.zeros(2, int)
    clean = step_response(np.maximum(TIME - 1.1, 0), 2.86, 0.7)
    for seed in range(runs):
        y = clean + np.random.default_rng(seed).normal(0, 0.01, TIME.size)
        found = identify(TIME, STEP, y, hold="zero")
        pairs = (found.natural_frequency, 2.86), (found.dead_time, 0.1)
        hits += [e.low <= true <= e.high for e, true in pairs]
        assert not found.warning
    assert np.all(hits >= binom.ppf(0.001, runs, 0.95)), hits
    assert identify(TIME, STEP, y, hold="zero", dead_time=0.0).natural_frequency.high < 2.6


def test_record_without_a_dead_time_is_given_none():
    y = response(SecondOrder(2.86, 0.7, 2.4e-5), TIME, RISING)
    y = y + np.random.default_rng(0).normal(0, 0.02, TIME.size)
    dead = identify(TIME, RISING, y).dead_time
    assert (dead.value, dead.low, dead.high) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("late", [0.0, 0.3])
def test_first_order_process_is_told(late):
    clean = -np.expm1(-np.maximum(TIME - late, 0) / 0.8)
    y = clean + np.random.default_rng(0).normal(0, 0.01, TIME.size)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            words = identify(TIME, np.ones_like(TIME), y, initial_input=0.0).warning
            assert [str(w.message) for w in said] == [words]
        except InvalidInputError as error:
            words = str(error)
    assert re.search(r"first-order process of time constant 0\.(79|8|80)\d* s fits as well", words)


def test_response_of_another_shape_is_warned_of():
    y = np.where(TIME > 2, 1.0, 0.3 * TIME) + np.random.default_rng(0).normal(0, 0.01, TIME.size)
    with pytest.warns(FitWarning, match="misses the output by"):
        found = identify(TIME, np.ones_like(TIME), y, initial_input=0.0)
    assert "misses the output" in found.warning
    # Who says which model he wants is not warned, but can ask.
    assert identify(TIME, np.ones_like(TIME), y, initial_input=0.0, dead_time=0.0).warning


@pytest.mark.parametrize("late", [-0.1, 6.0, np.nan])
def test_dead_time_out_of_range(late):
    with pytest.raises(
        InvalidInputError, match=r"dead_time: expected (None, or 0 to 5\.975 s|a finite number)"
    ):
        identify(TIME, RISING, GOOD, dead_time=late)


def test_uneven_times_are_used_as_they_are():
    t = np.sort(np.random.default_rng(4).uniform(0, 6, 100))
    u = np.sin(2 * t)
    y = response(SecondOrder(2.86, 0.7), t, u)
    assert identify(t, u, y).natural_frequency.value == pytest.approx(2.86, rel=1e-6)


GOOD = response(SecondOrder(2.86, 0.7, 2.4e-5), TIME, RISING)
NOISE = np.random.default_rng(0).normal(0, 1, TIME.size)


@pytest.mark.parametrize(
    ("time", "pressure", "angle", "message"),
    [
        (TIME, np.ones_like(TIME), GOOD, "initial_input"),
        (TIME, RISING, 0 * TIME, "output: expected a response"),
        (TIME[:5], RISING[:5], GOOD[:5], "N >= 8"),
        (TIME, RISING[:-1], GOOD, "one shape"),
        (TIME, RISING, np.where(TIME == 1, np.nan, GOOD), "finite"),
        (TIME[::-1], RISING, GOOD, "increasing"),
        (np.repeat(TIME[::2], 2), RISING, GOOD, "increasing"),
        (TIME[:28], RISING[:28], GOOD[:28] + 0.02 * NOISE[:28], "determines the parameters"),
        (TIME, RISING, 0.05 * NOISE, "determines the parameters"),
    ],
    ids=["still", "silent", "few", "shapes", "nan", "backwards", "repeated", "short", "drowned"],
)
def test_records_that_tell_nothing(time, pressure, angle, message):
    with pytest.raises(InvalidInputError, match=message):
        identify(time, pressure, angle)
