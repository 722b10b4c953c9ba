"""Levenberg's and Marquardt's least squares, for a batch of small fits at once."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats

Which = NDArray[np.intp]
"""Numbers of some fits, shape (fits,)."""
Model = Callable[[Floats, Which], Floats]
"""``model(x, which)`` gives residuals, shape (fits, N), for parameters (fits, P)."""

STEP = 1e-5
"""Of the central differences; parameters are logarithms, or of the size of one."""
STIFFEST = 1e8
"""Damping beyond which no step lowers a sum of squares."""


def jacobian(model: Model, x: Floats, which: Which) -> Floats:
    """Return the derivative of the residuals, shape (fits, N, P), by central differences."""
    count = x.shape[1]
    moved = np.repeat(x[None], 2 * count, axis=0)
    for k in range(count):
        moved[k, :, k] += STEP
        moved[count + k, :, k] -= STEP
    found = model(moved.reshape(-1, count), np.tile(which, 2 * count))
    both = found.reshape(2, count, len(x), -1)
    return np.moveaxis((both[0] - both[1]) / (2 * STEP), 0, -1)


def fit(model: Model, start: Floats, *, most: int = 60, tolerance: float = 1e-10) -> Floats:
    """Return the parameters with the least sum of squares that is reached from a start.

    A fit ends when a step that lowers its sum does so by less than a share of `tolerance`, or when
    no step lowers it.

    Args:
        model: Of the residuals.
        start: Shape (fits, P).
        most: Largest number of steps.
        tolerance: Least share.

    >>> line = lambda x, which: x[:, :1] * np.arange(4.0) + x[:, 1:] - np.array([1.0, 3, 5, 7])
    >>> fit(line, np.zeros((1, 2))).round(6).tolist()
    [[2.0, 1.0]]
    """
    x = np.array(start, dtype=np.float64)
    left = np.arange(len(x))
    damping, cost = np.full(len(x), 1e-3), np.sum(model(x, left) ** 2, axis=1)
    for _ in range(most):
        if not left.size:
            break
        now, before = x[left], cost[left]
        slopes, off = jacobian(model, now, left), model(now, left)
        normal = np.einsum("fnp,fnq->fpq", slopes, slopes)
        pull = np.einsum("fnp,fn->fp", slopes, off)
        size = np.einsum("fpp->fp", normal)
        # A parameter that moves nothing would leave the matrix singular.
        weight = damping[left, None] * size + 1e-14 * size.max(axis=1, keepdims=True) + 1e-300
        step = np.linalg.solve(normal + weight[:, None] * np.eye(x.shape[1]), pull[..., None])
        trial = now - step[..., 0]
        with np.errstate(all="ignore"):
            tried = np.sum(model(trial, left) ** 2, axis=1)
        better = tried < before
        x[left[better]], cost[left[better]] = trial[better], tried[better]
        damping[left] *= np.where(better, 0.2, 5.0)
        small = better & (before - tried <= tolerance * before)
        left = left[~(small | (damping[left] > STIFFEST))]
    return x
