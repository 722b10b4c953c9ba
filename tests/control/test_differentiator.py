"""Differentiators: exact where they should be, and in the noise of the flex sensor."""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.lqr import FINGER, Weights, closed_loop
from softgrip.errors import InvalidInputError
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.sensors import from_counts, to_counts
from softgrip.units import DEG

TIME = np.arange(0, 10, 0.025)


def run(differentiator, samples):
    return np.stack([differentiator.update(y) for y in samples])


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(-2, 2))
def test_parabola_is_fitted_exactly(a, b, c):
    found = run(PolynomialDifferentiator(7), a + b * TIME + c * TIME**2)
    np.testing.assert_allclose(found[7:, 1], b + 2 * c * TIME[7:], atol=1e-6)
    np.testing.assert_allclose(found[7:, 2], 2 * c, atol=1e-5)


def test_cubic_fit_is_exact_on_a_cubic():
    found = run(PolynomialDifferentiator(9, order=3), TIME**3)
    np.testing.assert_allclose(found[9:, 2], 6 * TIME[9:], rtol=1e-6, atol=1e-4)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-0.5, 0.5))
def test_robust_one_finds_a_parabola(a, b, c):
    # Third derivative 0: exact but for the jitter of the explicit scheme, of the order of
    # jerk h^3, jerk h^2 and jerk h with h = 25 ms; a factor of five for each.
    found = run(RobustDifferentiator(2.0), a + b * TIME + c * TIME**2)[300:]
    t = TIME[300:]
    exact = np.stack([a + b * t + c * t**2, b + 2 * c * t, np.full_like(t, 2 * c)], axis=-1)
    assert np.all(np.abs(found - exact).max(axis=0) < 5 * 2.0 * 0.025 ** np.array([3, 2, 1]))


def test_robust_one_follows_a_sine_to_the_order_of_its_period():
    # |d^3/dt^3| = 1 <= jerk; errors as above with jerk 2, at two periods: order 3, 2, 1 of it.
    errors = []
    for h in (0.02, 0.005):
        t = np.arange(0, 20, h)
        found = run(RobustDifferentiator(2.0, period=h), np.sin(t))
        exact = np.stack([np.sin(t), np.cos(t), -np.sin(t)], axis=-1)
        errors.append(np.abs(found - exact)[t > 10].max(axis=0))
        assert np.all(errors[-1] < 8 * 2.0 * h ** np.array([3, 2, 1]))
    # A quarter of the period: 64, 16 and 4 times less, by a factor of two.
    assert np.all(errors[0] / errors[1] > np.array([32, 8, 2]))


def test_bound_of_the_jerk_is_needed():
    # A sine of 5 rad/s has a third derivative of 125: a jerk of 1 cannot follow it.
    signal = np.sin(5 * TIME)
    slow, fast = (run(RobustDifferentiator(jerk), signal)[200:, 1] for jerk in (1.0, 200.0))
    rate = 5 * np.cos(5 * TIME)[200:]
    assert np.std(slow - rate) > 3 * np.std(fast - rate)


@pytest.fixture(scope="module")
def noisy_step():
    """Derivatives of the linear response to 60 deg, and the flex sensor's readings of 40 runs."""
    loop = closed_loop(FINGER, Weights())
    whole = control.forced_response(
        loop, TIME, np.full((1, TIME.size), 60 * DEG), squeeze=False
    ).states.reshape(3, -1)
    sensors = SensorParameters()
    noise = np.random.default_rng(3).normal(0, 2 * DEG, (TIME.size, 40))
    counts = to_counts(whole[0][:, None] + noise, sensors.angle_range, sensors)
    return whole, from_counts(counts, sensors.angle_range, sensors)


def errors(differentiator, noisy_step):
    whole, samples = noisy_step
    return np.sqrt(np.mean((run(differentiator, samples) - whole.T[..., None]) ** 2, axis=(0, 2)))


def test_in_the_sensors_noise_the_fit_is_a_little_better(noisy_step):
    # Each at its best of a series: rate 0.13 against 0.10 rad/s, acceleration 0.39 against 0.35.
    robust = np.array([errors(RobustDifferentiator(j), noisy_step) for j in (1, 2, 5, 10, 20)])
    fitted = np.array([errors(PolynomialDifferentiator(w), noisy_step) for w in (20, 28, 36, 44)])
    assert robust[:, 1].min() == pytest.approx(0.125, rel=0.1)
    assert fitted[:, 1].min() == pytest.approx(0.101, rel=0.1)
    assert np.all(fitted.min(axis=0) < robust.min(axis=0))
    # The jerk that exactness asks for, 10 rad/s^3, is not the best one in noise.
    assert np.argmin(robust[:, 1]) in (1, 2)


def test_robust_errors_grow_with_the_noise_as_theory_says():
    # Levant's worst case is e, e^(2/3), e^(1/3) with a memory of about (e / jerk)^(1/3). Noise that
    # is independent from sample to sample averages over that: times (e^(1/3))^(-1/2).
    noise = np.random.default_rng(0).standard_normal((2000, 20))
    small, large = (
        np.std(run(RobustDifferentiator(5.0), size * noise)[500:], axis=(0, 2))
        for size in (0.01, 0.08)
    )
    np.testing.assert_allclose(np.log(large / small) / np.log(8), [5 / 6, 1 / 2, 1 / 6], atol=0.05)


@pytest.mark.parametrize(
    "make", [lambda: RobustDifferentiator(5.0), lambda: PolynomialDifferentiator(12)]
)
def test_batch_is_each_run(make):
    samples = np.random.default_rng(1).normal(size=(60, 3))
    batch = run(make(), samples)
    assert batch.shape == (60, 3, 3)
    for k in range(3):
        np.testing.assert_allclose(batch[..., k], run(make(), samples[:, k]), atol=1e-9)


@pytest.mark.parametrize(
    "make",
    [
        lambda: RobustDifferentiator(0.0),
        lambda: RobustDifferentiator(1.0, period=-1.0),
        lambda: PolynomialDifferentiator(3, order=3),
        lambda: PolynomialDifferentiator(5, order=1),
    ],
)
def test_out_of_range(make):
    with pytest.raises(InvalidInputError):
        make()
