"""The ten elastomers of Table 5.1 and their printed properties."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_rows
from softgrip.reads import remembered
from softgrip.units import MPa

HELD_OUT = ("Dragon Skin 20", "Dragon Skin FX Pro")
"""The two materials of Table 5.2: the printed power law was fitted to the other eight."""


@dataclass(frozen=True)
class Material:
    """One row of Table 5.1, in SI.

    Attributes:
        name: Trade name.
        fractional_power: Exponent n of Ludwick's law, Eq. (5.2), dimensionless.
        young_modulus: E, Pa.
        mixed_viscosity: MV of the liquid before it cures, Pa s.
        tensile_strength: TS, Pa.
    """

    name: str
    fractional_power: float
    young_modulus: float
    mixed_viscosity: float
    tensile_strength: float


@remembered
def table_5_1() -> Mapping[str, Material]:
    """Read Table 5.1: a read-only mapping from name to material, in the printed order.

    >>> table_5_1()["Ecoflex 00-30"].young_modulus
    70000.0
    """
    materials = (
        Material(
            name=row["name"],
            fractional_power=float(row["fractional_power"]),
            young_modulus=_pascal(row["young_modulus"]),
            mixed_viscosity=float(row["mixed_viscosity"]),
            tensile_strength=_pascal(row["tensile_strength"]),
        )
        for row in data_rows("materials/table_5_1.csv")
    )
    return MappingProxyType({material.name: material for material in materials})


def material(name: str) -> Material:
    """Return the material of this name.

    Raises:
        UnknownNameError: If Table 5.1 has no such row; the message lists those it has.
    """
    table = table_5_1()
    if name not in table:
        raise UnknownNameError("material", name, list(table))
    return table[name]


def properties(materials: Iterable[Material]) -> Floats:
    """Return E [Pa], MV [Pa s] and TS [Pa] of n materials, shape (n, 3).

    >>> properties([material("Ecoflex 00-30")]).tolist()
    [[70000.0, 3.0, 1380000.0]]
    """
    rows = [(m.young_modulus, m.mixed_viscosity, m.tensile_strength) for m in materials]
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def fractional_powers(materials: Iterable[Material]) -> Floats:
    """Return the printed fractional power of n materials, Eq. (5.5), shape (n,)."""
    return np.array([m.fractional_power for m in materials], dtype=np.float64)


def _pascal(printed: str) -> float:
    # 3.28 * 1e6 is 3279999.9999999995 in binary; no printed value is finer than 1 Pa.
    return float(round(float(printed) * MPa))
