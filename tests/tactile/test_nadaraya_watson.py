"""Eq. (2.5): scikit-learn's own checks, statsmodels beside it, the bandwidth by leaving out."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.model_selection import LeaveOneGroupOut, LeaveOneOut, cross_val_predict
from sklearn.neighbors import KNeighborsRegressor
from sklearn.utils.estimator_checks import parametrize_with_checks
from statsmodels.nonparametric.kernel_regression import KernelReg

from softgrip.errors import InvalidInputError
from softgrip.tactile.nadaraya_watson import (
    NadarayaWatson,
    best_bandwidth,
    left_out,
    left_out_error,
    tried_bandwidths,
)


@parametrize_with_checks([NadarayaWatson(), NadarayaWatson(0.5, "epanechnikov")])
def test_is_a_regressor_of_scikit_learn(estimator, check):
    check(estimator)


def data(count=69, features=1, seed=0):
    rng = np.random.default_rng(seed)
    X = rng.random((count, features))
    return X, np.sin(5 * X).sum(axis=1) + 0.1 * rng.normal(size=count)


@pytest.mark.filterwarnings("ignore:After 0.17:FutureWarning")  # of its random numbers, unused
@pytest.mark.parametrize("features", [1, 2])
def test_statsmodels_says_the_same(features):
    """Eq. (2.5), the regression, by another library."""
    X, y = data(features=features)
    new = np.random.default_rng(1).random((50, features))
    other = KernelReg(y, X, "c" * features, reg_type="lc", bw=[0.07] * features)
    found = NadarayaWatson(0.07).fit(X, y).predict(new)
    np.testing.assert_allclose(found, other.fit(new)[0], rtol=1e-9)


def test_many_queries_are_answered_like_few():
    X, y = data()
    model = NadarayaWatson(0.02).fit(X, y)
    new = np.linspace(-0.5, 1.5, 50_000)[:, None]
    one_by_one = np.concatenate([model.predict(new[k : k + 20]) for k in range(0, 50_000, 1000)])
    sample = model.predict(new).reshape(50, 1000)[:, :20].ravel()
    np.testing.assert_allclose(sample, one_by_one, rtol=0, atol=1e-12 * np.ptp(y))


def test_narrow_kernel_is_the_nearest_neighbour():
    X, y = data(features=2)
    new = np.random.default_rng(2).random((200, 2)) * 3
    nearest = KNeighborsRegressor(1).fit(X, y).predict(new)
    np.testing.assert_allclose(NadarayaWatson(1e-6).fit(X, y).predict(new), nearest)


def test_wide_kernel_is_the_mean():
    X, y = data()
    found = NadarayaWatson(1e6).fit(X, y).predict([[0.3], [0.9]])
    np.testing.assert_allclose(found, y.mean(), rtol=1e-9)


def test_regression_is_nearer_to_g_than_the_noisy_data_are():
    """Eq. (2.5): of ``f = g + noise`` it finds g, at the points, better than they say it."""
    rng = np.random.default_rng(0)
    X = rng.random((300, 1))
    g = np.sin(5 * X[:, 0])
    f = g + 0.1 * rng.normal(size=300)
    found = NadarayaWatson().fit(X, f).predict(X)
    # Some 20 points share a bandwidth, so that the noise's part falls to about a quarter.
    assert np.std(found - g) < 0.5 * np.std(f - g)


def test_far_from_all_data_it_is_the_nearest_target():
    X, y = data()
    left, right = y[X[:, 0].argmin()], y[X[:, 0].argmax()]
    found = NadarayaWatson(0.05).fit(X, y).predict([[-1e3], [1e3]])
    np.testing.assert_array_equal(found, [left, right])


@settings(max_examples=50)
@given(
    seed=st.integers(0, 2**32 - 1),
    bandwidth=st.floats(1e-3, 10),
    at=st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=5),
)
def test_prediction_stays_within_the_targets(seed, bandwidth, at):
    X, y = data(20, seed=seed)
    found = NadarayaWatson(bandwidth).fit(X, y).predict(np.array(at)[:, None])
    assert (y.min() - 1e-12 <= found).all()
    assert (found <= y.max() + 1e-12).all()


@pytest.mark.parametrize("bandwidth", [0, -1.0, np.nan, np.inf])
def test_bandwidth_that_is_no_length_is_refused(bandwidth):
    with pytest.raises(InvalidInputError, match="bandwidth: expected a finite number > 0"):
        NadarayaWatson(bandwidth).fit([[0.0], [1.0]], [0.0, 1.0])


def test_unknown_kernel_is_refused_with_those_that_are():
    with pytest.raises(InvalidInputError, match=r"gaussian.*box"):
        NadarayaWatson(1.0, "box").fit([[0.0], [1.0]], [0.0, 1.0])


def wave(count=60, noise=0.1):
    rng = np.random.default_rng(3)
    X = rng.random((count, 1))
    return X, np.sin(5 * X[:, 0]) + noise * rng.normal(size=count)


@pytest.mark.parametrize("kernel", ["gaussian", "epanechnikov"])
@pytest.mark.parametrize("bandwidth", [1e-4, 0.05, 2.0])
def test_one_by_one(kernel, bandwidth):
    X, y = wave()
    expected = cross_val_predict(NadarayaWatson(bandwidth, kernel), X, y, cv=LeaveOneOut())
    np.testing.assert_allclose(left_out(X, y, bandwidth, kernel), expected, rtol=1e-12, atol=1e-13)


def test_group_by_group():
    X, y = wave()
    groups = np.arange(60) // 3
    model = NadarayaWatson(0.05)
    expected = cross_val_predict(model, X, y, cv=LeaveOneGroupOut(), groups=groups)
    np.testing.assert_allclose(
        left_out(X, y, 0.05, groups=groups), expected, rtol=1e-12, atol=1e-13
    )


def test_chosen_one_is_the_best_of_those_tried():
    X, y = wave()
    errors = [left_out_error(X, y, b) for b in tried_bandwidths(X)]
    best = best_bandwidth(X, y)
    assert left_out_error(X, y, best) == min(errors) < max(errors)
    assert NadarayaWatson().fit(X, y).bandwidth_ == best


def test_noise_asks_for_a_wider_kernel():
    assert best_bandwidth(*wave(noise=0.5)) > best_bandwidth(*wave(noise=0.01))


def test_scale_of_the_features_scales_the_bandwidth():
    X, y = wave()
    assert best_bandwidth(1000 * X, y) == pytest.approx(1000 * best_bandwidth(X, y), rel=1e-9)


def test_points_in_one_place_have_no_bandwidth():
    with pytest.raises(InvalidInputError, match="not all in one place"):
        best_bandwidth(np.ones((3, 1)), np.arange(3.0))
    model = NadarayaWatson().fit(np.ones((3, 1)), np.arange(3.0))
    np.testing.assert_allclose(model.predict([[1.0], [7.0]]), 1)


def test_nothing_left_is_refused():
    with pytest.raises(InvalidInputError, match="at least two"):
        left_out(np.ones((1, 1)), np.ones(1), 1.0)
