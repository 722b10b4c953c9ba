"""Tensile tests of the Soft Robotics Materials Database: one curve to failure a material."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.materials import database
from softgrip.materials.arrays import Floats, read_only
from softgrip.units import MPa

COLUMNS = (
    "Time (s)",
    "True Strain",
    "True Stress (MPa)",
    "Engineering Strain",
    "Engineering Stress (MPa)",
)
FEWEST_ROWS = 10


@dataclass(frozen=True, eq=False)
class TensileTest:
    """A pull to failure; its arrays cannot be written to.

    Attributes
    ----------
    name
        Material.
    strain, stress
        Engineering strain, and engineering stress in Pa, shape (N,). Strain rises from row to row
        and is that of the crosshead. The first stresses can lie just below zero.
    true_strain, true_stress
        The same on the deformed length and area as the database gives them, shape (N,); Pa.
    """

    name: str
    strain: Floats
    stress: Floats
    true_strain: Floats
    true_stress: Floats


def load(name: str) -> TensileTest:
    """Read the tensile test of a material of Table 5.1.

    Raises
    ------
    UnknownNameError, DataUnavailableError, DataFileError
        As `softgrip.materials.database.locate` and `parse` do.
    """
    return replace(parse(database.locate(name)), name=name)


def parse(path: Path) -> TensileTest:
    """Read a file of the database: header rows, the row of `COLUMNS`, then rows of numbers.

    Cells are separated by semicolons, decimals by points. The test takes the file's name.

    Raises
    ------
    DataFileError
        If the file does not hold this; names the line and what was expected there.
    """
    lines = _lines(path)
    cells = [[cell.strip() for cell in line.split(";")] for line in lines]
    start = next((i for i, row in enumerate(cells) if set(row) & set(COLUMNS)), None)
    if start is None:
        expected = f"a row of columns {';'.join(COLUMNS)}"
        raise DataFileError(path, expected=expected, got="the end of the file", line=len(lines))
    if tuple(cells[start]) != COLUMNS:
        raise DataFileError(
            path, expected=f"columns {';'.join(COLUMNS)}", got=lines[start], line=start + 1
        )
    rows = [_numbers(path, line, row) for line, row in enumerate(cells[start + 1 :], start + 2)]
    if len(rows) < FEWEST_ROWS:
        expected = f"at least {FEWEST_ROWS} rows of numbers"
        raise DataFileError(path, expected=expected, got=f"{len(rows)}", line=len(lines))
    _, true_strain, true_stress, strain, stress = np.array(rows).T
    falls = np.flatnonzero(np.diff(strain) <= 0)
    if falls.size:
        line = start + 3 + int(falls[0])
        expected = "an engineering strain above that of the row before"
        raise DataFileError(path, expected=expected, got=lines[line - 1], line=line)
    return TensileTest(
        name=path.stem,
        strain=read_only(strain),
        stress=read_only(stress * MPa),
        true_strain=read_only(true_strain),
        true_stress=read_only(true_stress * MPa),
    )


def up_to_peak(test: TensileTest) -> TensileTest:
    """Return the rows up to and including the largest engineering stress."""
    kept = slice(int(np.argmax(test.stress)) + 1)
    return TensileTest(
        test.name,
        test.strain[kept],
        test.stress[kept],
        test.true_strain[kept],
        test.true_stress[kept],
    )


def hundred_percent_modulus(test: TensileTest) -> float:
    """Return the engineering stress at strain 1 in Pa, interpolated between rows.

    Raises
    ------
    InvalidInputError
        If the test does not reach from below to above strain 1.
    """
    low, high = float(test.strain[0]), float(test.strain[-1])
    if not low <= 1 <= high:
        raise InvalidInputError(
            "test", expected="strains on both sides of 1", got=f"{low:g} to {high:g}"
        )
    return float(np.interp(1.0, test.strain, test.stress))


def _lines(path: Path) -> list[str]:
    raw = path.read_bytes()
    if not raw.strip():
        raise DataFileError(path, expected="a tensile test", got="an empty file", line=1)
    if b"\0" in raw:
        expected = "text with one byte a character (latin-1)"
        raise DataFileError(path, expected=expected, got="zero bytes, as in UTF-16", line=1)
    lines = raw.decode("latin-1").splitlines()
    if not raw.endswith(b"\n"):
        # A number cut short is still a number: only the missing line end shows the cut.
        expected = "a line end after the last row"
        raise DataFileError(path, expected=expected, got=f"{lines[-1]!r}", line=len(lines))
    return lines


def _numbers(path: Path, line: int, row: list[str]) -> list[float]:
    if len(row) != len(COLUMNS):
        expected = f"{len(COLUMNS)} cells separated by semicolons"
        raise DataFileError(path, expected=expected, got=f"{len(row)}", line=line)
    for column, cell in zip(COLUMNS, row, strict=True):
        if "," in cell:
            expected = f"{column!r} with a decimal point"
            raise DataFileError(path, expected=expected, got=f"{cell!r}", line=line)
        if not _is_finite(cell):
            expected = f"a finite number for {column!r}"
            raise DataFileError(path, expected=expected, got=f"{cell!r}", line=line)
    return [float(cell) for cell in row]


def _is_finite(cell: str) -> bool:
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return False
