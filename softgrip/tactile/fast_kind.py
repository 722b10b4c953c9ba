"""The fitted bagging classifier as arrays: one reading in a fraction of a millisecond.

scikit-learn asks its base classifiers one after the other and checks the reading anew for each.
Here all distances are taken in one go. The answer is the same to the bit.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.neighbors import KDTree
from sklearn.pipeline import Pipeline
from sklearn.utils.validation import check_is_fitted

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

CLOSE = 1e-12
"""Relative difference of squared distances that is a tie: some processors round otherwise."""


@dataclass(frozen=True)
class FastKind:
    """A fitted `contact_kind.bagged_neighbours`, for one reading at a time.

    Attributes:
        classes: Kinds in scikit-learn's order, shape (K,).
        scale, offset: Of each element, to bring its response to 0-1, shape (C,).
        features: Elements that each base classifier sees, shape (F, B, 1).
        contacts: Responses that they were trained on, shape (F, B, N).
        votes: Kinds of these, one-hot, shape (B, N, K).
        k: Neighbours that vote.
        trees: The base classifiers' search trees. Which of several contacts at one distance votes
            is decided by the order of the tree; where that matters, the tree is asked.
    """

    classes: NDArray[Any]
    scale: Floats
    offset: Floats
    features: NDArray[np.intp]
    contacts: Floats
    votes: Floats
    k: int
    trees: tuple[KDTree, ...]

    @classmethod
    def from_fitted(cls, model: Pipeline) -> "FastKind":
        """Compile a fitted bagging classifier.

        Raises:
            sklearn.exceptions.NotFittedError: If it is not fitted.
        """
        check_is_fitted(model)
        scaler, bagging = model[0], model[-1]
        base = bagging.estimators_
        kinds = bagging.classes_

        # A draw can leave a kind out: a base classifier numbers those that it knows.
        seen = [one.classes_[one._y] for one in base]
        return cls(
            kinds,
            scaler.scale_,
            scaler.min_,
            np.stack(bagging.estimators_features_, axis=1)[..., None],
            np.ascontiguousarray(np.stack([one._fit_X for one in base]).transpose(2, 0, 1)),
            np.stack([np.eye(kinds.size)[each] for each in seen]),
            base[0].n_neighbors,
            tuple(one._tree for one in base),
        )

    def predict_proba(self, response: ArrayLike) -> Floats:
        """Return the share of each kind, shape (K,), for one reading, shape (C,).

        Raises:
            InvalidInputError: If the reading does not have the model's number of elements, or is
                not finite.
        """
        given = np.asarray(response, dtype=np.float64)
        if given.shape != self.scale.shape or not np.isfinite(given).all():
            raise InvalidInputError(
                "response", expected=f"{self.scale.size} finite numbers", got=given.tolist()
            )
        point = np.clip(given * self.scale + self.offset, 0.0, 1.0)
        squared = np.zeros(self.contacts.shape[1:])
        # One element after the other, as in the search tree: the same rounding, and arrays that
        # are small enough for the processor's cache.
        for seen, values in zip(self.features, self.contacts, strict=True):
            apart = values - point[seen]
            apart *= apart
            squared += apart
        farthest = np.partition(squared, self.k - 1, axis=1)[:, self.k - 1, None]
        return np.asarray(self._shares(point, squared, farthest).sum(axis=0) / len(self.trees))

    def _shares(self, point: Floats, squared: Floats, farthest: Floats) -> Floats:
        """Return each base classifier's shares of votes, shape (B, K)."""
        up_to = np.matmul((squared <= farthest * (1 + CLOSE))[:, None].astype(float), self.votes)
        nearest = up_to[:, 0]
        for one in np.flatnonzero(nearest.sum(axis=1) > self.k):
            below = (squared[one] < farthest[one] * (1 - CLOSE)) @ self.votes[one]
            at_the_edge = nearest[one] - below
            if np.count_nonzero(at_the_edge) == 1:
                # All that are tied for the last places are of one kind: it gets these places.
                nearest[one] = below + np.sign(at_the_edge) * (self.k - below.sum())
            else:
                seen = point[self.features[:, one, 0]][None]
                chosen = self.trees[one].query(seen, self.k, return_distance=False)[0]
                nearest[one] = self.votes[one][chosen].sum(axis=0)
        return np.asarray(nearest / self.k)

    def predict(self, response: ArrayLike) -> str:
        """Return the kind of one reading, shape (C,)."""
        return str(self.classes[self.predict_proba(response).argmax()])
