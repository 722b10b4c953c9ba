"""Nadaraya-Watson regression, Eq. (2.5)-(2.7), as a regressor of scikit-learn."""

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.bandwidth import best_bandwidth
from softgrip.tactile.kernel_average import KERNELS, exact_average
from softgrip.tactile.kernel_sum import fast_average


class NadarayaWatson(RegressorMixin, BaseEstimator):  # type: ignore[misc]
    """The average of the targets, weighted by a kernel of the distance.

    Eq. (2.6) prints one index for the sum and its bound, and f_i within it; read here as the sum
    over the data, f_n their forces. The sigma of Eq. (2.7) is called a covariance; it is a length
    in the unit of the features.

    Parameters
    ----------
    bandwidth
        sigma, > 0, one for all features; None chooses it by leaving out one point at a time.
    kernel
        "gaussian", Eq. (2.7), or "epanechnikov", which ends at one bandwidth.

    Attributes
    ----------
    bandwidth_
        The sigma that is used.

    Notes
    -----
    Far from all data the Gaussian weights underflow and Eq. (2.6) is 0/0 as it stands. They are
    taken relative to that of the nearest point, so that the prediction tends to its target; beyond
    the ends of the data it never leaves their range. With one feature, a Gaussian kernel and many
    queries, they are answered by `kernel_sum.fast_average`, to 4e-13 of the range of the targets.

    Examples
    --------
    >>> model = NadarayaWatson(bandwidth=0.1).fit([[0.0], [1.0], [2.0]], [0.0, 0.3, 0.7])
    >>> model.predict([[1.0], [1.5], [1e6]]).round(9).tolist()
    [0.3, 0.5, 0.7]
    """

    def __init__(self, bandwidth: float | None = None, kernel: str = "gaussian") -> None:
        self.bandwidth = bandwidth
        self.kernel = kernel

    def fit(self, X: ArrayLike, y: ArrayLike) -> Self:
        """Keep the data and choose the bandwidth.

        Parameters
        ----------
        X, y
            Shapes (points, features) and (points,), finite.

        Raises
        ------
        InvalidInputError
            If the bandwidth is not above zero or the kernel is unknown.
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
        """Return Eq. (2.6), shape (queries,), for queries of shape (queries, features)."""
        check_is_fitted(self)
        asked: Any = validate_data(self, X, dtype=np.float64, reset=False)
        if self.kernel == "gaussian" and asked.shape[1] == 1:
            return fast_average(asked[:, 0], self.X_[:, 0], self.y_, self.bandwidth_)
        return exact_average(asked, self.X_, self.y_, self.bandwidth_, self.kernel)
