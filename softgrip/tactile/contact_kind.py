"""Point, line or surface: the kind of a contact from the pad's responses, Eq. (2.3)-(2.4).

All classifiers are pipelines of scikit-learn that first bring each element's responses to 0-1 by
their range in training, as the text does with Eq. (2.3). Nothing of a tested contact enters that
range: a response beyond it is cut to it.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.ensemble import BaggingClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.naive_bayes import GaussianNB
from sklearn.neighbors import KNeighborsClassifier
from sklearn.pipeline import Pipeline, make_pipeline
from sklearn.preprocessing import MinMaxScaler
from sklearn.svm import SVC

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.contacts import KINDS

NEIGHBOURS = 3
"""The k that the dissertation chooses."""

ESTIMATORS, SAMPLES, FEATURES = 25, 0.85, 7
"""Of the bagging classifier: base classifiers, share of contacts and elements that each sees."""


def one_hot(kinds: ArrayLike) -> Floats:
    """Code kinds as in Eq. (2.4), shape (N, 3).

    Raises:
        InvalidInputError: If there is another kind among them.

    >>> one_hot(["line", "point"])
    array([[0., 1., 0.],
           [1., 0., 0.]])
    """
    given = np.asarray(kinds)
    if unknown := set(given.ravel().tolist()) - set(KINDS):
        raise InvalidInputError("kinds", expected=f"some of {KINDS}", got=sorted(unknown, key=str))
    return np.asarray(given[..., None] == np.array(KINDS), dtype=np.float64)


def from_one_hot(codes: ArrayLike) -> NDArray[np.str_]:
    """Return the kinds of codes, shape (N,); the inverse of `one_hot`.

    Raises:
        InvalidInputError: If a row is not three numbers, one of them 1 and the others 0. Three
            classifiers that vote on each entry alone can give such a row: neither point, nor line,
            nor surface.

    >>> from_one_hot([[0, 0, 1]])
    array(['surface'], dtype='<U7')
    """
    given = np.asarray(codes)
    if given.ndim != 2 or given.shape[1] != len(KINDS):
        raise InvalidInputError("codes", expected=f"shape (N, {len(KINDS)})", got=given.shape)
    bad = ~(np.isin(given, (0, 1)).all(axis=1) & (given.sum(axis=1) == 1))
    if bad.any():
        raise InvalidInputError(
            "codes", expected="rows with one 1 and zeros", got=given[bad][0].tolist()
        )
    return np.asarray(np.array(KINDS)[given.argmax(axis=1)])


def _normalised(classifier: Any) -> Pipeline:
    return make_pipeline(MinMaxScaler(clip=True), classifier)


def nearest_neighbours(k: int = NEIGHBOURS) -> Pipeline:
    """Return the k-nearest neighbour classifier, k >= 1, not fitted."""
    # Chosen by name: "auto" would decide by the number of contacts, and with it how ties fall.
    return _normalised(KNeighborsClassifier(k, algorithm="kd_tree"))


def bagged_neighbours(
    *,
    k: int = NEIGHBOURS,
    estimators: int = ESTIMATORS,
    samples: float | int = SAMPLES,
    features: int = FEATURES,
    replacement: bool = True,
    seed: int = 0,
) -> Pipeline:
    """Return the bagging classifier on k-nearest neighbours, not fitted.

    Its answer is the mean of the base classifiers' shares of votes, as in the text.

    Args:
        k: Neighbours of a base classifier; the text does not give it, the single classifier's is 3.
        estimators: Number of base classifiers.
        samples: Share of the contacts that each is trained on, a float in (0, 1]; or their number,
            an int.
        features: Number of elements that each sees, drawn without replacement.
        replacement: Whether the contacts are drawn with replacement. The text does not say; bagging
            by Breiman (1996) does.
        seed: Of the draws.
    """
    return _normalised(
        BaggingClassifier(
            KNeighborsClassifier(k, algorithm="kd_tree"),
            n_estimators=estimators,
            max_samples=samples,
            max_features=int(features),  # a float would be a share
            bootstrap=replacement,
            random_state=seed,
            n_jobs=1,
        )
    )


def classifiers(seed: int = 0) -> dict[str, Pipeline]:
    """Return the four classifiers of the text and the bagged one, by name, not fitted.

    The text gives the settings of the neighbours only. The others have scikit-learn's; the
    support vector machine is tried with both common kernels.
    """
    return {
        "k-nearest neighbours": nearest_neighbours(),
        "support vectors, Gaussian kernel": _normalised(SVC(kernel="rbf")),
        "support vectors, linear": _normalised(SVC(kernel="linear")),
        "naive Bayes": _normalised(GaussianNB()),
        "logistic regression": _normalised(LogisticRegression(max_iter=1000)),
        "bagged neighbours": bagged_neighbours(seed=seed),
    }
