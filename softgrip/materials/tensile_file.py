"""The file format of the Soft Robotics Materials Database, read with every row checked."""

from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError

COLUMNS = (
    "Time (s)",
    "True Strain",
    "True Stress (MPa)",
    "Engineering Strain",
    "Engineering Stress (MPa)",
)
FEWEST_ROWS = 10
"""A file with fewer rows of numbers is taken for a torn one; the published have 222 or more."""


def read_rows(path: Path) -> Floats:
    """Read the rows of numbers of a file, shape (N, 5), in the units of `COLUMNS`.

    A file has header rows, the row of `COLUMNS`, then rows of finite numbers. Cells are separated
    by semicolons, decimals by points, and the last row ends with a line end. Engineering strain
    rises from row to row.

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
        expected = f"columns {';'.join(COLUMNS)}"
        raise DataFileError(path, expected=expected, got=lines[start], line=start + 1)
    numbered = enumerate(cells[start + 1 :], start + 2)
    rows = np.array([_numbers(path, line, row) for line, row in numbered])
    if len(rows) < FEWEST_ROWS:
        expected = f"at least {FEWEST_ROWS} rows of numbers"
        raise DataFileError(path, expected=expected, got=f"{len(rows)}", line=len(lines))
    falls = np.flatnonzero(np.diff(rows[:, 3]) <= 0)
    if falls.size:
        line = start + 3 + int(falls[0])
        expected = f"{COLUMNS[3]!r} above that of the row before"
        raise DataFileError(path, expected=expected, got=lines[line - 1], line=line)
    return rows


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
