"""Which regression reads force from voltage best: the four of Figure 2.9, by cross-validation."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import clone
from sklearn.compose import TransformedTargetRegressor
from sklearn.isotonic import IsotonicRegression
from sklearn.linear_model import LinearRegression
from sklearn.model_selection import GridSearchCV, KFold, LeaveOneGroupOut, cross_val_predict
from sklearn.neighbors import KNeighborsRegressor
from sklearn.neural_network import MLPRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

from softgrip.arrays import Floats
from softgrip.tactile.nadaraya_watson import NadarayaWatson

FOLDS = 5
"""Section 2.3 trains on 80 % and tests on 20 %: each fold is such a split."""

NEURONS = 16
"""Of the network's only hidden layer; the text gives none."""


def regressors(seed: int = 0) -> dict[str, Any]:
    """Return the four regressors of Figure 2.9 and one more by name, not fitted.

    The text gives no settings. The network is small, smooth and trained to its end by L-BFGS;
    neighbours, 1 to 10, and the bandwidth are chosen on the training points alone. The last one
    is ours: it has no setting, and knows only that more force never gives less voltage.

    Args:
        seed: Of the network's first weights and of the splits by which neighbours are chosen.
    """
    network = MLPRegressor(
        hidden_layer_sizes=(NEURONS,),
        activation="tanh",
        solver="lbfgs",
        alpha=1e-3,
        max_iter=20_000,
        max_fun=100_000,
        random_state=seed,
    )
    neighbours = GridSearchCV(
        KNeighborsRegressor(),
        {"n_neighbors": range(1, 11)},
        scoring="neg_mean_squared_error",
        cv=KFold(FOLDS, shuffle=True, random_state=seed),
    )
    return {
        "ordinary least squares": LinearRegression(),
        "neural network": TransformedTargetRegressor(
            make_pipeline(StandardScaler(), network), transformer=StandardScaler()
        ),
        "k-nearest neighbours": neighbours,
        "Nadaraya-Watson": NadarayaWatson(),
        "isotonic regression": IsotonicRegression(out_of_bounds="clip"),
    }


def cross_validated(
    model: Any, voltage: Floats, force: Floats, groups: ArrayLike | None = None, *, seed: int = 0
) -> Floats:
    """Return what a model, trained without it, says of each point, N, shape (points,).

    Args:
        model: Regressor of scikit-learn; left unfitted.
        voltage, force: V and N, shapes (points,).
        groups: Labels, shape (points,): one group at a time is left out, such as all points of a
            weight. None for `FOLDS` folds drawn at random, in which the other measurements of a
            weight mostly stay in the training.
        seed: Of that draw.
    """
    split = KFold(FOLDS, shuffle=True, random_state=seed) if groups is None else LeaveOneGroupOut()
    found: Floats = cross_val_predict(
        clone(model), np.asarray(voltage)[:, None], force, groups=groups, cv=split
    )
    return found


def root_mean_square(errors: ArrayLike) -> float:
    """Return the root mean square of errors, same unit.

    >>> root_mean_square([3.0, -4.0])
    3.5355339059327378
    """
    return float(np.sqrt(np.mean(np.square(errors))))


def resampled_root_mean_squares(
    errors: ArrayLike, levels: ArrayLike, *, resamples: int = 10_000, seed: int = 0
) -> Floats:
    """Return the root mean square of errors of levels drawn anew with replacement, bootstrap.

    Whole levels are drawn, for the readings of one are alike: those at the next force would not be.
    The same levels, resamples and seed give the same draws, so that the results of two models can
    be subtracted from each other.

    Args:
        errors, levels: Errors and the level of each, shapes (points,).
        resamples: Number of draws, > 0.
        seed: Of the draws.

    Returns:
        ndarray: Shape (resamples,), unit of the errors.

    >>> resampled_root_mean_squares([3.0, 3.0, 3.0], [0, 0, 1], resamples=2).tolist()
    [3.0, 3.0]
    """
    _, place = np.unique(levels, return_inverse=True)
    squares = np.bincount(place, weights=np.square(errors))
    counts = np.bincount(place)
    drawn = np.random.default_rng(seed).integers(len(counts), size=(resamples, len(counts)))
    return np.asarray(np.sqrt(squares[drawn].sum(axis=1) / counts[drawn].sum(axis=1)))
