"""What a percentage of right answers is worth: the counts behind it, and its interval."""

from dataclasses import dataclass
from fractions import Fraction

from scipy.stats import binomtest

from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Accuracy:
    """Right answers among independent trials.

    Attributes
    ----------
    correct
        Number of right answers, 0 to `total`.
    total
        Number of trials, > 0.

    Raises
    ------
    InvalidInputError
        If the two are not such numbers.

    Examples
    --------
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

    def interval(self, confidence: float = 0.95) -> tuple[float, float]:
        """Return the interval of Clopper and Pearson (1934), shares.

        It covers the true share with at least the confidence asked for, if the trials are
        independent. Contacts of one object are not quite: it is then too narrow.

        Raises
        ------
        InvalidInputError
            If the confidence is not between 0 and 1.
        """
        if not 0 < confidence < 1:
            raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
        low, high = binomtest(self.correct, self.total).proportion_ci(confidence, method="exact")
        return float(low), float(high)


def counts_behind(percent: str, total: int) -> tuple[int, ...]:
    """Return the numbers of right answers of which a printed percentage can be the rounding.

    Parameters
    ----------
    percent
        As printed, such as "96.83".
    total
        Number of trials, > 0.

    Raises
    ------
    InvalidInputError
        If there are no trials.

    Examples
    --------
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
