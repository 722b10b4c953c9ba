"""Intervals hold the truth as often as they say."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.materials.bootstrap import block_bootstrap

STRAIN = np.linspace(0, 3, 60)


def power(strain, stress):
    """Least squares of ``E strain**n``, begun near it: `ludwick.fit` gives the same, slower."""
    E, n = 1.0, 1.6
    logarithm = np.log(np.maximum(strain, 1e-12))
    for _ in range(5):
        x = strain**n
        step = np.linalg.lstsq(np.column_stack([x, E * x * logarithm]), stress - E * x)[0]
        E, n = E + step[0], n + step[1]
    return (n,)


def test_noise_of_one_percent_moves_the_power_by_less_than_its_interval_says():
    """200 tests, 95 %: a fair count is 190 +- 3, and 180 of 200 is 3 standard errors below it."""
    random = np.random.default_rng(0)
    held = 0
    for seed in range(200):
        law = STRAIN**1.6
        stress = law + 0.01 * law.max() * random.standard_normal(STRAIN.size)
        ((low, high),) = block_bootstrap(STRAIN, stress, power, resamples=60, seed=seed)
        held += low <= 1.6 <= high
    assert held >= 180


def test_a_stress_that_was_taken_off_widens_the_interval_by_its_error():
    """Oracle: the level of a curve is as uncertain as what was taken off it."""
    flat = np.ones(100)
    ((low, high),) = block_bootstrap(
        flat, flat, lambda e, s: (s.mean(),), resamples=4000, offset=0.1
    )
    # Ten runs: Student's t of 9 degrees of freedom, 2.26, times the root of 10 / 9.
    assert (high - low) / 2 == pytest.approx(0.1 * 2.26 * (10 / 9) ** 0.5, rel=0.1)


def test_confidence_is_a_share():
    with pytest.raises(InvalidInputError, match="confidence"):
        block_bootstrap(STRAIN, STRAIN, power, confidence=1.2)
