"""What finite elements give for elements, kept: ``python -m softgrip.tactile.element_results``.

Compliances hold for E = 0.125 MPa and nu = 0.49; for another E they are divided by it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.kept import Kept
from softgrip.tactile.element import SHAPES, STATED_MODULUS, Element, Shape
from softgrip.tactile.element_fem import TopCompliance, solve
from softgrip.tactile.element_table import ASSUMED

COLUMNS = (
    "shape",
    "width [m]",
    "height [m]",
    "cut",
    "divisions",
    "unknowns",
    "mean [m/N]",
    "largest [m/N]",
    "plate [m/N]",
)
STATED_CYLINDER = Element("cylinder")
"""As wide as Section 2.2 says, 6 mm."""

CUTS = (0.05, 0.06, 0.0854, 0.12, 0.16, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
_ROUND, _SQUARE = (4, 8, 16, 32, 64), (2, 4, 6, 8, 10)


@dataclass(frozen=True)
class Solved:
    """A solved element: what it is, the mesh's divisions and unknowns, and how its top gives."""

    element: Element
    divisions: int
    unknowns: int
    top: TopCompliance


def _finer(element: Element) -> Sequence[tuple[Element, int]]:
    return [(element, n) for n in (_SQUARE if element.shape == "pyramid" else _ROUND)]


def _sweep(shape: Shape) -> Sequence[tuple[Element, int]]:
    if shape == "cylinder":
        return [(STATED_CYLINDER, 32)]
    return [(Element(shape, cut=cut), 6 if shape == "pyramid" else 32) for cut in CUTS]


TABLES: Mapping[str, Sequence[tuple[Element, int]]] = MappingProxyType(
    {
        "convergence": [
            case for element in (*ASSUMED.values(), STATED_CYLINDER) for case in _finer(element)
        ],
        "cut": [case for shape in SHAPES for case in _sweep(shape)],
    }
)
"""The kept files: elements and divisions of their rows."""


def solved(table: str) -> Iterator[Solved]:
    """Solve the elements of a table."""
    for element, divisions in TABLES[table]:
        found = solve(element, divisions)
        yield Solved(element, divisions, found.displacement.size, found.top)


KEPT = {
    table: Kept(
        f"tactile/element_{table}.csv",
        Solved,
        partial(solved, table),
        "python -m softgrip.tactile.element_results",
        columns=COLUMNS,
        exact=("width [m]", "height [m]", "cut"),
    )
    for table in TABLES
}


def read(table: str) -> tuple[Solved, ...]:
    """Read ``data/tactile/element_<table>.csv``.

    Args:
        table: "convergence", or "cut": elements 6 mm wide and 3 mm high with tops of all widths.

    Raises:
        UnknownNameError: If it is none of these.
    """
    if table not in TABLES:
        raise UnknownNameError("table", table, list(TABLES))
    return KEPT[table].read()


def finest(element: Element) -> Solved:
    """Return the kept result of an element on its finest mesh.

    Raises:
        UnknownNameError: If it is none of `ASSUMED` and not `STATED_CYLINDER`.
    """
    rows = [row for row in read("convergence") if _same(row.element, element)]
    if not rows:
        raise UnknownNameError("kept element", repr(element), [repr(e) for e in ASSUMED.values()])
    return max(rows, key=lambda row: row.divisions)


def fem_deformation(
    element: Element, force: float, young_modulus: float = STATED_MODULUS, of: str = "largest"
) -> float:
    """Return the displacement of the top on the finest mesh, m: "mean", "largest" or "plate".

    The other parameters are as in `element.shortening`; raises UnknownNameError as `finest`.
    """
    return float(getattr(finest(element).top, of)) * force * STATED_MODULUS / young_modulus


def _same(kept: Element, asked: Element) -> bool:
    return kept.shape == asked.shape and (kept.width, round(kept.cut, 4)) == (
        asked.width,
        round(asked.cut, 4),
    )


def largest_for(shape: Shape, cut: float) -> float:
    """Return the largest displacement of the top by force, m/N, between the rows of the sweep.

    By straight lines in the logarithms, for E = 0.125 MPa.

    Raises:
        InvalidInputError: If the cut is outside the sweep, 0.05 to 0.9.
    """
    cuts, soft = _curve(shape)
    return _between(cut, cuts, soft, "cut")


def cut_for(shape: Shape, largest: float, young_modulus: float = STATED_MODULUS) -> float:
    """Return the cut that gives a largest displacement by force, m/N: `largest_for` turned round.

    Raises:
        InvalidInputError: If no cut of the sweep gives it.
    """
    cuts, soft = _curve(shape)
    given = largest * young_modulus / STATED_MODULUS
    return _between(given, soft[::-1], cuts[::-1], "largest")


def _curve(shape: Shape) -> tuple[Floats, Floats]:
    """Return the cuts of the sweep and the largest displacements by force, m/N."""
    # Up to 0.9: at upright walls the rim of the top sinks further than its middle.
    rows = [r for r in read("cut") if r.element.shape == shape and r.element.cut <= 0.9]
    if not rows:
        raise InvalidInputError("shape", expected="hemisphere or pyramid", got=shape)
    return np.array([r.element.cut for r in rows]), np.array([r.top.largest for r in rows])


def _between(x: float, at: Floats, values: Floats, name: str) -> float:
    if not at[0] <= x <= at[-1]:
        raise InvalidInputError(name, expected=f"{at[0]:g} to {at[-1]:g}", got=x)
    return float(np.exp(np.interp(np.log(x), np.log(at), np.log(values))))


if __name__ == "__main__":
    for kept in KEPT.values():
        kept.main()
