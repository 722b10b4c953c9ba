"""The filter against Gaussian conditioning of all measurements at once, which knows no steps."""

from math import inf
from time import perf_counter

import numpy as np
import pytest

from softgrip.errors import InvalidInputError, NotFiniteError
from softgrip.tactile.drift_curve import Curve
from softgrip.tactile.drift_filter import LEFT, DriftFilter
from softgrip.tactile.drift_law import Bridge, Line
from softgrip.tactile.drift_model import HOUR, DriftSize

CURVE = Curve(np.array([0.0, 0.3, 0.6]), np.array([0.5, 2.5, 3.5]), np.zeros(3))
NOISE, WEIGHED = 0.004, 0.01


def covariances(size, ages):
    """Return those of the states at all ages, shape (N, 4, N, 4), by their closed form."""
    count = len(ages)
    found = np.zeros((count, 4, count, 4))
    first = np.minimum(ages[:, None], ages[None])
    apart = abs(ages[:, None] - ages[None])
    tau = size.return_time
    if tau == inf:
        wander, start = first, np.ones_like(first)
    else:
        wander = tau / 2 * (np.exp(-apart / tau) - np.exp(-(ages[:, None] + ages[None]) / tau))
        start = np.exp(-(ages[:, None] + ages[None]) / tau)
    found[:, 0, :, 0], found[:, 1, :, 1] = size.gain_rate**2, size.offset_rate**2
    found[:, 2, :, 2] = size.gain_wander**2 * wander
    found[:, 3, :, 3] = size.offset_wander**2 * wander + NOISE**2 * start
    return found


def conditioned(size, ages, calibrated, voltages, errors):
    """Return means and covariances of the states at all ages, given all measurements."""
    count, prior = len(ages), covariances(size, ages)
    H = np.zeros((count, count, 4))
    for k, (age, level) in enumerate(zip(ages, calibrated, strict=True)):
        H[k, k] = level * age, age, level, 1.0
    H, prior = H.reshape(count, -1), prior.reshape(4 * count, -1)
    K = np.linalg.solve(H @ prior @ H.T + np.diag(np.square(errors)), H @ prior).T
    mean = K @ (voltages - calibrated)
    spread = (prior - K @ H @ prior).reshape(count, 4, count, 4)
    return mean.reshape(count, 4), np.array([spread[k, :, k] for k in range(count)])


@pytest.mark.parametrize("return_time", [1.5, inf])
@pytest.mark.parametrize("wander", [0.0, 0.02])
def test_filter_and_smoother_are_gaussian_conditioning(return_time, wander):
    rng = np.random.default_rng(3)
    size = DriftSize(gain_wander=wander, offset_wander=wander, return_time=return_time)
    ages = np.sort(rng.uniform(0.01, 9, 14))
    at_rest = rng.random(14) < 0.6
    calibrated = np.where(at_rest, 0.5, 2.5)
    # Of one drift in all: so none is refused.
    voltages = calibrated * (1 + 0.01 * ages) - 0.005 * ages + rng.normal(0, 0.004, 14)
    errors = np.where(at_rest, LEFT * NOISE, WEIGHED)
    drift = DriftFilter(CURVE, size, Line(), NOISE, weight_deviation=WEIGHED)
    for age, voltage, rest in zip(ages, voltages, at_rest, strict=True):
        if rest:
            assert drift.rest(age * HOUR, voltage)
        else:
            drift.weigh(age * HOUR, voltage, 0.3)
    means, spreads = conditioned(size, ages, calibrated, voltages, errors)
    # The last state of the filter has seen all; the smoothed ones have, at all ages.
    assert drift.state == pytest.approx(means[-1], abs=1e-9)
    assert drift.covariance == pytest.approx(spreads[-1], abs=1e-11)
    states, smoothed = drift.smoothed()
    # The pseudo-inverse cuts off what is below a 1e-15th: a few digits of what is left.
    assert states[1:] == pytest.approx(means, abs=1e-6)
    assert smoothed[1:] == pytest.approx(spreads, abs=1e-8)


def test_a_bridge_tells_the_gain_by_the_unloaded_layer_alone():
    """The gain moves the voltage without load: a prior of gain alone leaves nothing open."""
    size = DriftSize(offset_rate=0.0, offset_wander=0.0, gain_wander=0.0)
    law = Bridge(25.0, 0.05)
    drift = DriftFilter(CURVE, size, law, 1e-4)
    for age in np.linspace(1, 8, 30):
        drift.rest(age * HOUR, float(law.drifted(0.5, 0.02 * age, 0.0)))
    # The slope of the bridge changes with the gain: the filter takes it at what it expects.
    assert drift.corrected(law.drifted(3.5, 0.16, 0.0)) == pytest.approx(3.5, abs=0.01)


def test_a_moment_far_above_what_is_expected_is_refused_and_one_below_is_not():
    drift = DriftFilter(CURVE, noise=NOISE)
    before = drift.state.copy()
    assert not drift.rest(60.0, 1.2)
    assert drift.state.tolist() == before.tolist()
    assert drift.rest(120.0, 0.4)
    assert drift.refused == 1


@pytest.mark.parametrize("voltage", [0.0, 4.999])
def test_what_the_converter_cut_off_measures_nothing(voltage):
    drift = DriftFilter(CURVE, noise=NOISE)
    assert not drift.weigh(3600.0, voltage, 0.6)
    assert drift.state.tolist() == [0.0] * 4


def test_running_samples_are_corrected_as_the_filter_knows():
    drift, rng = DriftFilter(CURVE, noise=NOISE), np.random.default_rng(0)
    time = np.arange(0, 1800.0)
    rest = 0.5 + 0.1 * time / HOUR + rng.normal(0, NOISE, len(time))
    found = np.array([drift.step(*one) for one in zip(time.tolist(), rest.tolist(), strict=True)])
    assert abs(found[1000:].mean() - 0.5) < 2 * NOISE
    # The filter's own time is that of its last moment: within a minute or so.
    assert drift.corrected(rest[-1]) == pytest.approx(found[-1], abs=1e-3)


def test_what_is_refused_changes_nothing():
    drift = DriftFilter(CURVE, noise=NOISE, calibrated_at=100.0)
    with pytest.raises(NotFiniteError):
        drift.rest(200.0, np.nan)
    with pytest.raises(NotFiniteError):
        drift.step(np.inf, 0.5)
    with pytest.raises(InvalidInputError, match="calibration"):
        drift.step(50.0, 0.5)
    with pytest.raises(InvalidInputError, match="time"):
        drift.rest(50.0, 0.5)
    with pytest.raises(InvalidInputError, match="as calibrated"):
        drift.weigh(200.0, 3.0, 50.0)  # gram-force
    assert drift.time == 100.0
    assert len(drift.events) == 1


def test_an_update_is_far_faster_than_a_sample_of_the_board():
    """25 ms from sample to sample; the bench has percentiles, here is room for a busy machine."""
    drift, taken = DriftFilter(CURVE, noise=NOISE), []
    for k in range(4000):
        start = perf_counter()
        drift.step(0.025 * k, 0.5)
        taken.append(perf_counter() - start)
    assert np.median(taken) < 1e-3
