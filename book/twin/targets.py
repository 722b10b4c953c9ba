"""Printed measurements that a run of the simulated rig yields: ``data/calibration/targets.csv``.

A number that is a printed repeat of another is one target; what the rig is told, such as a setting
or a part, is none.
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError
from softgrip.provenance import data_file, data_rows
from softgrip.reads import remembered

FILE = "calibration/targets.csv"
Relation = Literal["=", "~", "<", ">"]
"""How what is measured should stand to the print, as of its claim: ``~`` is "about", which the
tolerance says; below a print is its size."""


@dataclass(frozen=True)
class Target:
    """One printed measurement.

    Attributes:
        id: Of its claim in ``data/claims/``.
        section, what: Where it stands, and what it is.
        relation: See `Relation`.
        value, unit: As printed, with the sign that the text says in words.
        tolerance: In the same unit, > 0: by how much a rig may be off that is right.
        reason: For the tolerance.
        experiment, quantity: Names of a recipe and of a measure of it.
        hangs_on: Names of the choices that it hangs on beside the rig.
        repeats: Ids of the claims that print it again, or what follows from it alone.
    """

    id: str
    section: str
    what: str
    relation: Relation
    value: float
    unit: str
    tolerance: float
    reason: str
    experiment: str
    quantity: str
    hangs_on: tuple[str, ...]
    repeats: tuple[str, ...]

    def off(self, measured: Floats) -> Floats:
        """Return by how much measured values miss the print, same unit and shape; 0 within a bound.

        >>> upper = Target("x", "", "", "<", 5.0, "%", 0.5, "", "", "", (), ())
        >>> upper.off(np.array([-4.0, -7.0])).tolist()
        [0.0, 2.0]
        """
        if self.relation == "<":
            return np.maximum(np.abs(measured) - self.value, 0.0)
        if self.relation == ">":
            return np.maximum(self.value - measured, 0.0)
        return np.asarray(measured - self.value)

    def given(self, tolerances: Floats) -> Floats:
        """Return what misses by so many tolerances, in the unit; where a bound holds, the bound.

        >>> lower = Target("x", "", "", ">", 5.0, "%", 0.5, "", "", "", (), ())
        >>> lower.given(lower.off(np.array([4.0, 7.0])) / lower.tolerance).tolist()
        [4.0, 5.0]
        """
        return self.value + (-1 if self.relation == ">" else 1) * self.tolerance * tolerances


def _target(row: dict[str, str]) -> Target:
    numbers = {name: float(row[name]) for name in ("value", "tolerance")}
    lists = {name: tuple(row[name].split()) for name in ("hangs_on", "repeats")}
    return Target(**{**row, **numbers, **lists})  # type: ignore[arg-type]


@remembered
def targets() -> tuple[Target, ...]:
    """Read the targets, in the order of the text.

    Raises:
        DataFileError: If an id comes twice, a relation is unknown or a tolerance is not above zero.
    """
    found = tuple(map(_target, data_rows(FILE)))
    for one in found:
        if not (one.tolerance > 0 and one.relation in get_args(Relation)):
            raise DataFileError(
                data_file(FILE).path,
                expected=f"a tolerance > 0, a relation among {get_args(Relation)}",
                got=f"{one}",
            )
    if len({one.id for one in found}) < len(found):
        raise DataFileError(data_file(FILE).path, expected="ids that differ", got="one twice")
    return found
