"""Readings of a reader's own pad: a CSV of named channels and what touched the pad.

::

    e1,e2,e3,kind
    0.42,0.03,0.05,point
    0.40,0.38,0.04,line

Lines that start with ``#`` are comments. The pad may have any number of channels.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, read_only
from softgrip.errors import DataFileError, InvalidInputError

Labels = NDArray[np.str_] | Floats


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
    """Read a CSV of voltages and labels.

    Args:
        path: Of the file; its first line that is no comment names the columns.
        label: The column of kinds or weights.
        channels: The columns of voltages, V; all others than the label if none are named.
        unit: Newtons of one unit of the label, such as ``softgrip.units.GRAM_FORCE``; labels are
            strings without it.

    Raises:
        DataFileError: If there is no such file or column, a row has more or fewer cells than there
            are columns, or a cell is no finite number; names the line.
    """
    file = Path(path)
    if not file.is_file():
        raise DataFileError(file, expected="a file", got="none")
    with file.open(encoding="utf-8", newline="") as stream:
        lines = [
            (number, row)
            for number, row in enumerate(csv.reader(stream), start=1)
            if row and not row[0].startswith("#")
        ]
    if len(lines) < 2:
        raise DataFileError(file, expected="column names and readings", got=f"{len(lines)} lines")
    (first, names), rows = lines[0], lines[1:]
    chosen = tuple(channels) or tuple(name for name in names if name != label)
    if missing := [name for name in (*chosen, label) if name not in names]:
        hint = "; a log is read by softgrip.logs.contacts" if names[-1] == "event" else ""
        raise DataFileError(
            file, expected=f"columns {', '.join(missing)}", got=", ".join(names) + hint, line=first
        )
    for number, row in rows:
        if len(row) != len(names):
            raise DataFileError(
                file, expected=f"{len(names)} cells", got=f"{len(row)}", line=number
            )
    columns = [names.index(name) for name in chosen]
    voltages = [[_number(file, n, row[k], names[k]) for k in columns] for n, row in rows]
    at = names.index(label)
    labels = (
        np.array([row[at].strip() for _, row in rows])
        if unit is None
        else unit * np.array([_number(file, n, row[at], label) for n, row in rows])
    )
    return PadReadings(chosen, np.array(voltages), labels)


def _number(file: Path, line: int, cell: str, column: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise DataFileError(
            file, expected=f"a finite number under {column}", got=repr(cell), line=line
        )
    return value
