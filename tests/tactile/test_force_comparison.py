"""Cross-validation of the regressors: what is left out is left out."""

import numpy as np
import pytest
from sklearn.linear_model import LinearRegression
from sklearn.neighbors import KNeighborsRegressor

from softgrip.tactile.force_comparison import (
    cross_validated,
    regressors,
    resampled_root_mean_squares,
    root_mean_square,
)

FORCE = np.repeat(np.linspace(0, 0.7, 12), 3)
VOLTAGE = 4 * (1 - np.exp(-FORCE / 0.2)) + np.tile([-0.01, 0.0, 0.01], 12)


def test_repeated_measurements_flatter_a_neighbour():
    # One neighbour: another measurement of the same weight is mostly in the training, and right.
    nearest = KNeighborsRegressor(1)
    points = root_mean_square(cross_validated(nearest, VOLTAGE, FORCE) - FORCE)
    weights = cross_validated(nearest, VOLTAGE, FORCE, groups=FORCE) - FORCE
    step = FORCE[3] - FORCE[0]
    assert points < 0.5 * step  # now and then all three of a weight fall into one fold
    # Without the weight the nearest is the one beside it, a step away.
    np.testing.assert_allclose(abs(weights), step)


def test_groups_are_left_out_together():
    expected = []
    for k in range(12):
        rest = np.r_[0 : 3 * k, 3 * k + 3 : 36]
        line = np.polyfit(VOLTAGE[rest], FORCE[rest], 1)
        expected.extend(np.polyval(line, VOLTAGE[3 * k : 3 * k + 3]))
    found = cross_validated(LinearRegression(), VOLTAGE, FORCE, groups=FORCE)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("name", regressors())
def test_all_fit_what_they_can(name):
    # A line through a curve misses by 0.1 N; the others follow it to a fraction of that.
    model = regressors()[name].fit(VOLTAGE[:, None], FORCE)
    error = root_mean_square(model.predict(VOLTAGE[:, None]) - FORCE)
    low, high = (0.05, 0.2) if name == "ordinary least squares" else (0, 0.015)
    assert low <= error < high


def test_seed_makes_the_same_network():
    first, second = (
        cross_validated(regressors(1)["neural network"], VOLTAGE, FORCE, seed=1) for _ in range(2)
    )
    np.testing.assert_array_equal(first, second)


def test_resampled_errors_are_those_of_levels_drawn_by_hand():
    errors, levels = np.array([1.0, 2.0, 3.0, 4.0, 5.0]), np.array([0.1, 0.1, 0.0, 0.2, 0.2])
    found = resampled_root_mean_squares(errors, levels, resamples=50, seed=3)
    by_level = [errors[levels == level] for level in (0.0, 0.1, 0.2)]
    draws = np.random.default_rng(3).integers(3, size=(50, 3))
    by_hand = [root_mean_square(np.concatenate([by_level[k] for k in draw])) for draw in draws]
    np.testing.assert_allclose(found, by_hand, rtol=1e-12)
    assert found.std() > 0


def test_one_level_leaves_nothing_to_draw():
    found = resampled_root_mean_squares([3.0, 4.0], [1, 1], resamples=5)
    np.testing.assert_allclose(found, root_mean_square([3.0, 4.0]), rtol=1e-12)
