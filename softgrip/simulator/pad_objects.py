"""What is pressed on the simulated pad: foods of Section 2.4, other foods, and probes.

Sizes, stiffness and roughness are common knowledge, rounded: none is printed.
"""

from dataclasses import dataclass
from math import inf

from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.tactile.contacts import KINDS
from softgrip.units import MM

KILOPASCAL = 1e3


@dataclass(frozen=True)
class PadObject:
    """The side of an object that faces the pad.

    Attributes:
        name: What it is called.
        kind: Contact feature that it counts as: point, line or surface.
        radii: Of curvature along and across, m; infinite where it is straight.
        size: Length and width, m; beyond them it ends. A rounded end may lie before.
        roughness: Deviation of its surface from that shape, m rms.
        young_modulus: Pa; infinite if rigid.
        depth: Of the material that gives way, m.
    """

    name: str
    kind: str
    radii: tuple[float, float]
    size: tuple[float, float]
    roughness: float
    young_modulus: float
    depth: float

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InvalidInputError("kind", expected=f"one of {KINDS}", got=self.kind)
        least = min(*self.radii, *self.size, self.young_modulus, self.depth)
        if not (least > 0 and 0 <= self.roughness < inf):
            raise InvalidInputError(self.name, expected="sizes > 0, roughness >= 0", got=self)

    @property
    def softness(self) -> float:
        """Indentation by pressure, m/Pa, as of a mattress; 0 if rigid."""
        return self.depth / self.young_modulus


def _object(
    name: str,
    kind: str,
    radii: tuple[float, float],
    size: tuple[float, float],
    roughness: float,
    modulus: float,
    depth: float,
) -> PadObject:
    """Return an object from mm and kPa."""
    along, across = (value * MM for value in radii)
    length, width = (value * MM for value in size)
    return PadObject(
        name, kind, (along, across), (length, width), roughness * MM,
        modulus * KILOPASCAL, depth * MM,
    )  # fmt: skip


FOODS = (
    _object("egg", "point", (30, 22), (58, 44), 0.02, inf, 1),
    _object("cherry tomato", "point", (13, 13), (26, 26), 0.05, 200, 5),
    _object("small carrot", "line", (inf, 7), (50, 14), 0.2, 3000, 7),
    _object("sliced cucumber", "line", (inf, 18), (40, 30), 0.15, 1000, 10),
    _object("sliced banana", "line", (120, 16), (40, 30), 0.1, 50, 12),
    _object("hot dog", "line", (inf, 11), (60, 22), 0.1, 80, 8),
    _object("sponge", "surface", (inf, inf), (45, 40), 0.4, 10, 15),
    _object("tofu", "surface", (inf, inf), (40, 40), 0.1, 15, 20),
)
"""The foods of Section 2.4. Slices are taken to be cut along the length and laid on their skin:
else they would be no line."""

OTHERS = (
    _object("grape", "point", (11, 9), (22, 18), 0.05, 100, 5),
    _object("blueberry", "point", (6.5, 6.5), (13, 13), 0.1, 100, 4),
    _object("walnut", "point", (18, 15), (36, 30), 0.6, inf, 1),
    _object("ball 20 mm", "point", (10, 10), (20, 20), 0, inf, 1),
    _object("ball 40 mm", "point", (20, 20), (40, 40), 0, inf, 1),
    _object("asparagus", "line", (inf, 5), (60, 10), 0.2, 1000, 5),
    _object("rod 10 mm", "line", (inf, 5), (50, 10), 0, inf, 1),
    _object("rod 20 mm", "line", (inf, 10), (50, 20), 0, inf, 1),
    _object("cheese slice", "surface", (inf, inf), (40, 40), 0.1, 100, 8),
    _object("bread slice", "surface", (inf, inf), (45, 45), 0.4, 10, 12),
    _object("melon cube", "surface", (inf, inf), (30, 30), 0.2, 200, 20),
    _object("block 30 mm", "surface", (inf, inf), (30, 30), 0, inf, 1),
    _object("block 40 mm", "surface", (inf, inf), (40, 40), 0, inf, 1),
)
"""What the training log has beside the foods: with them, seven objects a kind."""


def pad_object(name: str) -> PadObject:
    """Find an object by its name.

    Raises:
        UnknownNameError: If there is none.
    """
    known = {item.name: item for item in (*FOODS, *OTHERS)}
    if name not in known:
        raise UnknownNameError("object", name, list(known))
    return known[name]
