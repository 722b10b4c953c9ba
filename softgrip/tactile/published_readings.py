"""Readings of a force sensor that the dissertation's author published, of 14 September 2020.

He calls it a self-built soft sensor, and no more. Its date and its scatter fit the single piece of
fabric of which Section 2.2 says that it repeats poorly, and which the dissertation's sandwich
replaced. The file has no licence, so it is not part of this package: it is only read where it was
published, or from a reader's own copy.
"""

import csv
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats, read_only
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.published import PublishedFiles
from softgrip.text_cells import Row, rows_of, text_of
from softgrip.text_numbers import number

FOLDER_VARIABLE = "SOFTGRIP_AUTHOR_DIR"
"""Environment variable that names a folder of the file; unset or empty for the network."""
FILE = "Processed_09142020.csv"
FILES = PublishedFiles(
    FOLDER_VARIABLE,
    "https://raw.githubusercontent.com/WuteYANG/Modeling-soft-sensor-by-NN/"
    "46c7f6b439b30c52af65b6d712272481b8d7a06a/",
    {FILE: "1db9bebd536921b8afc9a315305390ef5caa1ebfc22cd53450a42deb502616a5"},
    {FILE: "force-sensor-2020-09-14.csv"},
)


@dataclass(frozen=True, eq=False)
class ForceReadings:
    """Readings of a force sensor; its arrays cannot be written to.

    Attributes:
        signal: Of the sensor, no unit is given, shape (N,).
        force: That the sensor bore, N, shape (N,): a few levels, those of weights.
    """

    signal: Floats
    force: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "signal", read_only(self.signal))
        object.__setattr__(self, "force", read_only(self.force))
        if self.signal.ndim != 1 or self.signal.shape != self.force.shape:
            raise InvalidInputError(
                "signal, force",
                expected="arrays of one shape (N,)",
                got=(self.signal.shape, self.force.shape),
            )

    @property
    def levels(self) -> Floats:
        """The forces that occur, N, shape (levels,), rising."""
        return np.unique(self.force)


def load() -> ForceReadings:
    """Read the readings.

    Raises:
        DataUnavailableError, DataFileError: As `PublishedFiles.locate` and `parse` do.
    """
    return parse(FILES.locate(FILE))


def available() -> bool:
    """Tell whether the readings can be had; as `PublishedFiles.available`, with its errors."""
    return FILES.available()


def parse(path: Path) -> ForceReadings:
    """Read a file of three rows: signals, forces in N, how many readings each level has.

    Raises:
        DataFileError: If there are other rows, a cell is no number, or the third row does not count
            the runs of equal force in the second: rows were mixed up or cut.
    """
    rows = [(line, [number(cell, ".") for cell in row if cell]) for line, row in _rows(path)]
    for line, row in rows:
        if not np.isfinite(row).all():
            raise DataFileError(path, expected="finite numbers", got="another cell", line=line)
    if len(rows) != 3:
        raise DataFileError(path, expected="three rows of numbers", got=f"{len(rows)}")
    signal, force, counts = (row for _, row in rows)
    runs = [len([*run]) for _, run in groupby(force)]
    if runs != counts or len(signal) != len(force):
        raise DataFileError(
            path,
            expected=f"{sum(runs)} signals, and counts {runs} as of the forces",
            got=f"{len(signal)}, {counts}",
        )
    return ForceReadings(np.array(signal), np.array(force))


def _rows(path: Path) -> list[Row]:
    try:
        return rows_of(text_of(path), ",")
    except csv.Error as error:
        raise DataFileError(path, expected="cells parted by commas", got=str(error)) from None


def statement() -> str:
    """Say in a sentence whether the readings are read, and if not, what stands in for them."""
    if available():
        return f"The {load().force.size} readings were read and checked against their digest."
    return (
        f"The readings could not be had (no network, and no folder is named in {FOLDER_VARIABLE}): "
        "they are missing from the figure, and the errors are kept ones."
    )
