"""The bandwidth of Eq. (2.7), which is not printed: by leaving points out."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.kernel_average import KERNELS, blocks, scaled_squares

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
    """Return what Eq. (2.6) says of each point without it: the diagonal of K left out.

    No fit is repeated; work grows with the square of the points, memory does not.

    Parameters
    ----------
    points, targets
        Shapes (points, features) and (points,).
    bandwidth
        sigma, > 0, unit of the features.
    kernel
        A key of `kernel_average.KERNELS`.
    groups
        Labels, shape (points,): all points of its group are left out with a point. Where each
        weight is measured three times, leaving out one of the three asks for no more than an
        average of the other two.

    Raises
    ------
    InvalidInputError
        If nothing would be left.

    Examples
    --------
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

    Raises
    ------
    InvalidInputError
        If all points are one.
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
