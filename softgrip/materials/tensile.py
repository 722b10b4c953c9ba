"""Tensile tests of the Soft Robotics Materials Database: one curve to failure a material."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError
from softgrip.materials.database import available, locate
from softgrip.materials.tensile_file import read_rows
from softgrip.units import MPa

__all__ = [
    "TensileTest",
    "available",
    "hundred_percent_modulus",
    "load",
    "parse",
    "up_to_peak",
]


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

    def __post_init__(self) -> None:
        for name in ("strain", "stress", "true_strain", "true_stress"):
            array = read_only(getattr(self, name))
            if array.ndim != 1 or array.shape != np.shape(self.strain):
                raise InvalidInputError(name, expected="the shape (N,) of strain", got=array.shape)
            object.__setattr__(self, name, array)


def load(name: str) -> TensileTest:
    """Read the tensile test of a material of Table 5.1.

    Raises
    ------
    UnknownNameError, DataUnavailableError, DataFileError
        As `softgrip.materials.database.locate` and `parse` do.
    """
    return replace(parse(locate(name)), name=name)


def parse(path: Path) -> TensileTest:
    """Read one file of the database; the test takes the file's name.

    Raises
    ------
    DataFileError
        If the file is not as `softgrip.materials.tensile_file.read_rows` expects it.
    """
    _, true_strain, true_stress, strain, stress = read_rows(path).T
    return TensileTest(path.stem, strain, stress * MPa, true_strain, true_stress * MPa)


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
