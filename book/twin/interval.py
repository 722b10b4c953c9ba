"""Intervals that should hold nine of ten, and how many do."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats

CLAIMED = 90.0
"""Share of what is so that an interval claims to hold, %."""
CENTRAL = (50 - CLAIMED / 2, 50.0, 50 + CLAIMED / 2)
"""Percentiles of its ends and of its middle."""
NORMAL = 1.6449
"""Half its width for a normal law, in standard deviations."""


@dataclass(frozen=True)
class Interval:
    """What is said of a number, and what it is.

    Attributes:
        low, middle, high: 5, 50 and 95 % of what is said.
        actual: What is printed, or what a known rig has or gives.
    """

    low: float
    middle: float
    high: float
    actual: float

    @property
    def holds(self) -> bool:
        """Whether the number lies within."""
        return self.low <= self.actual <= self.high

    @property
    def needed(self) -> float:
        """By what both sides, from the middle, must be multiplied so that the number lies within.

        >>> [Interval(0.0, 2.0, 3.0, x).needed for x in (1.0, 2.0, 5.0)]
        [0.5, 0.0, 3.0]
        """
        off = self.actual - self.middle
        side = self.high - self.middle if off > 0 else self.middle - self.low
        if off == 0:
            return 0.0
        return abs(off) / side if side else float("inf")


def intervals(percentiles: Floats, actual: Floats) -> list[Interval]:
    """Return the intervals of several numbers, by percentiles of shape (3, numbers)."""
    return [Interval(*row) for row in np.vstack([percentiles, actual]).T.tolist()]


def coverage(given: Collection[Interval]) -> float:
    """Return the share of the intervals that hold, %."""
    return 100 * float(np.mean([one.holds for one in given]))


def widening(given: Collection[Interval]) -> float:
    """Return by what all intervals must be multiplied for as many to hold as they claim.

    Below one where they are wider than they need be.
    """
    return float(np.percentile([one.needed for one in given], CLAIMED, method="inverted_cdf"))
