"""Both capacity filters on a simulated finger whose capacity grows as it bends."""

import numpy as np
import pytest

from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels, Prior
from softgrip.pump.noise import estimate_noise
from softgrip.pump.printed_filter import printed_filter, run_printed
from softgrip.units import DEG, PSI

from .test_capacity import DT, FLOW

CAPACITY_AT_REST, CAPACITY_GAIN = 1.0e-9, 0.5e-9


@pytest.fixture(scope="module")
def filling():
    """Simulate a finger whose capacity grows with its angle, read as the rig reads it.

    It is not the filter's model: 1/C is not linear in the angle, the pressure is integrated with
    steps a hundredth of the filter's, and the sensor is quantised (10 bits over 80 psi).
    """
    rng, n, fine = np.random.default_rng(5), 400, 100
    time = np.arange(n * fine) * DT / fine
    flow = np.where(time < 8, FLOW, 0.0)  # push for 8 s, then hold
    angle = 1.2 * np.minimum(time / 8, 1) ** 1.5
    C = CAPACITY_AT_REST + CAPACITY_GAIN * angle
    P = np.concatenate([[0], np.cumsum(flow / C * DT / fine)[:-1]])
    bit = 80 * PSI / 1023
    measured = np.round((P[::fine] + rng.normal(0, 300, n)) / bit) * bit
    bent = angle[::fine] + rng.normal(0, 2 * DEG, n)
    return measured, flow[::fine], bent, C[::fine]


@pytest.fixture(scope="module", params=["pressure alone", "with the angle"])
def tracked(request, filling):
    """From a prior that is 43 % off, with noise levels and gain found from the record itself."""
    measured, flow, angle, C = filling
    prior = Prior(pressure=0.0, pressure_std=500.0, elastance=0.7e9, elastance_std=3e8)
    model = ElastanceModel(DT, NoiseLevels(5.0, 5e6, 300.0), prior)
    time, fit_gain = DT * np.arange(measured.size), request.param != "pressure alone"
    noise = estimate_noise(measured, flow, angle, model, time=time, fit_gain=fit_gain)
    found = estimate(measured, flow, angle, noise.apply(model), time=time)
    return noise, found, found.capacity / C - 1


def test_growing_capacity_is_tracked_within_a_few_percent(tracked):
    """After two seconds for learning; the capacity itself grows by 60 %."""
    _, _, error = tracked
    assert abs(error[0]) > 0.3
    assert np.sqrt(np.mean(error[80:] ** 2)) < 0.05
    assert np.abs(error[80:]).max() < 0.12


def test_capacity_std_covers_the_error(tracked, filling):
    _, found, error = tracked
    covered = np.abs(error * filling[3])[80:] < 3 * found.capacity_std[80:]
    assert covered.mean() > 0.95


def test_gain_found_is_the_mean_slope_of_the_elastance(tracked, filling):
    noise, _, _ = tracked
    C = filling[3]
    slope = (1 / C[-1] - 1 / C[0]) / 1.2
    expected = 0.0 if noise.angle_gain_std == 0 else slope
    assert abs(noise.angle_gain - expected) <= 3 * noise.angle_gain_std


def test_sensor_level_found_is_that_of_noise_and_bits(tracked):
    noise, _, _ = tracked
    low, high = noise.interval("sensor", 0.99)
    assert low < np.hypot(300.0, 80 * PSI / 1023 / np.sqrt(12)) < high


def test_printed_filter_drifts_where_the_repaired_one_stands(filling, tracked):
    """Its gain is set so that it meets the true capacity when the push ends; then it runs on."""
    _, flow, angle, C = filling
    pushed = int(np.count_nonzero(flow))
    gain = (C[pushed] - C[0]) / np.sum(angle[:pushed])
    kalman = printed_filter(
        gain,
        capacity=C[0],
        capacity_std=3e-10,
        capacity_step=1e-13,
        angle_std=0.1,
        angle_step=0.02,
        sensor=2 * DEG,
    )
    printed, _ = run_printed(kalman, angle)
    _, repaired, _ = tracked
    drift = printed[-1, 0] - printed[pushed, 0]
    expected = gain * 1.2 * (len(C) - 1 - pushed)
    assert drift == pytest.approx(expected, rel=0.05)  # 2 degrees of noise on 69
    assert abs(repaired.capacity[-1] - repaired.capacity[pushed]) < 0.1 * drift
