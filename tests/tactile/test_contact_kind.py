"""Eq. (2.4) and the classifiers, against votes counted by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_kind import (
    bagged_neighbours,
    classifiers,
    from_one_hot,
    nearest_neighbours,
    one_hot,
)
from softgrip.tactile.contacts import KINDS


def felt(count=90, seed=0):
    """Return made-up responses of three kinds that overlap: shape (count, 8), and the kinds."""
    rng = np.random.default_rng(seed)
    kinds = np.array(KINDS)[np.arange(count) % 3]
    pressed = np.array([{"point": 1, "line": 3, "surface": 8}[kind] for kind in kinds])
    order = rng.permuted(np.tile(np.arange(8), (count, 1)), axis=1)
    return np.clip((order < pressed[:, None]) * 0.5 + rng.normal(0, 0.25, (count, 8)), 0, 1), kinds


@given(st.lists(st.sampled_from(KINDS), min_size=1))
def test_code_and_back(kinds):
    codes = one_hot(kinds)
    assert codes.sum(axis=1).tolist() == [1.0] * len(kinds)
    assert from_one_hot(codes).tolist() == kinds


def test_codes_are_those_of_figure_2_6():
    """Eq. (2.4)."""
    assert one_hot(["point", "line", "surface"]).tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


@pytest.mark.parametrize("bad", [[[0, 0, 0]], [[1, 1, 0]], [[0.5, 0.5, 0]], [[1, 0]], [1, 0, 0]])
def test_what_codes_no_kind_is_refused(bad):
    with pytest.raises(InvalidInputError, match="codes"):
        from_one_hot(bad)


def test_unknown_kind_is_refused():
    with pytest.raises(InvalidInputError, match="'edge'"):
        one_hot(["point", "edge"])


@settings(max_examples=25)
@given(st.integers(1, 10), st.integers(0, 1000))
def test_neighbours_vote_as_counted_by_hand(k, seed):
    x, kinds = felt()
    new = felt(5, seed)[0]
    low, high = x.min(axis=0), x.max(axis=0)
    scaled, asked = (x - low) / (high - low), np.clip((new - low) / (high - low), 0, 1)
    model = nearest_neighbours(k).fit(x, kinds)
    near = np.linalg.norm(scaled[None] - asked[:, None], axis=2).argsort(axis=1)[:, :k]
    votes = np.stack([(kinds[near] == name).mean(axis=1) for name in model.classes_], axis=1)
    assert model.predict_proba(new) == pytest.approx(votes)


def test_bagging_is_the_mean_of_its_parts_as_in_the_text():
    x, kinds = felt(100)
    model = bagged_neighbours().fit(x, kinds)
    bagging = model[-1]
    assert len(bagging.estimators_) == 25
    assert {len(drawn) for drawn in bagging.estimators_samples_} == {85}
    assert {len(set(seen.tolist())) for seen in bagging.estimators_features_} == {7}
    scaled = model[0].transform(x)
    parts = [
        one.predict_proba(scaled[:, seen])
        for one, seen in zip(bagging.estimators_, bagging.estimators_features_, strict=True)
    ]
    assert model.predict_proba(x) == pytest.approx(np.mean(parts, axis=0))


def test_drawing_with_replacement_repeats_contacts_and_without_does_not():
    x, kinds = felt(100)
    for replacement in (True, False):
        bagging = bagged_neighbours(replacement=replacement).fit(x, kinds)[-1]
        repeats = [len(set(d.tolist())) < len(d) for d in bagging.estimators_samples_]
        assert repeats == [replacement] * 25


@pytest.mark.parametrize("name", classifiers())
def test_every_classifier_learns_kinds_that_lie_apart(name):
    rng = np.random.default_rng(1)
    kinds = np.repeat(KINDS, 20)
    x = np.repeat(np.eye(3, 8), 20, axis=0) + rng.normal(0, 0.05, (60, 8))
    model = classifiers()[name].fit(x[::2], kinds[::2])
    assert (model.predict(x[1::2]) == kinds[1::2]).all()


def test_seed_decides_all():
    x, kinds = felt()
    new = felt(30, seed=5)[0]
    first, again, other = (
        bagged_neighbours(seed=seed).fit(x, kinds).predict_proba(new) for seed in (0, 0, 1)
    )
    assert (first == again).all()
    assert (first != other).any()
