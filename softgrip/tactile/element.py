"""Sensing elements: cylinder, hemisphere and pyramid, and how far a force shortens them.

Each slice of an element is taken to bear the force evenly and to be free to widen. What this
leaves out, the clamped base and a small top that sinks into a wide body, is left to
`softgrip.tactile.element_fem`.
"""

from dataclasses import dataclass
from math import inf, isfinite, pi, sqrt
from typing import Literal, get_args

import numpy as np

from softgrip.arrays import Value, check_positive, is_symbol
from softgrip.errors import InvalidInputError
from softgrip.units import MM, MPa

Shape = Literal["cylinder", "hemisphere", "pyramid"]
SHAPES: tuple[Shape, ...] = get_args(Shape)


@dataclass(frozen=True)
class Element:
    """A sensing element that stands on its base and is pressed on its flat top.

    Attributes:
        shape: The pyramid is square, the others are round. A hemisphere whose height is not that of
            the cut sphere is stretched upwards, into half a spheroid.
        width: Of the base, m, > 0: a side of the square or a diameter.
        height: From base to flat top, m, > 0.
        cut: Width of the flat top as a part of the base's, 0 (sharp) to 1; always 1 for a cylinder.

    Raises:
        InvalidInputError: If one of these does not hold.
    """

    shape: Shape
    width: float = 6 * MM
    height: float = 3 * MM
    cut: float = 1.0

    def __post_init__(self) -> None:
        if self.shape not in SHAPES:
            raise InvalidInputError("shape", expected=f"one of {SHAPES}", got=self.shape)
        check_positive(width=self.width, height=self.height)
        if is_symbol(self.cut):
            return
        if not 0 <= self.cut <= 1 or (self.shape == "cylinder" and self.cut != 1):
            raise InvalidInputError("cut", expected="0 to 1; 1 for a cylinder", got=self.cut)

    @property
    def base_area(self) -> float:
        """Area of the base, m^2."""
        return self.width**2 * (1.0 if self.shape == "pyramid" else pi / 4)

    @property
    def top_area(self) -> float:
        """Area of the flat top, m^2."""
        return self.base_area * self.cut**2

    @property
    def volume(self) -> float:
        """Volume, m^3.

        >>> volume = Element("hemisphere", width=2.0, height=1.0, cut=0.0).volume
        >>> round(volume / (2 / 3 * pi), 12)
        1.0
        """
        k = self.cut
        share = {
            "cylinder": 1.0,
            "hemisphere": 1 - (1 - k**2) / 3,
            "pyramid": (1 + k + k**2) / 3,
        }
        return self.base_area * self.height * share[self.shape]


def cut_sphere(cut: float, radius: float = 3 * MM) -> Element:
    """Return a hemisphere of true spherical form whose top is cut off flat.

    Args:
        cut: Radius of the flat top as a part of the sphere's, 0 to below 1.
        radius: Of the sphere, m.

    >>> round(cut_sphere(0.6, radius=1.0).height, 12)
    0.8
    """
    if not 0 <= cut < 1:
        raise InvalidInputError("cut", expected="0 to below 1", got=cut)
    return Element("hemisphere", 2 * radius, radius * sqrt(1 - cut**2), cut)


def cross_section(element: Element, y: Value) -> Value:
    """Return A(y), m^2, at a height y above the base, m, 0 to the element's height.

    The print gives a sharp pyramid, ``(w - w y / L)**2``, and for the hemisphere
    ``(w/2)**2 - y**2``, to which the factor pi is added here.

    Raises:
        InvalidInputError: If y is outside the element.
    """
    part = y / element.height
    if not is_symbol(part) and not np.all((part >= 0) & (part <= 1)):
        raise InvalidInputError("y", expected=f"0 to {element.height:g} m", got=y)
    if element.shape == "pyramid":
        return element.base_area * (1 - (1 - element.cut) * part) ** 2
    return element.base_area * (1 - (1 - element.cut**2) * part**2)


STATED_MODULUS = 0.125 * MPa
"""E of Ecoflex 00-30 as Section 2.2 states it, Pa."""

TABLE_MODULUS = 0.1 * MPa
"""E with which the Hertzian row of Table 2.1 comes out, Pa; no place prints it."""


def compliance(element: Element, young_modulus: float = STATED_MODULUS) -> float:
    """Return shortening by force, m/N, in closed form; infinite for a sharp top.

    With the width w, the height L, the base A and the cut k the integral of Eq. (2.1) is
    ``L / (E A)`` times 1 for a cylinder, ``1 / k`` for a pyramid,
    ``arcosh(1 / k) / sqrt(1 - k**2)`` for a hemisphere.

    Table 2.1 in mm at 0.1 N, a pyramid whose top is 0.72 mm wide:

    >>> round(1e3 * 0.1 * compliance(Element("pyramid", cut=0.12), TABLE_MODULUS), 3)
    0.694
    >>> compliance(Element("pyramid", cut=0.0))
    inf
    """
    check_positive(young_modulus=young_modulus)
    block, k = element.height / (young_modulus * element.base_area), element.cut
    if not is_symbol(k) and k in (0, 1):
        return block if k else inf
    if element.shape == "pyramid":
        return block / k
    side = ((1 - k) * (1 + k)) ** 0.5  # arcosh(1 / k) is arsinh(side / k), which keeps its digits
    found: float = block * np.arcsinh(side / k) / side
    return found


def shortening(element: Element, force: Value, young_modulus: float = STATED_MODULUS) -> Value:
    """Return how far a force shortens an element, m, Eq. (2.1).

    It is linear: where it is no longer small beside the height, it is an extrapolation.

    Args:
        element: With a flat top: cut > 0.
        force: N, >= 0, float or array.
        young_modulus: E, Pa.

    Raises:
        InvalidInputError: If the force is not, or the top is sharp, where any force shortens
            without limit.
    """
    if not is_symbol(force) and not np.all(np.asarray(force) >= 0):
        raise InvalidInputError("force", expected="N, >= 0", got=force)
    soft = compliance(element, young_modulus)
    if not is_symbol(soft) and not isfinite(soft):
        raise InvalidInputError("element", expected="a flat top (cut > 0)", got=element)
    return soft * force
