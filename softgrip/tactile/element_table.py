"""Table 2.1 as printed, and the elements that its analytic rows ask for.

Everything here that is not printed was chosen so that a printed row comes out, and is listed for
that: the modulus `TABLE_MODULUS` and the three elements of `ASSUMED`. That these rows come out is
no finding; which sizes they ask for is.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from softgrip.provenance import cells, data_file
from softgrip.reads import remembered
from softgrip.tactile.element import Element, Shape, cut_sphere
from softgrip.units import MM

FORCES = (0.1, 0.2, 0.3)
"""Of the table's columns, N."""

HEMISPHERE_CUT, PYRAMID_CUT = 0.0854, 0.12
"""Widths of the flat tops as parts of the base's: 0.51 mm and 0.72 mm of 6 mm."""

ASSUMED: Mapping[Shape, Element] = MappingProxyType(
    {
        "cylinder": Element("cylinder", width=10 * MM),
        "hemisphere": cut_sphere(HEMISPHERE_CUT),
        "pyramid": Element("pyramid", cut=PYRAMID_CUT),
    }
)
"""With `TABLE_MODULUS`. The text has 6 mm by 6 mm by 3 mm for all, and no flat tops."""


@dataclass(frozen=True)
class PrintedRow:
    """A row of Table 2.1: shape, method, and the cells as printed, mm, by force."""

    shape: Shape
    method: str
    cells: tuple[str, str, str]

    def coefficient(self, exponent: float = 1.0) -> tuple[float, float]:
        """Return the range of c, mm, for which ``c * F**exponent`` rounds to all cells.

        F is in N. The range is empty, low above high, if no c does.

        >>> low, high = table_2_1()["hemisphere", "Hertzian"].coefficient(2 / 3)
        >>> round(low, 4), round(high, 4)
        (2.212, 2.2125)
        """
        pairs = list(zip(self.cells, FORCES, strict=True))
        # Cells have three decimals: half a unit of the last one either way.
        low = max((float(cell) - 0.0005) / force**exponent for cell, force in pairs)
        high = min((float(cell) + 0.0005) / force**exponent for cell, force in pairs)
        return low, high


@remembered
def table_2_1() -> Mapping[tuple[Shape, str], PrintedRow]:
    """Read Table 2.1: a read-only mapping from (shape, method), in the printed order.

    >>> table_2_1()["pyramid", "FEM"].cells
    ('0.667', '1.335', '2.003')
    """
    rows = cells(data_file("tactile/table_2_1.csv").path)[1:]
    found = [PrintedRow(shape, method, tuple(printed)) for shape, method, *printed in rows]  # type: ignore[arg-type]
    return MappingProxyType({(row.shape, row.method): row for row in found})
