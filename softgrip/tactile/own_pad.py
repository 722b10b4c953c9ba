"""Readings of a reader's own pad: a CSV of named channels and what touched the pad.

::

    e1,e2,e3,kind
    0.42,0.03,0.05,point
    0.40,0.38,0.04,line

Rows of one press, or of one grasp, are alike: a column that numbers or names them is the group.
Lines that start with ``#`` are comments. The pad may have any number of channels.
"""

import csv
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, read_only
from softgrip.errors import DataFileError, DependentRowsWarning, InvalidInputError
from softgrip.tactile.channels import (
    near_equal,
    near_equal_by_chance,
    no_channels,
    order_of_alike,
)

Labels = NDArray[np.str_] | Floats
BESIDE = 0.5
"""Of what chance makes it: how far in the table the most alike row is, from where on rows are alike
because they follow each other."""


@dataclass(frozen=True)
class PadReadings:
    """N labelled readings of a pad with C channels.

    Attributes:
        channels: Names, C of them, all different.
        voltages: V, finite, shape (N, C).
        labels: Kinds of contact as strings, or forces [N] as finite numbers, whole or not, shape
            (N,).
        groups: What each reading is a sample of, such as its press or its grasp, as strings, shape
            (N,): no model is tested on a part of what it was trained on. None if each reading is
            one of its own.

    Raises:
        InvalidInputError: If a shape or a number is not as said.
    """

    channels: tuple[str, ...]
    voltages: Floats
    labels: Labels
    groups: NDArray[np.str_] | None = None

    def __post_init__(self) -> None:
        voltages, labels = read_only(self.voltages), _labels(self.labels)
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
        if self.groups is not None:
            groups = np.asarray(self.groups).astype(str)
            if groups.shape != labels.shape:
                raise InvalidInputError(
                    "groups", expected=f"shape {labels.shape}, or None", got=groups.shape
                )
            object.__setattr__(self, "groups", groups)
        object.__setattr__(self, "voltages", voltages)
        object.__setattr__(self, "labels", labels)

    def take(self, chosen: ArrayLike) -> Self:
        """Return some of the readings, chosen as by an index of NumPy (a mask, or numbers)."""
        index = np.asarray(chosen)
        groups = None if self.groups is None else self.groups[index]
        return type(self)(self.channels, self.voltages[index], self.labels[index], groups)


def _labels(given: Labels) -> Labels:
    """Return labels as strings or floats."""
    labels: NDArray[Any] = np.asarray(given)
    if labels.dtype.kind == "O":  # as of a table of pandas
        labels = labels.astype(str if all(isinstance(x, str) for x in labels.flat) else float)
    if labels.dtype.kind in "iu":
        labels = labels.astype(np.float64)
    if labels.dtype.kind not in "Uf":
        raise InvalidInputError(
            "labels", expected="kinds as strings, or forces as numbers", got=labels.dtype.name
        )
    if labels.dtype.kind == "U" and (np.char.strip(labels) == "").any():
        raise InvalidInputError("labels", expected="a kind each", got="an empty one")
    return labels


def read_readings(
    path: Path | str,
    *,
    label: str,
    channels: Sequence[str] = (),
    group: str | None = None,
    unit: float | None = None,
) -> PadReadings:
    """Read a CSV of voltages and labels.

    Args:
        path: Of the file; its first line that is no comment names the columns.
        label: The column of kinds or weights.
        channels: The columns of voltages, V; all others than label and group if none are named. A
            column that is constant, rises steadily, or has a clock's name is then refused: it may
            be one, but who reads must say so.
        group: The column of what each row is a sample of, such as its press or its grasp.
        unit: Newtons of one unit of the label, such as ``softgrip.units.GRAM_FORCE``; labels are
            strings without it.

    Raises:
        DataFileError: If there is no such file or column, a row has more or fewer cells than there
            are columns, a cell is no finite number, or a column that nobody named is no channel;
            names the line.

    Warns:
        DependentRowsWarning: If rows are near-equal, or most like those beside them, and no group
            says what they are samples of.
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
    chosen = tuple(channels) or tuple(name for name in names if name not in (label, group))
    wanted = (*chosen, label) if group is None else (*chosen, label, group)
    if missing := [name for name in wanted if name not in names]:
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
    found = PadReadings(chosen, np.array(voltages), labels)
    columns_of = dict(zip(chosen, found.voltages.T, strict=True))
    others = {} if channels else no_channels(columns_of, labels)
    if others:
        named = [name for name in chosen if name not in others]
        raise DataFileError(
            file,
            expected=f"channels of a pad; if {', '.join(others)} is one, name all: "
            f"channels={chosen}, else channels={tuple(named)}, and group= for what rows are "
            "samples of",
            got="; ".join(f"{name}: {reason}" for name, reason in others.items()),
            line=first,
        )
    if group is None:
        _warn_of_dependence(file, found)
        return found
    at = names.index(group)
    return replace(found, groups=np.array([row[at].strip() for _, row in rows]))


def _warn_of_dependence(file: Path, readings: PadReadings) -> None:
    total = len(readings.voltages)
    alike = near_equal(readings.voltages, readings.labels)
    alike *= alike > 3 * near_equal_by_chance(len(readings.channels), readings.labels)
    if not alike and order_of_alike(readings.voltages, readings.labels) > BESIDE:
        return
    said = (
        f"{alike} of {total} rows are near-equal to another of the same label"
        if alike
        else f"the {total} rows are most like those that are beside them"
    )
    warnings.warn(
        f"{file}: {said}: samples of one press? Say by group= which column tells the press, or a "
        "model is tested on what it was trained on",
        DependentRowsWarning,
        stacklevel=3,
    )


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
