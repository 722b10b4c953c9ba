"""Small matrices of floats or of symbols: what NumPy, SciPy and python-control do for floats only.

CasADi's own operations take both; a loop takes them apart again, as lists of numbers.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats, Number

Matrix = ca.SX | ca.DM
Rows = Sequence[Sequence[Number]] | Floats


def matrix(rows: Rows) -> Matrix:
    """Return a CasADi matrix, of symbols if one of its elements is.

    >>> matrix([[1.0, 2.0], [3.0, 4.0]]).shape, matrix([[ca.SX.sym("x")]]).shape
    ((2, 2), (1, 1))
    """
    found: Matrix = ca.vertcat(*(ca.horzcat(*row) for row in rows))
    return found


def numbers(*matrices: Matrix) -> list[Number]:
    """Return the elements of matrices, row by row, as a loop is given them.

    >>> numbers(matrix([[1.0, 2.0], [3.0, 4.0]]), matrix([[5.0]]))
    [1.0, 2.0, 3.0, 4.0, 5.0]
    """
    return [
        float(element) if isinstance(element, ca.DM) else element
        for each in matrices
        for element in ca.vertsplit(ca.densify(ca.vec(each.T)))
    ]


def taken(elements: Iterator[Number], rows: int, columns: int) -> list[list[Number]]:
    """Take the next matrix from what `numbers` returned.

    >>> taken(iter([1.0, 2.0, 3.0, 4.0]), 2, 2)
    [[1.0, 2.0], [3.0, 4.0]]
    """
    return [list(islice(elements, columns)) for _ in range(rows)]


def times(rows: Rows, *vectors: Sequence[Number]) -> list[Number]:
    """Return a matrix times the vectors one below the other.

    >>> times([[1.0, 2.0, 3.0]], [1.0, 1.0], [2.0])
    [9.0]
    """
    vector = [element for part in vectors for element in part]
    return [sum(a * x for a, x in zip(row, vector, strict=True)) for row in rows]


def array(rows: Iterable[Iterable[Number]]) -> NDArray[Any]:
    """Return a NumPy array that holds symbols one by one, if there are any.

    Its products and sums are those of symbols; what wants floats, such as `numpy.linalg`, fails.

    >>> array([[1.0, 2.0]]).dtype.name, array([[1.0, ca.SX.sym("x")]]).dtype.name
    ('float64', 'object')
    """
    elements = [list(row) for row in rows]
    if not any(isinstance(value, ca.SX) for row in elements for value in row):
        return np.array(elements, dtype=np.float64)
    made = np.empty((len(elements), len(elements[0])), dtype=object)
    for place in np.ndindex(made.shape):
        made[place] = elements[place[0]][place[1]]
    return made


def bilinear(
    A: Matrix, B: Matrix, C: Matrix, D: Matrix, period: float
) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Return a system sampled by Tustin's rule, as `scipy.signal.cont2discrete` does it for floats.

    Args:
        A, B, C, D: In continuous time, 1/s.
        period: s, > 0.

    >>> [float(part) for part in bilinear(*map(ca.DM, (-1.0, 1.0, 1.0, 0.0)), 2.0)]
    [0.0, 1.0, 0.5, 0.5]
    """
    one, half = ca.DM.eye(A.shape[0]), period / 2
    left = one - half * A
    B_sampled = ca.solve(left, period * B)
    return (
        ca.solve(left, one + half * A),
        B_sampled,
        ca.solve(left.T, C.T).T,
        D + C @ B_sampled / 2,
    )
