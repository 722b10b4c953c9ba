"""What right answers are worth: their counts and interval, and whether two classifiers differ.

The difference is tested by McNemar's exact test (1947). Trials that both classifiers get right or
both get wrong say nothing of a difference. Of the others, each is as likely to be the first one's
as the second one's, if the two are equally good.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import binomtest

from softgrip.errors import InvalidInputError

CONFIDENCE = 0.95
"""Of an interval, unless another is asked for."""


@dataclass(frozen=True)
class Accuracy:
    """Right answers among independent trials.

    Attributes:
        correct: Number of right answers, 0 to `total`.
        total: Number of trials, > 0.

    Raises:
        InvalidInputError: If the two are not such numbers.

    >>> found = Accuracy(77, 80)
    >>> found.share
    0.9625
    >>> [round(limit, 3) for limit in found.interval()]
    [0.894, 0.992]
    """

    correct: int
    total: int

    def __post_init__(self) -> None:
        if not 0 <= self.correct <= self.total or self.total == 0:
            raise InvalidInputError(
                "correct, total", expected="0 <= correct <= total, total > 0",
                got=(self.correct, self.total),
            )  # fmt: skip

    @property
    def share(self) -> float:
        """Right answers by trials, 0 to 1."""
        return self.correct / self.total

    def interval(self, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Return the interval of Clopper and Pearson (1934), shares.

        It covers the true share with at least the confidence asked for, if the trials are
        independent. Contacts of one object are not quite: it is then too narrow.

        Raises:
            InvalidInputError: If the confidence is not between 0 and 1.
        """
        if not 0 < confidence < 1:
            raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
        low, high = binomtest(self.correct, self.total).proportion_ci(confidence, method="exact")
        return float(low), float(high)


def counts_behind(percent: str, total: int) -> tuple[int, ...]:
    """Return the numbers of right answers of which a printed percentage can be the rounding.

    Args:
        percent: As printed, such as "96.83".
        total: Number of trials, > 0.

    Raises:
        InvalidInputError: If there are no trials.

    >>> counts_behind("96.83", 126), counts_behind("96.83", 630), counts_behind("96.83", 504)
    ((122,), (610,), (488,))
    >>> counts_behind("96.43", 630)
    ()
    """
    if total <= 0:
        raise InvalidInputError("total", expected="a number > 0", got=total)
    # Fractions: a percentage that lies half way between two prints fits both, exactly.
    half = Fraction(1, 2 * 10 ** len(percent.partition(".")[2]))
    return tuple(
        k for k in range(total + 1) if abs(Fraction(100 * k, total) - Fraction(percent)) <= half
    )


@dataclass(frozen=True)
class McNemar:
    """Trials that only one of two classifiers gets right.

    Attributes:
        only_first, only_second: How many, >= 0.

    Raises:
        InvalidInputError: If one is negative.

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

    Args:
        first_right, second_right: Whether each trial was classified rightly, booleans, shape (N,).

    Raises:
        InvalidInputError: If the two are not of one shape (N,).
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

    Args:
        first, second: Right answers of the two classifiers, 0 to `total`.
        total: Trials, the same for both.

    Raises:
        InvalidInputError: If a number lies outside its range.

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
