"""Ordinary least squares as in Eq. (5.3) and (5.4), and how far its prediction can be trusted."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import t as student_t

from softgrip.arrays import Floats, floats
from softgrip.checks import check_finite, takes_numbers
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Prediction:
    """A predicted response with the interval that should hold a new measured one.

    Attributes:
        value: Prediction.
        low, high: Ends of the interval.
        confidence: Probability that a new response lies within it, if the model holds.
    """

    value: float
    low: float
    high: float
    confidence: float


@takes_numbers
def normal_equations(A: ArrayLike, y: ArrayLike) -> Floats:
    """Solve ``A x = y``, Eq. (5.3), for the least sum of squares, Eq. (5.4).

    The product of A with its transpose squares the condition number, so the columns should be of
    one order of magnitude; those of Eq. (5.7) are.

    Args:
        A: One row for each of m observations, one column for each of p predictors, shape (m, p).
        y: Responses, shape (m,).

    Returns:
        ndarray: Coefficients x, shape (p,).

    Raises:
        InvalidInputError: If the shapes do not fit, m < p, or a column depends on others (no
            inverse exists).

    >>> normal_equations([[1, 0], [0, 2], [0, 0]], [3, 4, 5]).tolist()
    [3.0, 2.0]
    """
    A, y = floats(A=A, y=y)
    if A.ndim != 2 or y.shape != A.shape[:1]:
        raise InvalidInputError("A, y", expected="shapes (m, p) and (m,)", got=(A.shape, y.shape))
    check_finite(A=A, y=y)
    rank, p = int(np.linalg.matrix_rank(A)), A.shape[1]
    if rank < p:
        raise InvalidInputError("A", expected=f"{p} independent columns", got=f"rank {rank}")
    return np.asarray(np.linalg.solve(A.T @ A, A.T @ y), dtype=np.float64)


@takes_numbers
def prediction_interval(
    A: ArrayLike, y: ArrayLike, a: ArrayLike, *, confidence: float = 0.95
) -> Prediction:
    """Predict the response of a new row and the interval for measuring it, by Student's t.

    It holds when the response is linear in the columns with independent normal errors of one
    spread. An intercept is a column of ones in `A` and a one in `a`.

    Args:
        A: Predictors of the m known rows, shape (m, p), m > p.
        y: Responses of the known rows, shape (m,).
        a: Predictors of the new row, shape (p,).
        confidence: Between 0 and 1, both excluded.

    Raises:
        InvalidInputError: If m <= p (no error can be estimated), a shape does not fit, the columns
            depend on each other, or `confidence` is out of range.

    >>> prediction_interval([[1], [1], [1]], [1, 2, 3], [1], confidence=0.5).value
    2.0
    """
    A, y, a = floats(A=A, y=y, a=a)
    check_finite(a=a)
    x = normal_equations(A, y)
    m, p = A.shape
    if m <= p or a.shape != (p,):
        raise InvalidInputError(
            "A, a", expected="shapes (m, p) and (p,) with m > p", got=(A.shape, a.shape)
        )
    if not 0 < confidence < 1:
        raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
    variance = np.sum((y - A @ x) ** 2) / (m - p)
    leverage = a @ np.linalg.solve(A.T @ A, a)
    half = student_t.ppf((1 + confidence) / 2, m - p) * np.sqrt(variance * (1 + leverage))
    value = float(a @ x)
    return Prediction(value, value - float(half), value + float(half), confidence)
