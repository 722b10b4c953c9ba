"""Tensile tests of the Soft Robotics Materials Database: one curve to failure a material."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats, read_only
from softgrip.checks import check_finite
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import existing
from softgrip.materials.database import available, locate
from softgrip.text_table import LARGEST
from softgrip.units import MPa

__all__ = [
    "TensileTest",
    "available",
    "hundred_percent_modulus",
    "load",
    "parse",
    "up_to_peak",
]

COLUMNS = (
    "Time (s)",
    "True Strain",
    "True Stress (MPa)",
    "Engineering Strain",
    "Engineering Stress (MPa)",
)
SOFTEST = 1e3
"""Stress by strain, Pa, below which no elastomer lies; foams and gels of a few kPa are above."""
FEWEST_ROWS = 10
"""A file with fewer rows of numbers is taken for a torn one; the published have 222 or more."""


@dataclass(frozen=True, eq=False)
class TensileTest:
    """A pull to failure; its arrays cannot be written to.

    Attributes:
        name: Material.
        strain, stress: Engineering strain, and engineering stress in Pa, shape (N,). Strain rises
            from row to row and is that of the crosshead. The first stresses can lie just below
            zero.
        true_strain, true_stress: The same on the deformed length and area as the database gives
            them, shape (N,); Pa.
    """

    name: str
    strain: Floats
    stress: Floats
    true_strain: Floats
    true_stress: Floats

    def __post_init__(self) -> None:
        for name in ("strain", "stress", "true_strain", "true_stress"):
            array = read_only(getattr(self, name))
            if array.ndim != 1 or array.shape != np.shape(self.strain):
                raise InvalidInputError(name, expected="the shape (N,) of strain", got=array.shape)
            check_finite(**{name: array})
            object.__setattr__(self, name, array)


def load(name: str) -> TensileTest:
    """Read the tensile test of a material of Table 5.1.

    Raises:
        UnknownNameError, DataUnavailableError, DataFileError: As
            `softgrip.materials.database.locate` and `parse` do.
    """
    return replace(parse(locate(name)), name=name)


def parse(path: Path | str) -> TensileTest:
    """Read one file of the database; the test takes the file's name.

    Raises:
        DataFileError: If the file is not as `read_rows` expects it.
    """
    _, true_strain, true_stress, strain, stress = read_rows(path).T
    return TensileTest(Path(path).stem, strain, stress * MPa, true_strain, true_stress * MPa)


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

    Raises:
        InvalidInputError: If the test does not reach from below to above strain 1.
    """
    low, high = float(test.strain[0]), float(test.strain[-1])
    if not low <= 1 <= high:
        raise InvalidInputError(
            "test", expected="strains on both sides of 1", got=f"{low:g} to {high:g}"
        )
    return float(np.interp(1.0, test.strain, test.stress))


def read_rows(path: Path | str) -> Floats:
    """Read the rows of numbers of a file, shape (N, 5), in the units of `COLUMNS`.

    A file has header rows, the row of `COLUMNS`, then rows of finite numbers. Cells are separated
    by semicolons, decimals by points, and the last row ends with a line end. Engineering strain
    rises from row to row.

    Raises:
        DataFileError: If the file does not hold this; names the line and what was expected there.
    """
    path = existing(path)
    lines = _lines(path)
    cells = [[cell.strip() for cell in line.split(";")] for line in lines]
    start = next((i for i, row in enumerate(cells) if set(row) & set(COLUMNS)), None)
    if start is None:
        expected = f"a row of columns {';'.join(COLUMNS)}"
        got = "the end of the file (other tests are read by softgrip.materials.tester.read_export)"
        raise DataFileError(path, expected=expected, got=got, line=len(lines))
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
        return abs(float(cell)) <= LARGEST
    except ValueError:
        return False
