"""Readings of a reader's own pad: a CSV of named channels and what touched the pad.

::

    e1,e2,e3,kind
    0.42,0.03,0.05,point
    0.40,0.38,0.04,line

Rows of one press, or of one grasp, are alike: a column that numbers or names them is the group.
Lines that start with ``#`` are comments. The pad may have any number of channels.
"""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, floats, read_only
from softgrip.errors import DependentRowsWarning, InvalidInputError, LeftOutWarning
from softgrip.quantities import convert
from softgrip.tactile.channels import (
    near_equal,
    near_equal_by_chance,
    no_channels,
    order_of_alike,
)
from softgrip.text_numbers import is_number
from softgrip.text_table import TextTable, read_table

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
        voltages, labels = read_only(self.voltages), _checked(self.labels)
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


def _checked(given: Labels) -> Labels:
    """Return labels as strings or floats."""
    try:
        words = np.asarray(given, dtype=object)
        text = words.ndim == 1 and all(isinstance(word, str) for word in words)
        labels: Labels = words.astype(str) if text else floats(labels=given)[0]
    except (InvalidInputError, ValueError):
        raise InvalidInputError(
            "labels", expected="kinds as strings, or forces as numbers", got=given
        ) from None
    if text and not all(word.strip() for word in words):
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
    """Read a table of voltages and labels, as of `softgrip.text_table`.

    Columns that name no unit are in V; a label that names one is a force.

    Args:
        path: Of the file.
        label: The column of kinds or weights.
        channels: The columns of voltages; all others than label and group if none are named. A
            column that is constant, rises steadily, or has a clock's name is then refused: it may
            be one, but who reads must say so.
        group: The column of what each row is a sample of, such as its press or its grasp.
        unit: Newtons of one unit of the label, such as ``softgrip.units.GRAM_FORCE``, if its column
            names none; labels are strings without any.

    Raises:
        DataFileError: If there is no such file or column, a row has more or fewer cells than there
            are columns, a unit is none of a voltage or force, a cell is no finite number, a label
            or group is empty, or a column that nobody named is no channel; names the line.

    Warns:
        LeftOutWarning: If something of the file was not read.
        DependentRowsWarning: If rows are near-equal, or most like those beside them, and no group
            says what they are samples of.
    """
    table = read_table(path)
    if label not in table.names and "event" in table.names:
        got = f"{', '.join(table.names)}; a log is read by softgrip.logs.contacts"
        raise table.refusal(f"a column {label!r}", got)
    at = table.column(label)
    by = None if group is None else table.column(group)
    others = [k for k in range(len(table.names)) if k not in (at, by)]
    chosen = [table.column(name) for name in channels] or others
    names = tuple(table.names[k] for k in chosen)
    labels = _labels(table, at, unit)
    if not channels:
        _check_channels(table, chosen, labels)
    voltages = np.stack([_volts(table, k) for k in chosen], axis=1) if chosen else np.empty((0, 0))
    groups = None if by is None else np.array(_filled(table, by, "a group"))
    found = PadReadings(names, voltages, labels, groups)
    for note in table.notes:
        warnings.warn(f"{table.path}: {note}", LeftOutWarning, stacklevel=2)
    if group is None:
        _warn_of_dependence(table.path, found)
    return found


def _check_channels(table: TextTable, chosen: Sequence[int], labels: Labels) -> None:
    """Refuse columns that nobody named and that are no channels."""
    names = [table.names[k] for k in chosen]
    words = {
        table.names[k]: f"it holds words, such as {table.cells(k)[0]!r}"
        for k in chosen
        if not any(is_number(cell) for cell in table.cells(k))
    }
    numbers = {table.names[k]: table.numbers(k) for k in chosen if table.names[k] not in words}
    found = words | no_channels(numbers, labels)
    if found:
        rest = tuple(name for name in names if name not in found)
        raise table.refusal(
            f"channels of a pad; if {', '.join(found)} is one, name all: channels={tuple(names)}, "
            f"else channels={rest}, and group= for what rows are samples of",
            "; ".join(f"{name}: {reason}" for name, reason in found.items()),
        )


def _filled(table: TextTable, at: int, what: str) -> tuple[str, ...]:
    """Return the words of a column, none of them empty."""
    cells = table.cells(at)
    for line, cell in zip(table.lines, cells, strict=True):
        if not cell:
            raise table.refusal(f"{what} under {table.names[at]}", "an empty cell", line)
    return cells


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


def _volts(table: TextTable, at: int) -> Floats:
    values, unit = table.numbers(at), table.units[at]
    return _converted(table, at, values, unit, "V") if unit else values


def _labels(table: TextTable, at: int, unit: float | None) -> Labels:
    """Return kinds, or forces in N."""
    cells, own = _filled(table, at, "a label"), table.units[at]
    if own == "1" and not all(map(is_number, cells)):
        own = ""  # a row of units has a dash below what is no quantity
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
