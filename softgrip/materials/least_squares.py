"""Ordinary least squares as in Eq. (5.3) and (5.4), and how far its prediction can be trusted."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import stdtrit

from softgrip.arrays import Floats, Number, floats
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


@dataclass(frozen=True)
class LinearFit:
    """Least squares, and what tells how far a further response may lie off.

    Attributes:
        coefficients: x of Eq. (5.3), shape (p,).
        inverse: Of the normal matrix, shape (p, p).
        variance: Of the errors.
        freedom: Degrees of freedom, m - p.
    """

    coefficients: Floats
    inverse: NDArray[np.floating]
    variance: float
    freedom: int

    def response(
        self, predictors: Sequence[Number] | Floats, confidence: float
    ) -> tuple[Number, Number]:
        """Return the response to a row of predictors, and half the interval for measuring it.

        Args:
            predictors: p floats or symbols.
            confidence: Between 0 and 1, both excluded.
        """
        value = sum(c * a for c, a in zip(self.coefficients, predictors, strict=True))
        leverage = sum(
            predictors[i] * element * predictors[j]
            for (i, j), element in np.ndenumerate(self.inverse)
        )
        t = stdtrit(self.freedom, (1 + confidence) / 2)
        return value, t * np.sqrt(self.variance * (1 + leverage))


def linear_fit(A: Floats, y: Floats) -> LinearFit:
    """Fit responses y, shape (m,), to predictors A, shape (m, p), m > p.

    Raises:
        InvalidInputError: As of `normal_equations`, and if m <= p: no error can be estimated.
    """
    x, (m, p) = normal_equations(A, y), A.shape
    if m <= p:
        raise InvalidInputError("A", expected="shape (m, p), m > p", got=A.shape)
    variance = float(np.sum((y - A @ x) ** 2) / (m - p))
    return LinearFit(x, np.linalg.inv(A.T @ A), variance, m - p)


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
    fit = linear_fit(A, y)
    if a.shape != fit.coefficients.shape:
        raise InvalidInputError(
            "A, a", expected="shapes (m, p) and (p,) with m > p", got=(A.shape, a.shape)
        )
    if not 0 < confidence < 1:
        raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
    value, half = map(float, fit.response(a, confidence))
    return Prediction(value, value - half, value + half, confidence)
