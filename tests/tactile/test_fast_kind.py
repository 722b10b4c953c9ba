"""The compiled bagging classifier gives scikit-learn's shares of votes, to the bit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.exceptions import NotFittedError

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.tactile.contacts import KINDS
from softgrip.tactile.fast_kind import FastKind


def readings(count, seed, *, steps):
    """Return responses in so many steps, half of them zero: the fewer steps, the more ties."""
    rng = np.random.default_rng(seed)
    touched = rng.random((count, 8)) < 0.5
    return np.round(rng.random((count, 8)) * steps) / steps * touched


@settings(max_examples=30)
@given(
    st.integers(0, 10_000),
    st.sampled_from([1, 3, 20, 1023, 10**9]),
    st.integers(1, 5),
    st.integers(1, 8),
    st.booleans(),
)
def test_shares_are_those_of_scikit_learn_ties_and_all(seed, steps, k, features, replacement):
    x = readings(60, seed, steps=steps)
    kinds = np.array(KINDS)[(x > 0).sum(axis=1) // 2 % 3]
    model = bagged_neighbours(
        k=k, estimators=6, features=features, replacement=replacement, seed=seed
    ).fit(x, kinds)
    fast = FastKind.from_fitted(model)
    new = np.concatenate([readings(12, seed + 1, steps=steps), x[:4], 1.5 * x[4:6]])
    found = np.array([fast.predict_proba(reading) for reading in new])
    np.testing.assert_array_equal(found, model.predict_proba(new))
    assert [fast.predict(reading) for reading in new] == model.predict(new).tolist()


def test_a_kind_that_a_draw_leaves_out_gets_no_vote_of_it():
    x = readings(40, 0, steps=20)
    kinds = np.array(["line"] * 39 + ["point"])
    model = bagged_neighbours(k=1).fit(x, kinds)
    assert {one.classes_.size for one in model[-1].estimators_} == {1, 2}
    fast = FastKind.from_fitted(model)
    found = np.array([fast.predict_proba(reading) for reading in x])
    np.testing.assert_array_equal(found, model.predict_proba(x))


def test_classifier_that_is_not_fitted_is_refused():
    with pytest.raises(NotFittedError):
        FastKind.from_fitted(bagged_neighbours())


@pytest.mark.parametrize("bad", [[0.0] * 7, [[0.0] * 8], [0.0] * 7 + [np.nan]])
def test_bad_reading_is_refused(bad):
    x = readings(40, 0, steps=20)
    fast = FastKind.from_fitted(bagged_neighbours().fit(x, ["line"] * 20 + ["point"] * 20))
    with pytest.raises(InvalidInputError, match="8 finite numbers"):
        fast.predict_proba(bad)
