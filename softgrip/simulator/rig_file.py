"""A rig of a reader's own as a file: each parameter with its interval, and how it is known.

A row's name is that of `free_parameters` with the unit, as in the columns of logs. All parameters
of a rig are there, so that the file alone makes the rig again.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import Literal, get_args

from softgrip.errors import DataFileError, InvalidInputError, SoftgripError
from softgrip.files import path_of
from softgrip.kept import write_data
from softgrip.logs.fingers import column
from softgrip.provenance import Provenance, describe
from softgrip.simulator.free_parameters import parameter_values, unit_of, with_values
from softgrip.simulator.parameters import FingerParameters, RigParameters

SCHEMA = "softgrip-rig 1"
COLUMNS = ["parameter [unit]", "value", "low", "high", "status"]

Status = Literal["told", "not told", "measured", "given"]
"""How a parameter is known: by an interval from the logs; by its declared range, of which the logs
say little; from the noise of the logs; or not from the logs at all."""


@dataclass(frozen=True)
class Line:
    """A parameter of a rig.

    Attributes:
        name: As of `free_parameters`.
        value: SI.
        low, high: Ends of its 90 % interval; None where there is none.
        status: How it is known.
    """

    name: str
    value: float
    low: float | None
    high: float | None
    status: Status


@dataclass(frozen=True)
class FittedRig:
    """A rig of a reader's own.

    Attributes:
        rig: Its parameters.
        period: Of the logs, s.
        provenance: Of the logs.
        logs: Name and digest of each.
        lines: One a parameter.
    """

    rig: RigParameters
    period: float
    provenance: Provenance
    logs: tuple[str, ...]
    lines: tuple[Line, ...]


def write_rig(fitted: FittedRig, path: Path, *, source: str) -> Path:
    """Write a rig to a file, and return its path; `source` is the command that made it."""
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for line in fitted.lines:
        ends = ("" if end is None else repr(end) for end in (line.low, line.high))
        named = f"{line.name} [{unit_of(line.name)}]"
        table.writerow([named, repr(line.value), *ends, line.status])
    notes = [f"schema: {SCHEMA}", f"period: {fitted.period!r}", f"logs: {'; '.join(fitted.logs)}"]
    return write_data(
        path, text.getvalue(), source=source, notes="\n".join(notes), provenance=fitted.provenance
    )


def read_rig(path: Path | str) -> FittedRig:
    """Read a rig that `write_rig` wrote.

    Raises:
        DataFileError: If it is no such file, or a row is missing, twice, unknown, or damaged. It
            names the line and the column.
    """
    file = path_of(path)
    provenance = describe(file).provenance
    text = file.read_text(encoding="utf-8").splitlines()
    told = (line[1:].partition(": ") for line in text if line.startswith("#"))
    notes = {name.strip(): value.strip() for name, _, value in told}
    if notes.get("schema") != SCHEMA:
        raise DataFileError(file, expected=f"'# schema: {SCHEMA}'", got=repr(notes.get("schema")))
    first = next((k for k, line in enumerate(text) if not line.startswith("#")), len(text))
    period = _number(file, notes.get("period", ""), "period", first)
    rows = list(csv.reader(text[first:]))
    if not rows or rows[0] != COLUMNS:
        raise DataFileError(
            file, expected=f"the columns {COLUMNS}", got=f"{rows[:1]}", line=first + 1
        )
    lines: dict[str, Line] = {}
    for number, row in enumerate(rows[1:], start=first + 2):
        line = _line(file, row, number)
        if line.name in lines:
            raise DataFileError(file, expected="each parameter once", got=line.name, line=number)
        lines[line.name] = line
    values = {name: line.value for name, line in lines.items()}
    try:
        rig = with_values(_form(values), values)
    except SoftgripError as error:
        raise DataFileError(file, expected="the parameters of a rig", got=str(error)) from None
    if missing := [name for name in parameter_values(rig) if name not in values]:
        raise DataFileError(file, expected=f"a row for {', '.join(missing)}", got="none")
    logs = tuple(notes.get("logs", "").split("; "))
    return FittedRig(rig, period, provenance, logs, tuple(lines.values()))


def lines_of(rig: RigParameters, known: Sequence[Line]) -> tuple[Line, ...]:
    """Return a line for each parameter of a rig; those that are not known otherwise are given."""
    named = {line.name: line for line in known}
    return tuple(
        named.get(name, Line(name, value, None, None, "given"))
        for name, value in parameter_values(rig).items()
    )


def _form(values: dict[str, float]) -> RigParameters:
    """Return a rig with as many fingers and branches of memory as there are names for."""
    fingers = 0
    while any(name.startswith(f"{column('finger', fingers)}.") for name in values):
        fingers += 1
    branches = 0
    while f"finger.memory[{branches}]" in values:
        branches += 1
    one = FingerParameters(
        stiffness=1.0, fractional_power=1.0, inertia=1.0, damping=1.0, torque_per_pressure=1.0,
        rest_volume=1.0, memory=(0.0,) * branches, memory_time=(1.0,) * branches,
    )  # fmt: skip
    return RigParameters((one,) * fingers)


def _line(file: Path, row: list[str], number: int) -> Line:
    if len(row) != len(COLUMNS):
        raise DataFileError(file, expected=f"{len(COLUMNS)} cells", got=str(len(row)), line=number)
    name, _, unit = row[0].removesuffix("]").partition(" [")
    try:
        known = unit_of(name)
    except (InvalidInputError, SoftgripError) as error:
        raise DataFileError(
            file, expected=f"{COLUMNS[0]!r}", got=f"{row[0]!r}: {error}", line=number
        ) from None
    if unit != known:
        raise DataFileError(file, expected=f"{name} in {known}", got=repr(unit), line=number)
    value = _number(file, row[1], "value", number)
    low, high = (
        _number(file, cell, column_, number) if cell else None
        for cell, column_ in zip(row[2:4], COLUMNS[2:4], strict=True)
    )
    if (low is None) != (high is None) or (
        low is not None and high is not None and not low <= value <= high
    ):
        raise DataFileError(
            file,
            expected="columns low <= value <= high, or neither end",
            got=f"{row[1:4]}",
            line=number,
        )
    if row[4] not in get_args(Status):
        raise DataFileError(
            file, expected=f"a status of {get_args(Status)}", got=repr(row[4]), line=number
        )
    return Line(name, value, low, high, row[4])  # type: ignore[arg-type]


def _number(file: Path, cell: str, name: str, number: int) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise DataFileError(
            file, expected=f"a finite number in column {name!r}", got=repr(cell), line=number
        )
    return value
