"""Noise levels by maximum likelihood."""

import dataclasses

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.pump.elastance import ElastanceModel, NoiseLevels
from softgrip.pump.noise import NAMES
from softgrip.pump.noise import estimate_noise as estimate_noise_at

from .test_capacity import DT, PRIOR, estimated, ramp, simulate

TRUE = NoiseLevels(pressure_step=60.0, elastance_step=4e7, sensor=150.0)
GUESS = ElastanceModel(DT, NoiseLevels(20.0, 1e7, 400.0), PRIOR, angle_gain=-3e8)


def record(seed, n=240, levels=TRUE):
    flow, angle = ramp(n)
    _, measured = simulate(dataclasses.replace(GUESS, noise=levels), flow, angle, 1, seed)
    return measured[0], flow, angle


def estimate_noise(pressure, *others, **fitted):
    """Return the noise of a record that is even in time."""
    time = DT * np.arange(len(pressure))
    return estimate_noise_at(pressure, *others, time=time, **fitted)


@pytest.fixture(scope="module", params=[0])
def case(request):
    columns = record(request.param)
    return columns, estimate_noise(*columns, GUESS)


def test_known_levels_lie_in_their_99_percent_intervals(case):
    _, found = case
    for name in NAMES:
        low, high = found.interval(name, 0.99)
        assert low < getattr(TRUE, name) < high


def test_intervals_say_something(case):
    _, found = case
    low, high = found.interval("sensor")
    assert high / low < 1.6
    assert all(np.isfinite(found.log_std))


def test_no_level_nearby_is_more_likely(case):
    columns, found = case
    for name in NAMES:
        for factor in (0.9, 1.1):
            level = getattr(found.levels, name) * factor
            noise = dataclasses.replace(found.levels, **{name: level})
            other = estimated(*columns, dataclasses.replace(GUESS, noise=noise))
            assert other.log_likelihood < found.log_likelihood


def test_level_that_is_not_there_is_not_told_from_zero():
    columns = record(0, n=120, levels=dataclasses.replace(TRUE, pressure_step=0.0))
    found = estimate_noise(*columns, GUESS)
    without = dataclasses.replace(found.levels, pressure_step=0.0)
    zero = estimated(*columns, dataclasses.replace(GUESS, noise=without))
    # 3.3 is half of chi-square's 99 % point with 1 degree of freedom.
    assert found.log_likelihood - zero.log_likelihood < 3.3
    assert found.interval("pressure_step") == (0.0, float("inf"))


def test_known_gain_lies_within_three_standard_deviations(case):
    columns, held = case
    model = dataclasses.replace(GUESS, angle_gain=0.0)
    found = estimate_noise(*columns, model, fit_gain=True)
    assert abs(found.angle_gain - GUESS.angle_gain) < 3 * found.angle_gain_std
    assert found.apply(model).noise == found.levels
    for sign in (-1, 1):
        gain = found.angle_gain + sign * found.angle_gain_std
        moved = dataclasses.replace(found.apply(model), angle_gain=gain)
        drop = found.log_likelihood - estimated(*columns, moved).log_likelihood
        # A half if gain and levels were independent; more if not, as the levels are held here.
        assert 0.49 < drop < 0.8
    assert (held.angle_gain, held.angle_gain_std) == (GUESS.angle_gain, 0.0)
    # The gain given is one of those that the fit could choose.
    assert found.log_likelihood > held.log_likelihood - 1e-3


def test_bad_input_is_refused():
    columns = record(0, n=60)
    with pytest.raises(InvalidInputError, match="50 samples"):
        estimate_noise(*(c[:40] for c in columns), GUESS)
    with pytest.raises(InvalidInputError, match="flow"):
        estimate_noise(columns[0], np.zeros(60), columns[2], GUESS)
    zero = dataclasses.replace(GUESS, noise=NoiseLevels(0.0, 1.0, 1.0))
    with pytest.raises(InvalidInputError, match="start from"):
        estimate_noise(*columns, zero)
