"""Kernel averages, Eq. (2.6) and (2.7), as they stand: any kernel, any number of features."""

from collections.abc import Callable, Iterator

import numpy as np
from scipy.spatial.distance import cdist

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

BLOCK = 2**18
"""Numbers that an intermediate array may hold: 2 MB, so that it stays in the cache."""

Kernel = Callable[[Floats], Floats]


def gaussian(squares: Floats) -> Floats:
    """Return Eq. (2.7) from squared distances by sigma^2, each row times what makes its largest 1.

    The factor cancels in Eq. (2.6), which is then never 0/0: far from all points it tends to the
    target of the nearest.
    """
    weights: Floats = np.exp(-0.5 * (squares - squares.min(axis=1, keepdims=True)))
    return weights


def epanechnikov(squares: Floats) -> Floats:
    """Return 1 - d^2 where d < 1, else 0; a row without any such point falls to its nearest."""
    weights = np.clip(1 - squares, 0, None)
    empty = ~weights.any(axis=1)
    weights[empty] = squares[empty] == squares[empty].min(axis=1, keepdims=True)
    return weights


KERNELS: dict[str, Kernel] = {"gaussian": gaussian, "epanechnikov": epanechnikov}
"""Weights by kernel, of squared distances by the squared bandwidth, shape (queries, points)."""


def blocks(count: int, width: int) -> Iterator[slice]:
    """Cut `count` rows of a width into slices of at most `BLOCK` numbers, or of one row."""
    step = max(1, BLOCK // max(1, width))
    return (slice(start, min(start + step, count)) for start in range(0, count, step))


def scaled_squares(queries: Floats, points: Floats, bandwidth: float) -> Floats:
    """Return squared distances by the squared bandwidth, shape (queries, points).

    Raises
    ------
    InvalidInputError
        If one is too large for a floating-point number.
    """
    # Squared last: a bandwidth of 1e-200 has no square.
    with np.errstate(over="ignore"):
        squares: Floats = (cdist(queries, points) / bandwidth) ** 2
    if not np.isfinite(squares.max()):
        raise InvalidInputError("X", expected="distances below 1e150 bandwidths", got="farther")
    return squares


def exact_average(
    queries: Floats, points: Floats, targets: Floats, bandwidth: float, kernel: str = "gaussian"
) -> Floats:
    """Return Eq. (2.6) as it stands, block by block.

    Parameters
    ----------
    queries, points
        Shapes (queries, features) and (points, features).
    targets
        Shape (points,).
    bandwidth
        sigma, > 0, unit of the features.
    kernel
        A key of `KERNELS`.
    """
    found = np.empty(len(queries))
    for rows in blocks(len(queries), len(points)):
        weights = KERNELS[kernel](scaled_squares(queries[rows], points, bandwidth))
        found[rows] = weights @ targets / weights.sum(axis=1)
    return found
