"""What of a rig and of its experiments is not printed: parameters with their ranges and reasons.

``data/calibration/space.csv`` holds them. A set of values says all that the experiments of the twin
need: `book.twin.rigs` makes the rigs of it. The value that the file names is that of the
calibrated rig, and of what this book chose where the text leaves a choice.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.checks import check_finite
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError
from softgrip.provenance import data_file, data_rows
from softgrip.reads import remembered

FILE = "calibration/space.csv"
Values = Mapping[str, Floats]
"""A value of each parameter for each of some rigs, in the parameter's unit, shape (rigs,)."""
NOTHING: Mapping[str, ArrayLike] = MappingProxyType({})


@dataclass(frozen=True)
class Parameter:
    """One line of the space.

    Attributes:
        name: Group and name, such as ``finger.frequency``; the group ``choice`` holds what an
            experiment leaves open and no rig has.
        unit: Of value, low and high.
        value: Of the calibrated rig, or our choice.
        low, high: Ends of the range; both are the value if it is fixed.
        scale: In what it is even over its range: "linear" or "log".
        status: "free" or "fixed".
        reason: For the range, with its source.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    scale: Literal["linear", "log"]
    status: Literal["free", "fixed"]
    reason: str

    def at(self, share: ArrayLike) -> Floats:
        """Return the value at a share of the range, 0 to 1, any shape."""
        part = np.asarray(share, dtype=np.float64)
        if self.scale == "linear":
            return np.asarray(self.low + part * (self.high - self.low))
        return np.asarray(self.low * (self.high / self.low) ** part)

    def share(self, value: ArrayLike) -> Floats:
        """Return the share of the range at which values lie, the inverse of `at`."""
        own = np.asarray(value, dtype=np.float64)
        if self.scale == "linear":
            return np.asarray((own - self.low) / (self.high - self.low))
        return np.asarray(np.log(own / self.low) / np.log(self.high / self.low))


@remembered
def space() -> Mapping[str, Parameter]:
    """Read the parameters, by name.

    Raises:
        DataFileError: If a name comes twice or a value is outside its range.
    """
    found: dict[str, Parameter] = {}
    for row in data_rows(FILE):
        numbers = {key: float(row[key]) for key in ("value", "low", "high")}
        one = Parameter(**{**row, **numbers})  # type: ignore[arg-type]
        inside = one.low <= one.value <= one.high and (one.scale == "linear" or one.low > 0)
        if one.name in found or not inside or (one.status == "fixed") != (one.low == one.high):
            raise DataFileError(
                data_file(FILE).path,
                expected="each name once, low <= value <= high, equal if fixed, > 0 if log",
                got=f"{one}",
            )
        found[one.name] = one
    return MappingProxyType(found)


def values(rigs: int = 1, changed: Mapping[str, ArrayLike] = NOTHING) -> dict[str, Floats]:
    """Return the file's values for some rigs, but for those that are given.

    Args:
        rigs: Number of rigs, >= 1.
        changed: By name, numbers or shape (rigs,).

    Raises:
        UnknownNameError: If there is no such parameter.
        InvalidInputError: If a value is not finite or has another shape.

    >>> values(2, {"finger.frequency": [2.0, 3.0]})["finger.frequency"].tolist()
    [2.0, 3.0]
    """
    found = {name: np.full(rigs, one.value) for name, one in space().items()}
    for name, given in changed.items():
        if name not in found:
            raise UnknownNameError("parameter", name, list(found))
        check_finite(**{name: given})
        if np.shape(given) not in ((), (rigs,)):
            raise InvalidInputError(name, expected=f"shape ({rigs},)", got=np.shape(given))
        found[name] = np.broadcast_to(np.asarray(given, np.float64), (rigs,))
    return found


def rows(values: Values) -> list[dict[str, float]]:
    """Return the values of each rig by itself."""
    lists = {name: column.tolist() for name, column in values.items()}
    return [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
