"""How often a classifier of contact kinds is right: on contacts, and on objects, it never felt.

Most functions return which contacts it gets right, one boolean each, so that two classifiers can
be compared contact by contact.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import clone
from sklearn.model_selection import (
    GroupKFold,
    StratifiedGroupKFold,
    StratifiedKFold,
    cross_val_predict,
    train_test_split,
)

from softgrip.arrays import Floats, floats, one_number
from softgrip.checks import check_finite
from softgrip.errors import InvalidInputError
from softgrip.tactile.accuracy import Accuracy

Right = NDArray[np.bool_]
FOLDS = 5
TEST_SHARE = 0.2


def accuracy(right: Right) -> Accuracy:
    """Count the contacts that are classified rightly."""
    return Accuracy(int(right.sum()), right.size)


def train_and_test(
    kinds: ArrayLike, *, seed: int, test: float = TEST_SHARE, groups: ArrayLike | None = None
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Split contacts at random, with the kinds' shares kept: indices to train and to test on.

    With groups, as of `cross_validated`, no group is on both sides, and the share is that of one
    fold of as many as come nearest to it.

    >>> train, test = train_and_test(["point", "line", "surface"] * 210, seed=0)
    >>> train.size, test.size
    (504, 126)
    """
    one_number(seed=seed, test=test)
    labels = np.asarray(kinds)
    _, counts = np.unique(labels, return_counts=True)
    if labels.ndim != 1 or min(counts, default=0) < 2 or not 0 < test < 1:
        raise InvalidInputError(
            "kinds, test", expected="two of each or more, and a share", got=(counts.tolist(), test)
        )
    if groups is not None:
        count = round(1 / test)
        _check_folds(labels, groups, count)
        folds = StratifiedGroupKFold(count, shuffle=True, random_state=seed)
        train, tested = next(folds.split(labels, labels, groups))
        return train, tested
    train, tested = train_test_split(
        np.arange(labels.size), test_size=test, random_state=seed, stratify=labels
    )
    return train, tested


def _check_folds(labels: NDArray[Any], groups: ArrayLike | None, folds: int) -> None:
    """Refuse more folds than a kind has groups, or contacts: some fold would have none of it."""
    units = np.arange(labels.size) if groups is None else np.asarray(groups)
    counts = {str(kind): np.unique(units[labels == kind]).size for kind in np.unique(labels)}
    rarest = min(counts, key=lambda kind: counts[kind])
    what = "contacts" if groups is None else "groups"
    if counts[rarest] < 2:
        raise InvalidInputError(
            "labels", expected=f"two {what} or more of each kind", got=f"one of {rarest}"
        )
    if not 2 <= folds <= counts[rarest]:
        raise InvalidInputError(
            "folds", expected=f"2 to {counts[rarest]}, the {what} of the kind {rarest}", got=folds
        )


def _rows(responses: ArrayLike, kinds: ArrayLike) -> tuple[Floats, NDArray[Any]]:
    """Return responses and kinds of one number of rows, checked."""
    (found,), labels = floats(responses=responses), np.asarray(kinds)
    if found.ndim != 2 or labels.shape != (len(found),) or not found.size:
        raise InvalidInputError(
            "responses, kinds",
            expected="shapes (N, elements) and (N,)",
            got=(found.shape, labels.shape),
        )
    check_finite(responses=found)
    return found, labels


def cross_validated(
    model: Any,
    responses: ArrayLike,
    kinds: ArrayLike,
    *,
    seed: int,
    folds: int = FOLDS,
    groups: ArrayLike | None = None,
) -> Right:
    """Tell which contacts are right when each fold is left out in turn, at random.

    With groups a fold is made of whole ones: of whole presses, say, where a press is many rows.

    Args:
        model: A classifier of scikit-learn; a copy is fitted.
        responses: Shape (N, elements).
        kinds: Shape (N,).
        seed: Of the folds.
        folds: Their number, >= 2.
        groups: Such as `PadReadings.groups`, shape (N,); None if each contact is one of its own.

    Raises:
        InvalidInputError: If a kind has fewer groups, or contacts, than there are folds: some fold
            would have none of it.
    """
    one_number(seed=seed, folds=folds)
    responses, labels = _rows(responses, kinds)
    _check_folds(labels, groups, folds)
    make = StratifiedKFold if groups is None else StratifiedGroupKFold
    parts = make(folds, shuffle=True, random_state=seed)
    found = cross_val_predict(model, responses, labels, groups=groups, cv=parts)
    return np.asarray(found == labels)


def cross_validated_by_object(
    model: Any, responses: ArrayLike, kinds: ArrayLike, objects: ArrayLike
) -> Right:
    """Tell which contacts are right when each *object* is left out in turn.

    Args:
        model, responses, kinds: As in `cross_validated`.
        objects: What touched the pad, shape (N,); at least two objects.

    Raises:
        InvalidInputError: If all contacts are of one object.
    """
    responses, labels = _rows(responses, kinds)
    groups = np.asarray(objects)
    count = np.unique(groups).size
    if count < 2:
        raise InvalidInputError("objects", expected="at least two objects", got=count)
    parts = GroupKFold(count)
    found = cross_val_predict(model, responses, labels, groups=groups, cv=parts)
    return np.asarray(found == labels)


def right_on_new(
    model: Any,
    responses: ArrayLike,
    kinds: ArrayLike,
    new_responses: ArrayLike,
    new_kinds: ArrayLike,
) -> Right:
    """Tell which new contacts are right after training on the others."""
    fitted = clone(model).fit(np.asarray(responses), np.asarray(kinds))
    return np.asarray(fitted.predict(np.asarray(new_responses)) == np.asarray(new_kinds))


@dataclass(frozen=True)
class SplitScore:
    """What Section 2.3 reports of a classifier, from one split.

    Attributes:
        cross_validated: On the 80 % that it is trained on: the text's training accuracy. A contact
            is never among those that it is compared with.
        tested: On the other 20 %.
    """

    cross_validated: Accuracy
    tested: Accuracy


def split_score(
    model: Any,
    responses: ArrayLike,
    kinds: ArrayLike,
    *,
    seed: int,
    groups: ArrayLike | None = None,
) -> SplitScore:
    """Split contacts in two, cross-validate on the larger part, test on the other.

    Args:
        model, responses, kinds, groups: As in `cross_validated`.
        seed: Of the split and of the folds.
    """
    x, y = np.asarray(responses), np.asarray(kinds)
    train, test = train_and_test(y, seed=seed, groups=groups)
    own = None if groups is None else np.asarray(groups)[train]
    return SplitScore(
        accuracy(cross_validated(model, x[train], y[train], seed=seed, groups=own)),
        accuracy(right_on_new(model, x[train], y[train], x[test], y[test])),
    )
