"""Whether two classifiers differ on the same trials: McNemar's exact test (1947).

Trials that both get right or both get wrong say nothing of a difference. Of the others, each is
as likely to be the first one's as the second one's, if the two are equally good.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import binomtest

from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class McNemar:
    """Trials that only one of two classifiers gets right.

    Attributes
    ----------
    only_first, only_second
        How many, >= 0.

    Raises
    ------
    InvalidInputError
        If one is negative.

    Examples
    --------
    >>> McNemar(0, 3).p_value
    0.25
    """

    only_first: int
    only_second: int

    def __post_init__(self) -> None:
        if min(self.only_first, self.only_second) < 0:
            raise InvalidInputError(
                "only_first, only_second", expected="numbers >= 0",
                got=(self.only_first, self.only_second),
            )  # fmt: skip

    @property
    def p_value(self) -> float:
        """Chance of a difference at least as large between equally good ones, two-sided."""
        differing = self.only_first + self.only_second
        # With nothing that differs there is no test to make, and no sign of a difference.
        return float(binomtest(self.only_first, differing).pvalue) if differing else 1.0


def mcnemar(first_right: ArrayLike, second_right: ArrayLike) -> McNemar:
    """Compare two classifiers on the same trials.

    Parameters
    ----------
    first_right, second_right
        Whether each trial was classified rightly, booleans, shape (N,).

    Raises
    ------
    InvalidInputError
        If the two are not of one shape (N,).
    """
    first: NDArray[np.bool_] = np.asarray(first_right, dtype=bool)
    second: NDArray[np.bool_] = np.asarray(second_right, dtype=bool)
    if first.ndim != 1 or first.shape != second.shape:
        raise InvalidInputError(
            "first_right, second_right", expected="two arrays of one shape (N,)",
            got=(first.shape, second.shape),
        )  # fmt: skip
    return McNemar(int((first & ~second).sum()), int((second & ~first).sum()))


def overlaps(first: int, second: int, total: int) -> list[McNemar]:
    """Return all that two numbers of right answers leave open, by what both get wrong.

    Parameters
    ----------
    first, second
        Right answers of the two classifiers, 0 to `total`.
    total
        Trials, the same for both.

    Raises
    ------
    InvalidInputError
        If a number lies outside its range.

    Examples
    --------
    >>> [round(test.p_value, 3) for test in overlaps(74, 77, 80)]
    [0.508, 0.453, 0.375, 0.25]
    """
    if not (0 <= first <= total and 0 <= second <= total):
        raise InvalidInputError(
            "first, second", expected=f"numbers in [0, {total}]", got=(first, second)
        )
    wrong_first, wrong_second = total - first, total - second
    least = max(0, wrong_first + wrong_second - total)
    return [
        McNemar(wrong_second - both, wrong_first - both)
        for both in range(least, min(wrong_first, wrong_second) + 1)
    ]
