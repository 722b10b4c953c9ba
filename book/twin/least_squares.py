"""Levenberg's and Marquardt's least squares, for a batch of small fits at once."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats

Which = NDArray[np.intp]
"""Numbers of some fits, shape (fits,)."""
Residual = Callable[[Floats, Which], Floats]
"""``residual(x, which)`` gives residuals, shape (fits, N), for parameters (fits, P)."""
Squares = Callable[[Floats, Which], tuple[Floats, Floats, Floats]]
"""The same, but it gives their sum of squares r' r, J' r and J' J, shapes (fits,), (fits, P) and
(fits, P, P); J holds the derivatives of the residuals."""

STEP = 1e-5
"""Of the central differences; parameters are logarithms, or of the size of one."""
STIFFEST = 1e8
"""Damping beyond which no step lowers a sum of squares."""


def differences(residual: Residual) -> Squares:
    """Return the squares of residuals, with derivatives by central differences."""

    def squares(x: Floats, which: Which) -> tuple[Floats, Floats, Floats]:
        fits, count = x.shape
        moved = np.repeat(x[None], 1 + 2 * count, axis=0)
        for k in range(count):
            moved[1 + 2 * k, :, k] += STEP
            moved[2 + 2 * k, :, k] -= STEP
        with np.errstate(all="ignore"):
            found = residual(moved.reshape(-1, count), np.tile(which, len(moved)))
            found = found.reshape(len(moved), fits, -1)
            slopes = np.moveaxis((found[1::2] - found[2::2]) / (2 * STEP), 0, 1)
            pull = np.matmul(slopes, found[0][..., None])[..., 0]
            return np.sum(found[0] ** 2, axis=1), pull, slopes @ slopes.swapaxes(1, 2)

    return squares


def fit(squares: Squares, start: Floats, *, most: int = 60, tolerance: float = 1e-10) -> Floats:
    """Return the parameters with the least sum of squares that is reached from a start.

    A fit ends when a step that lowers its sum does so by less than a share of `tolerance`, or when
    no step lowers it.

    Args:
        squares: Of the residuals; see `differences`.
        start: Shape (fits, P).
        most: Largest number of steps.
        tolerance: Least share.

    >>> line = lambda x, which: x[:, :1] * np.arange(4.0) + x[:, 1:] - np.array([1.0, 3, 5, 7])
    >>> fit(differences(line), np.zeros((1, 2))).round(6).tolist()
    [[2.0, 1.0]]
    """
    x = np.array(start, dtype=np.float64)
    left, damping = np.arange(len(x)), np.full(len(x), 1e-3)
    cost, pull, normal = squares(x, left)
    for _ in range(most):
        if not left.size:
            break
        size = np.einsum("fpp->fp", normal[left])
        # A parameter that moves nothing would leave the matrix singular.
        weight = damping[left, None] * size + 1e-14 * size.max(axis=1, keepdims=True) + 1e-300
        steep = normal[left] + weight[:, None] * np.eye(x.shape[1])
        trial = x[left] - np.linalg.solve(steep, pull[left][..., None])[..., 0]
        tried = squares(trial, left)
        before = cost[left]
        better = tried[0] < before
        x[left[better]] = trial[better]
        for known, new in zip((cost, pull, normal), tried, strict=True):
            known[left[better]] = new[better]
        damping[left] *= np.where(better, 0.2, 5.0)
        small = better & (before - tried[0] <= tolerance * before)
        left = left[~(small | (damping[left] > STIFFEST))]
    return x
