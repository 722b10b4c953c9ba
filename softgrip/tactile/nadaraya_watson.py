"""Nadaraya-Watson regression, Eq. (2.5)-(2.7), as a regressor of scikit-learn, and its bandwidth.

The bandwidth is not printed: it is found by leaving points out.
"""

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.kernel_average import (
    KERNELS,
    blocks,
    exact_average,
    fast_average,
    scaled_squares,
)

STEPS = 61
"""Bandwidths that are tried."""

FINEST = 1e-3
"""The narrowest one, as a part of the diameter of the points; the widest is the diameter."""


def left_out(
    points: Floats,
    targets: Floats,
    bandwidth: float,
    kernel: str = "gaussian",
    groups: ArrayLike | None = None,
) -> Floats:
    """Return what the kernel average says of each point without it: the diagonal of K left out.

    No fit is repeated; work grows with the square of the points, memory does not.

    Args:
        points, targets: Shapes (points, features) and (points,).
        bandwidth: sigma, > 0, unit of the features.
        kernel: A key of `KERNELS`.
        groups: Labels, shape (points,): all points of its group are left out with a point. Where
            each weight is measured three times, leaving out one of the three asks for no more than
            an average of the other two.

    Raises:
        InvalidInputError: If nothing would be left.

    >>> left_out(np.array([[0.0], [1.0], [3.0]]), np.array([0.0, 1.0, 3.0]), 0.1).round(9)
    array([1., 0., 1.])
    """
    labels = np.arange(len(points)) if groups is None else np.asarray(groups)
    if len(set(labels.tolist())) < 2:
        raise InvalidInputError("points", expected="at least two, or two groups", got=len(points))
    found = np.empty(len(points))
    for rows in blocks(len(points), len(points)):
        squares = scaled_squares(points[rows], points, bandwidth)
        squares[labels[rows, None] == labels] = np.inf
        weights = KERNELS[kernel](squares)
        found[rows] = weights @ targets / weights.sum(axis=1)
    return found


def left_out_error(
    points: Floats,
    targets: Floats,
    bandwidth: float,
    kernel: str = "gaussian",
    groups: ArrayLike | None = None,
) -> float:
    """Return the root mean square of targets less `left_out`, unit of the targets."""
    errors = targets - left_out(points, targets, bandwidth, kernel, groups)
    return float(np.sqrt(np.mean(errors**2)))


def tried_bandwidths(points: Floats) -> Floats:
    """Return the bandwidths that `best_bandwidth` tries, in equal ratios.

    Raises:
        InvalidInputError: If all points are one.
    """
    diameter = float(np.linalg.norm(np.ptp(points, axis=0)))
    if not diameter > 0:
        raise InvalidInputError("points", expected="not all in one place", got=points[0].tolist())
    return np.geomspace(FINEST * diameter, diameter, STEPS)


def best_bandwidth(
    points: Floats,
    targets: Floats,
    kernel: str = "gaussian",
    groups: ArrayLike | None = None,
) -> float:
    """Return the one of `tried_bandwidths` with the least `left_out_error`.

    Neighbours in the row differ by 12 %, to which the error is blind near its minimum; a search
    in between would only follow the points' noise, and the error has more minima than one.
    """
    tried = tried_bandwidths(points)
    errors = [left_out_error(points, targets, float(b), kernel, groups) for b in tried]
    return float(tried[int(np.argmin(errors))])


class NadarayaWatson(RegressorMixin, BaseEstimator):  # type: ignore[misc]
    """The average of the targets, weighted by a kernel of the distance.

    Eq. (2.6) prints one index for the sum and its bound, and f_i within it; read here as the sum
    over the data, f_n their forces. The sigma of Eq. (2.7) is called a covariance; it is a length
    in the unit of the features.

    Args:
        bandwidth: sigma, > 0, one for all features; None chooses it by leaving out one point at a
            time.
        kernel: "gaussian", Eq. (2.7), or "epanechnikov", which ends at one bandwidth.

    Attributes:
        bandwidth_: The sigma that is used.

    Far from all data the Gaussian weights underflow and Eq. (2.6) is 0/0 as it stands. They are
    taken relative to that of the nearest point, so that the prediction tends to its target; beyond
    the ends of the data it never leaves their range. With one feature, a Gaussian kernel and many
    queries, they are answered by `fast_average`, to 4e-13 of the range of the targets.

    >>> model = NadarayaWatson(bandwidth=0.1).fit([[0.0], [1.0], [2.0]], [0.0, 0.3, 0.7])
    >>> model.predict([[1.0], [1.5], [1e6]]).round(9).tolist()
    [0.3, 0.5, 0.7]
    """

    def __init__(self, bandwidth: float | None = None, kernel: str = "gaussian") -> None:
        self.bandwidth = bandwidth
        self.kernel = kernel

    def fit(self, X: ArrayLike, y: ArrayLike) -> Self:
        """Keep data of Eq. (2.5), targets that are g of the points and noise; choose the bandwidth.

        Args:
            X, y: Shapes (points, features) and (points,), finite.

        Raises:
            InvalidInputError: If the bandwidth is not above zero or the kernel is unknown.
        """
        points: Floats
        points, y = validate_data(self, X, y, dtype=np.float64, y_numeric=True)
        if self.kernel not in KERNELS:
            raise InvalidInputError("kernel", expected=f"one of {[*KERNELS]}", got=self.kernel)
        if self.bandwidth is not None and not 0 < self.bandwidth < np.inf:
            raise InvalidInputError(
                "bandwidth", expected="a finite number > 0 or None", got=self.bandwidth
            )
        self.X_, self.y_ = points, np.asarray(y, dtype=np.float64)
        if self.bandwidth is not None:
            self.bandwidth_ = float(self.bandwidth)
        elif np.ptp(points, axis=0).any():
            self.bandwidth_ = best_bandwidth(points, self.y_, self.kernel)
        else:
            self.bandwidth_ = 1.0  # all points in one place have one weight, whatever it is
        return self

    def predict(self, X: ArrayLike) -> Floats:
        """Return the averages, shape (queries,), for queries of shape (queries, features)."""
        check_is_fitted(self)
        asked: Any = validate_data(self, X, dtype=np.float64, reset=False)
        if self.kernel == "gaussian" and asked.shape[1] == 1:
            return fast_average(asked[:, 0], self.X_[:, 0], self.y_, self.bandwidth_)
        return exact_average(asked, self.X_, self.y_, self.bandwidth_, self.kernel)
