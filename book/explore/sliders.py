"""What a slider offers: its values, how they are written, and where it starts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from book.explore.frames import MAX_FRAMES
from softgrip.errors import InvalidInputError

Value = float | str


def _find(wanted: Value, values: Sequence[Value]) -> int | None:
    """Return the index of a value; a number may be off by rounding, as in ``pi / 2``."""
    if isinstance(wanted, str):
        return values.index(wanted) if wanted in values else None
    numbers = [(abs(v - wanted), i) for i, v in enumerate(values) if not isinstance(v, str)]
    off, nearest = min(numbers, default=(math.inf, 0))
    return nearest if off <= 1e-9 * abs(wanted) else None


def _tidy(values: np.ndarray) -> list[float]:
    """Round far below the step: a figure prints 0.3, not 0.30000000000000004."""
    step = float(np.min(np.abs(np.diff(values))))
    digits = 9 - math.floor(math.log10(step)) if step > 0 else 15
    return [round(float(value), digits) for value in values]


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
    continuous: bool = False
    """Whether a live slider may also stop between the values, which are then all numbers."""

    def __post_init__(self) -> None:
        name = f"slider {self.label!r}"
        if isinstance(self.values, str):
            raise InvalidInputError(name, expected="a sequence of values", got=self.values)
        values = [v.item() if isinstance(v, np.generic) else v for v in self.values]
        object.__setattr__(self, "values", tuple(values))
        if len(values) < 2:
            raise InvalidInputError(name, expected="at least two values", got=values)
        for value in values:
            if isinstance(value, str) and not self.continuous:
                continue
            if not (isinstance(value, Real) and math.isfinite(value)):
                expected = "finite numbers" + ("" if self.continuous else " or strings")
                raise InvalidInputError(name, expected=expected, got=value)
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

    def finer(self, times: int = 10) -> "Slider":
        """Return a slider with ``times`` as many steps, if this one is continuous.

        >>> slider(0, 1, 2, label="Strain").finer(4).values
        (0.0, 0.25, 0.5, 0.75, 1.0)
        """
        if not self.continuous:
            return self
        count = len(self.values)
        at = np.linspace(0, count - 1, (count - 1) * times + 1)
        between = np.interp(at, np.arange(count), np.asarray(self.values, dtype=float))
        values = _tidy(between)
        values[::times] = [float(value) for value in self.values]
        return Slider(values, self.label, self.unit, self.values[self.start], continuous=True)


def slider(
    low: float, high: float, steps: int, *, label: str, unit: str = "", default: float | None = None
) -> Slider:
    """Return a slider over evenly spaced numbers, which a live page divides more finely.

    Args:
        low, high: The extremes; low < high.
        steps: How many values there are, extremes included: 2 to 125. Each is a frame in the built
            page.
        label: What is varied, as the reader is told.
        unit: Written behind the number.
        default: The value shown first, one of the steps; without it, ``low``.

    Raises:
        InvalidInputError: If an argument is outside its range.

    >>> slider(0, 60, 4, label="Pressure", unit="kPa", default=20).values
    (0.0, 20.0, 40.0, 60.0)
    """
    name = f"slider {label!r}"
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise InvalidInputError(name, expected="finite low < high", got=(low, high))
    if not 2 <= steps <= MAX_FRAMES:
        raise InvalidInputError(name, expected=f"2 to {MAX_FRAMES} steps", got=steps)
    return Slider(_tidy(np.linspace(low, high, steps)), label, unit, default, continuous=True)


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
