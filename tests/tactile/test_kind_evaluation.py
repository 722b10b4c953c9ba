"""Splits keep what they promise: no contact, and no object, is tested on what it was trained on."""

import numpy as np
import pytest
from sklearn.base import BaseEstimator, ClassifierMixin
from sklearn.neighbors import KNeighborsClassifier

from softgrip.errors import InvalidInputError
from softgrip.tactile import kind_evaluation

KINDS = np.array(["point", "line", "surface"])


class Remembers(ClassifierMixin, BaseEstimator):
    """Is right on a reading it was trained on, and else says what is never true."""

    def fit(self, x, y):
        self.classes_ = np.unique(y)
        self.known_ = dict(zip(x[:, 0].tolist(), y, strict=True))
        return self

    def predict(self, x):
        return np.array([self.known_.get(value, "nothing") for value in x[:, 0].tolist()])


def numbered(count):
    return np.arange(count, dtype=float)[:, None], KINDS[np.arange(count) % 3]


def test_split_is_504_and_126_with_the_shares_kept():
    _, kinds = numbered(630)
    train, test = kind_evaluation.train_and_test(kinds, seed=3)
    assert sorted([*train, *test]) == list(range(630))
    assert (train.size, test.size) == (504, 126)
    assert [(kinds[test] == kind).sum() for kind in KINDS] == [42, 42, 42]


def test_no_contact_is_tested_on_itself():
    x, kinds = numbered(60)
    assert not kind_evaluation.cross_validated(Remembers(), x, kinds, seed=0).any()
    score = kind_evaluation.split_score(Remembers(), x, kinds, seed=0)
    assert (score.cross_validated.correct, score.cross_validated.total) == (0, 48)
    assert (score.tested.correct, score.tested.total) == (0, 12)


def test_no_object_is_tested_on_itself_though_its_contacts_at_random_are():
    objects = np.repeat(np.arange(6), 10)
    x = objects[:, None].astype(float)  # all contacts of an object are alike
    kinds = KINDS[objects % 3]
    assert kind_evaluation.cross_validated(Remembers(), x, kinds, seed=0).all()
    assert not kind_evaluation.cross_validated_by_object(Remembers(), x, kinds, objects).any()


def test_right_answers_are_those_of_the_fitted_model():
    rng = np.random.default_rng(0)
    x, kinds = rng.random((40, 2)), KINDS[np.arange(40) % 3]
    model = KNeighborsClassifier(1)
    right = kind_evaluation.right_on_new(model, x[:30], kinds[:30], x[30:], kinds[30:])
    nearest = np.linalg.norm(x[30:, None] - x[None, :30], axis=2).argmin(axis=1)
    assert right.tolist() == (kinds[nearest] == kinds[30:]).tolist()
    assert kind_evaluation.accuracy(right).correct == right.sum()
    assert not hasattr(model, "classes_")  # a copy was fitted


def test_one_object_cannot_be_left_out():
    x, kinds = numbered(6)
    with pytest.raises(InvalidInputError, match="at least two objects"):
        kind_evaluation.cross_validated_by_object(Remembers(), x, kinds, ["egg"] * 6)


def test_no_press_is_tested_on_itself_when_presses_are_groups():
    presses = np.repeat(np.arange(30), 8)
    x = presses[:, None].astype(float)  # all samples of a press are alike
    kinds = KINDS[presses % 3]
    assert kind_evaluation.cross_validated(Remembers(), x, kinds, seed=0).all()
    right = kind_evaluation.cross_validated(Remembers(), x, kinds, seed=0, groups=presses)
    assert not right.any()


def test_samples_of_presses_that_say_nothing_are_right_by_chance_only_with_groups():
    """A press lies anywhere, whatever its kind: two in three are wrong."""
    rng = np.random.default_rng(0)
    presses = np.repeat(np.arange(60), 10)
    x = rng.random((60, 2))[presses] + 0.01 * rng.normal(size=(600, 2))
    kinds = KINDS[presses % 3]
    model = KNeighborsClassifier(5)
    assert kind_evaluation.cross_validated(model, x, kinds, seed=0).mean() > 0.9
    right = kind_evaluation.cross_validated(model, x, kinds, seed=0, groups=presses)
    # The standard deviation of the share over 60 presses is 6 %.
    assert abs(right.mean() - 1 / 3) < 0.2


def test_more_folds_than_contacts_or_groups_of_a_kind_are_refused():
    x, kinds = numbered(12)
    with pytest.raises(InvalidInputError, match="2 to 4, the contacts of the kind line"):
        kind_evaluation.cross_validated(Remembers(), x, kinds, seed=0)
    with pytest.raises(InvalidInputError, match="2 to 2, the groups of the kind line"):
        kind_evaluation.cross_validated(
            Remembers(), x, kinds, seed=0, folds=3, groups=np.arange(12) // 6
        )


def test_no_press_is_on_both_sides_of_a_split():
    presses = np.repeat(np.arange(60), 3)
    kinds = np.array(["point", "line", "surface"])[presses % 3]
    train, test = kind_evaluation.train_and_test(kinds, seed=0, groups=presses)
    assert not set(presses[train]) & set(presses[test])
    assert len(test) == pytest.approx(0.2 * len(kinds), rel=0.1)
    with pytest.raises(InvalidInputError, match="two groups or more of each kind"):
        kind_evaluation.train_and_test(kinds[:9], seed=0, groups=presses[:9])
