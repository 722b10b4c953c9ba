"""The density of the ten elastomers of Table 5.1, by their supplier."""

from collections.abc import Mapping
from types import MappingProxyType

from softgrip.errors import UnknownNameError
from softgrip.provenance import data_rows
from softgrip.reads import remembered


@remembered
def densities() -> Mapping[str, float]:
    """Read them, kg/m^3: a read-only mapping from the names of Table 5.1."""
    rows = data_rows("materials/densities.csv")
    return MappingProxyType({row["name"]: float(row["density"]) for row in rows})


def density(name: str) -> float:
    """Return the density of a material, kg/m^3; UnknownNameError lists those there are.

    >>> density("Dragon Skin 20")
    1080.0
    """
    known = densities()
    if name not in known:
        raise UnknownNameError("material", name, list(known))
    return known[name]
