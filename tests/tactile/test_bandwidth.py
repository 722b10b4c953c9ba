"""Leaving points out in closed form against doing it, and what it chooses."""

import numpy as np
import pytest
from sklearn.model_selection import LeaveOneGroupOut, LeaveOneOut, cross_val_predict

from softgrip.errors import InvalidInputError
from softgrip.tactile.bandwidth import best_bandwidth, left_out, left_out_error, tried_bandwidths
from softgrip.tactile.nadaraya_watson import NadarayaWatson


def data(count=60, noise=0.1):
    rng = np.random.default_rng(3)
    X = rng.random((count, 1))
    return X, np.sin(5 * X[:, 0]) + noise * rng.normal(size=count)


@pytest.mark.parametrize("kernel", ["gaussian", "epanechnikov"])
@pytest.mark.parametrize("bandwidth", [1e-4, 0.05, 2.0])
def test_one_by_one(kernel, bandwidth):
    X, y = data()
    expected = cross_val_predict(NadarayaWatson(bandwidth, kernel), X, y, cv=LeaveOneOut())
    np.testing.assert_allclose(left_out(X, y, bandwidth, kernel), expected, rtol=1e-12, atol=1e-13)


def test_group_by_group():
    X, y = data()
    groups = np.arange(60) // 3
    model = NadarayaWatson(0.05)
    expected = cross_val_predict(model, X, y, cv=LeaveOneGroupOut(), groups=groups)
    np.testing.assert_allclose(
        left_out(X, y, 0.05, groups=groups), expected, rtol=1e-12, atol=1e-13
    )


def test_chosen_one_is_the_best_of_those_tried():
    X, y = data()
    errors = [left_out_error(X, y, b) for b in tried_bandwidths(X)]
    best = best_bandwidth(X, y)
    assert left_out_error(X, y, best) == min(errors) < max(errors)
    assert NadarayaWatson().fit(X, y).bandwidth_ == best


def test_noise_asks_for_a_wider_kernel():
    assert best_bandwidth(*data(noise=0.5)) > best_bandwidth(*data(noise=0.01))


def test_scale_of_the_features_scales_the_bandwidth():
    X, y = data()
    assert best_bandwidth(1000 * X, y) == pytest.approx(1000 * best_bandwidth(X, y), rel=1e-9)


def test_points_in_one_place_have_no_bandwidth():
    with pytest.raises(InvalidInputError, match="not all in one place"):
        best_bandwidth(np.ones((3, 1)), np.arange(3.0))
    model = NadarayaWatson().fit(np.ones((3, 1)), np.arange(3.0))
    np.testing.assert_allclose(model.predict([[1.0], [7.0]]), 1)


def test_nothing_left_is_refused():
    with pytest.raises(InvalidInputError, match="at least two"):
        left_out(np.ones((1, 1)), np.ones(1), 1.0)
