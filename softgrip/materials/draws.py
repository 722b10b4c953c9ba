"""E and n of the ten rubbers, drawn: what their tensile tests leave open of Table 5.1.

Each draw takes the rows of a test anew, in runs (`bootstrap`), and reads E and n from them in the
way of the table: E is the engineering stress at strain 1, the 100 % modulus of a data sheet, and n
is fitted to the true stress with that E held (`fitting.Fitting`). The draws speak of one specimen
of each rubber; a second pour, its age and its temperature are not in them.
"""

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import FitWarning
from softgrip.kept import Kept
from softgrip.materials import ludwick, tensile
from softgrip.materials.bootstrap import block_bootstrap
from softgrip.materials.fitting import Fitting, curve
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import TensileTest
from softgrip.provenance import Provenance
from softgrip.reads import remembered

DRAWS = 200
ABOUT_ONE = (0.25, 2.0)
"""Strains between which a cubic gives the stress at 1, where a draw may have no row."""


@dataclass(frozen=True)
class Draw:
    """A draw: Pa and dimensionless."""

    name: str
    young_modulus: float
    fractional_power: float


def drawn(test: TensileTest, draws: int = DRAWS, seed: int = 0) -> list[Draw]:
    """Draw E and n of a test; see the module.

    Args:
        test: That reaches strain 1.
        draws: How many.
        seed: Of the drawing.
    """
    strain, stress = curve(test, Fitting("engineering"))
    found: list[tuple[float, float]] = []

    def law(strain: Floats, stress: Floats) -> tuple[float, float]:
        E = _at_strain_one(strain, stress)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FitWarning)  # said where the test is fitted
            n = ludwick.fit(strain, stress * (1 + strain), young_modulus=E).fractional_power
        found.append((E, n))
        return E, n

    block_bootstrap(strain, stress, law, resamples=draws, seed=seed)
    return [Draw(test.name, E, n) for E, n in found]


def _at_strain_one(strain: Floats, stress: Floats) -> float:
    """Return the stress at strain 1, Pa, of a cubic through the rows about it."""
    near = (strain >= ABOUT_ONE[0]) & (strain <= ABOUT_ONE[1])
    cubic = np.polynomial.Polynomial.fit(strain[near], stress[near], 3, domain=ABOUT_ONE)
    return float(cubic(1.0))


def _made() -> Iterator[Draw]:
    for name in table_5_1():
        yield from drawn(tensile.load(name))


KEPT = Kept(
    "materials/draws.csv",
    Draw,
    _made,
    "Soft Robotics Materials Database (doi 10.1089/soro.2019.0115), drawn by: "
    "python -m softgrip.materials.draws",
    notes="E in Pa and n, read as Table 5.1 has them from rows that are drawn anew in runs. "
    "No measurement is contained.",
    provenance=Provenance.PUBLIC,
)


@remembered
def draws() -> Mapping[str, Floats]:
    """Read the kept draws: E [Pa] and n by material, shape (draws, 2)."""
    rows = KEPT.read()
    found = {
        name: np.array([(r.young_modulus, r.fractional_power) for r in rows if r.name == name])
        for name in table_5_1()
    }
    for array in found.values():
        array.setflags(write=False)
    return MappingProxyType(found)


if __name__ == "__main__":
    print(KEPT.write())
