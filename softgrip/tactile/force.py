"""Contact force from the voltage of the force-measurement layer: weights, accuracy, Table 2.2."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType

from scipy.stats import foldnorm, t

from softgrip.arrays import one_number
from softgrip.errors import InvalidInputError
from softgrip.provenance import data_rows
from softgrip.reads import remembered
from softgrip.tactile.accuracy import CONFIDENCE
from softgrip.units import GRAM_FORCE

TABLE_2_2 = "tactile/table_2_2.csv"

WEIGHTS = (1, 2, 2.5, 3, 4, 5, 7, 8, 10, 12, 14, 15, 20, 25, 30, 35, 40, 45, 50, 60, 65, 70)
"""The weights of Section 2.3 that the layer was calibrated with, gram-force."""

SET = (1, 2, 5, 10, 20, 50, 70)
"""The pieces that Section 2.3 makes them of, gram-force."""


@dataclass(frozen=True)
class Weighing:
    """An object measured several times.

    Attributes:
        measured, deviation: Mean, and standard deviation of one measurement; any unit.
        true: What a scale says, > 0, same unit.
        times: Number of measurements, >= 2.

    Raises:
        InvalidInputError: If the true weight is not above zero, a deviation below, or the times
            fewer than two.
    """

    measured: float
    deviation: float
    true: float
    times: int = 10

    def __post_init__(self) -> None:
        one_number(**vars(self))
        if not (self.true > 0 and self.deviation >= 0 and self.times >= 2):
            raise InvalidInputError(
                "weighing", expected="true > 0, deviation >= 0, times >= 2", got=self
            )

    @property
    def accuracy(self) -> float:
        """How near the mean is to the truth: ``1 - |measured - true| / true``.

        >>> round(Weighing(13.85, 0.37, 14).accuracy, 3)
        0.989
        """
        return 1 - abs(self.measured - self.true) / self.true

    @property
    def accuracy_of_one(self) -> float:
        """How near one measurement is, on average, if they scatter normally about the mean."""
        if self.deviation == 0:
            return self.accuracy
        off = abs(self.measured - self.true) / self.deviation
        return 1 - float(foldnorm.mean(off, scale=self.deviation)) / self.true

    def interval(self, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Return Student's interval of the mean, in the unit of the weights."""
        half = (
            float(t.ppf((1 + confidence) / 2, self.times - 1)) * self.deviation / sqrt(self.times)
        )
        return self.measured - half, self.measured + half

    @property
    def bias_p(self) -> float:
        """Two-sided p of Student's test that the mean is the true weight.

        Raises:
            InvalidInputError: If the deviation is zero: there is then nothing to hold the bias
                against.
        """
        if self.deviation == 0:
            raise InvalidInputError("deviation", expected="a number > 0", got=0)
        statistic = abs(self.measured - self.true) / (self.deviation / sqrt(self.times))
        return float(2 * t.sf(statistic, self.times - 1))


@remembered
def table_2_2() -> Mapping[str, Weighing]:
    """Return the rows of Table 2.2 by object, N; each is the mean of ten measurements."""

    def cell(row: dict[str, str], name: str) -> float:
        return float(row[f"{name} [gf]"]) * GRAM_FORCE

    return MappingProxyType(
        {
            row["object"]: Weighing(
                cell(row, "measured"), cell(row, "deviation"), cell(row, "true")
            )
            for row in data_rows(TABLE_2_2)
        }
    )
