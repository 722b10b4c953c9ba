"""Exponentials of many small matrices at once: SciPy takes them one by one."""

import numpy as np

from softgrip.arrays import Floats

TERMS = 18
"""Of the series, of a matrix whose norm is at most a half: what is left out is below rounding."""


def matrix_exponential(matrices: Floats) -> Floats:
    """Return exp(A) of matrices A, shape (..., n, n), by Taylor's series of halved ones, squared.

    >>> matrix_exponential(np.array([[[0.0, 2.0], [0.0, 0.0]]])).tolist()
    [[[1.0, 2.0], [0.0, 1.0]]]
    """
    norm = np.abs(matrices).sum(axis=-1).max(initial=1.0)
    halvings = int(np.ceil(np.log2(norm))) + 1
    part, one = matrices / 2**halvings, np.eye(matrices.shape[-1])
    found = one + part / TERMS
    for k in range(TERMS - 1, 0, -1):
        found = one + part @ found / k
    for _ in range(halvings):
        found = found @ found
    return np.asarray(found)
