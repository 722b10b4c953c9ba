"""Readings of a reader's own pad: a CSV of named channels and what touched the pad.

::

    e1,e2,e3,kind
    0.42,0.03,0.05,point
    0.40,0.38,0.04,line

Lines that start with ``#`` are comments. The pad may have any number of channels.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError
from softgrip.quantities import convert
from softgrip.text_table import TextTable, read_table

Labels = NDArray[np.str_] | Floats
ALWAYS = 7
"""Steps in a row by which a channel rises by chance once in 40,320 readings of so many."""
NO_CHANNELS = frozenset(("", "t", "time", "timestamp", "index", "id", "row", "sample", "no", "nr"))
"""Names of columns that say when or which, in small letters."""


@dataclass(frozen=True)
class PadReadings:
    """N labelled readings of a pad with C channels.

    Attributes:
        channels: Names, C of them, all different.
        voltages: V, finite, shape (N, C).
        labels: Kinds of contact as strings, or forces [N] as finite numbers, shape (N,).

    Raises:
        InvalidInputError: If a shape or a number is not as said.
    """

    channels: tuple[str, ...]
    voltages: Floats
    labels: Labels

    def __post_init__(self) -> None:
        voltages, labels = read_only(self.voltages), np.asarray(self.labels)
        if not self.channels or len(set(self.channels)) < len(self.channels):
            raise InvalidInputError(
                "channels", expected="one or more different names", got=self.channels
            )
        if voltages.ndim != 2 or voltages.shape[1] != len(self.channels) or not len(voltages):
            raise InvalidInputError(
                "voltages", expected=f"shape (N, {len(self.channels)}), N > 0", got=voltages.shape
            )
        if labels.shape != voltages.shape[:1]:
            raise InvalidInputError(
                "labels", expected=f"shape {voltages.shape[:1]}", got=labels.shape
            )
        numbers = (voltages, labels) if labels.dtype.kind == "f" else (voltages,)
        if not all(np.isfinite(values).all() for values in numbers):
            raise InvalidInputError(
                "voltages, labels", expected="finite numbers", got="NaN or infinity"
            )
        object.__setattr__(self, "voltages", voltages)
        object.__setattr__(self, "labels", labels)

    def take(self, chosen: ArrayLike) -> Self:
        """Return some of the readings, chosen as by an index of NumPy (a mask, or numbers)."""
        index = np.asarray(chosen)
        return type(self)(self.channels, self.voltages[index], self.labels[index])


def read_readings(
    path: Path | str,
    *,
    label: str,
    channels: Sequence[str] = (),
    unit: float | None = None,
) -> PadReadings:
    """Read a table of voltages and labels, as of `softgrip.text_table`.

    Columns that name no unit are in V; a label that names one is a force.

    Args:
        path: Of the file.
        label: The column of kinds or weights.
        channels: The columns of voltages; all others than the label if none are named. One that
            does not change, or as a time or a number of the row does, must be named.
        unit: Newtons of one unit of the label, such as ``softgrip.units.GRAM_FORCE``, if its column
            names none; labels are strings without any.

    Raises:
        DataFileError: If there is no such file or column, a row has more or fewer cells than there
            are columns, a unit is none of a voltage or force, a cell is no finite number, a label
            is empty, or a column cannot be a channel; names the line.
    """
    table = read_table(path)
    if label not in table.names and "event" in table.names:
        got = f"{', '.join(table.names)}; a log is read by softgrip.logs.contacts"
        raise table.refusal(f"a column {label!r}", got)
    at = table.column(label)
    chosen = [table.column(name) for name in channels]
    others = [k for k in range(len(table.names)) if k != at]
    labels = _labels(table, at, unit)
    voltages = {k: _volts(table, k) for k in chosen or others}
    if not channels:
        _check_channels(table, voltages, labels)
    names = tuple(table.names[k] for k in voltages)
    return PadReadings(names, np.stack([*voltages.values()], axis=1), labels)


def _volts(table: TextTable, at: int) -> Floats:
    values, unit = table.numbers(at), table.units[at]
    return _converted(table, at, values, unit, "V") if unit else values


def _labels(table: TextTable, at: int, unit: float | None) -> Labels:
    """Return kinds, or forces in N."""
    cells, own = table.cells(at), table.units[at]
    for line, cell in zip(table.lines, cells, strict=True):
        if not cell:
            raise table.refusal(f"a label under {table.names[at]}", "an empty cell", line)
    if not own:
        return np.array(cells) if unit is None else unit * table.numbers(at)
    forces = _converted(table, at, table.numbers(at), own, "N")
    if unit is not None and not np.isclose(float(convert(1.0, own, "N")), unit):
        raise table.refusal(f"a label in units of {unit:g} N", f"{table.headings[at]!r}")
    return forces


def _converted(table: TextTable, at: int, values: Floats, unit: str, wanted: str) -> Floats:
    try:
        return convert(values, unit, wanted)
    except InvalidInputError as error:
        raise table.refusal(f"{table.names[at]} as {error.expected}", repr(unit)) from None


def _check_channels(table: TextTable, voltages: Mapping[int, Floats], labels: Labels) -> None:
    """Refuse columns that are no channels: time, numbers of rows, what never changes."""
    # Weights may be laid on in their order: then a channel rises with them.
    ordered = labels.dtype.kind == "f" and bool((np.diff(labels) >= 0).all())
    for k, values in voltages.items():
        steps, name = np.diff(values), table.names[k]
        rises = bool((steps > 0).all()) and (
            steps.size >= ALWAYS or (steps.size >= 2 and np.ptp(steps) <= 1e-6 * steps[0])
        )
        if name.casefold() in NO_CHANNELS:
            got = "a column of this name"
        elif steps.size and not np.ptp(values):
            got = "one that never changes"
        elif rises and not ordered:
            got = "one that rises from row to row"
        else:
            continue
        raise table.refusal(
            "columns of voltages beside the label: name them, as channels=('e1', 'e2')",
            f"{name!r}, {got}",
        )
