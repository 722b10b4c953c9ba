"""What a slider offers: its values, how they are written, and where it starts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from softgrip.errors import InvalidInputError

Value = float | str


def _find(wanted: Value, values: Sequence[Value]) -> int | None:
    """Return the index of a value; a number may be off by rounding, as in ``pi / 2``."""
    if isinstance(wanted, str):
        return values.index(wanted) if wanted in values else None
    numbers = [(abs(v - wanted), i) for i, v in enumerate(values) if not isinstance(v, str)]
    off, nearest = min(numbers, default=(math.inf, 0))
    return nearest if off <= 1e-9 * abs(wanted) else None


@dataclass(frozen=True)
class Slider:
    """The values that one parameter of a figure may take.

    Raises:
        InvalidInputError: If there are fewer than two values, if one is neither a finite number nor
            a string, if two are the same, or if the default is not one of them.
    """

    values: Sequence[Value]
    label: str
    unit: str = ""
    default: Value | None = None
    """The value shown first; None is the first value."""

    def __post_init__(self) -> None:
        name = f"slider {self.label!r}"
        if isinstance(self.values, str):
            raise InvalidInputError(name, expected="a sequence of values", got=self.values)
        values = [v.item() if isinstance(v, np.generic) else v for v in self.values]
        object.__setattr__(self, "values", tuple(values))
        if len(values) < 2:
            raise InvalidInputError(name, expected="at least two values", got=values)
        for value in values:
            if not (isinstance(value, str) or (isinstance(value, Real) and math.isfinite(value))):
                raise InvalidInputError(name, expected="finite numbers or strings", got=value)
        if len(set(values)) < len(values):
            raise InvalidInputError(name, expected="values that differ", got=values)
        if self.default is not None and _find(self.default, values) is None:
            raise InvalidInputError(name, expected=f"a default among {values}", got=self.default)

    @property
    def start(self) -> int:
        """Index of the value that is shown first."""
        return 0 if self.default is None else _find(self.default, self.values) or 0

    def written(self, value: Value) -> str:
        """Return a value with its unit, as the reader sees it."""
        text = value if isinstance(value, str) else f"{value:.6g}"
        return f"{text} {self.unit}".strip()

    @property
    def words(self) -> bool:
        """Whether it chooses among words."""
        return isinstance(self.values[0], str)

    def data(self, name: str) -> dict[str, Any]:
        """Return it as the page's script takes it."""
        return {
            "name": name, "label": self.label, "unit": self.unit, "start": self.start,
            "values": self.values, "steps": len(self.values) - 1,
        }  # fmt: skip


@dataclass(frozen=True)
class Range:
    """A slider over all numbers between two, for a law that the page computes.

    Attributes:
        low, high: The extremes; low < high.
        start: The value shown first.
        label: What is varied, as the reader is told.
        unit: Written behind the number.
        step: What a key moves it by; a two-hundredth of the range without it.
        log: Whether equal ways are equal factors; low is then above 0.

    Raises:
        InvalidInputError: If one of these does not hold.

    >>> Range(14, 23, 20, "a", unit="mm", step=0.1).data("top")["steps"]
    90
    """

    low: float
    high: float
    start: float
    label: str
    unit: str = ""
    step: float | None = None
    log: bool = False

    def __post_init__(self) -> None:
        name = f"slider {self.label!r}"
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise InvalidInputError(name, expected="finite low < high", got=(self.low, self.high))
        if not self.low <= self.start <= self.high:
            raise InvalidInputError(
                name, expected=f"a start from {self.low:g} to {self.high:g}", got=self.start
            )
        if self.log and (self.low <= 0 or self.step is not None):
            raise InvalidInputError(name, expected="low > 0 and no step, if log", got=self)
        if abs(self.steps * (self.step or 0) - (self.step or 0) * self._parts) > 1e-9:
            raise InvalidInputError(name, expected="a step that parts the range", got=self.step)

    @property
    def _parts(self) -> float:
        return (self.high - self.low) / self.step if self.step else 200

    @property
    def steps(self) -> int:
        """How many steps of a key lead from one end to the other."""
        return round(self._parts)

    @property
    def place(self) -> int:
        """The step at which it starts."""
        low, start, high = (
            math.log(value) if self.log else value for value in (self.low, self.start, self.high)
        )
        return round(self.steps * (start - low) / (high - low))

    def data(self, name: str) -> dict[str, Any]:
        """Return it as the page's script takes it."""
        return {
            "name": name, "label": self.label, "unit": self.unit,
            "start": self.place, "begin": self.start, "low": self.low, "high": self.high,
            "steps": self.steps, "log": self.log,
        }  # fmt: skip
