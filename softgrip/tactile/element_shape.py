"""The sensing elements of the feature-detection layer: cylinder, hemisphere and pyramid."""

from dataclasses import dataclass
from math import pi, sqrt
from typing import Literal, get_args

import numpy as np

from softgrip.arrays import Value, check_positive
from softgrip.errors import InvalidInputError
from softgrip.units import MM

Shape = Literal["cylinder", "hemisphere", "pyramid"]
SHAPES: tuple[Shape, ...] = get_args(Shape)


@dataclass(frozen=True)
class Element:
    """A sensing element that stands on its base and is pressed on its flat top.

    Attributes
    ----------
    shape
        The pyramid is square, the others are round. A hemisphere whose height is not that of the
        cut sphere is stretched upwards, into half a spheroid.
    width
        Of the base, m, > 0: a side of the square or a diameter.
    height
        From base to flat top, m, > 0.
    cut
        Width of the flat top as a part of the base's, 0 (sharp) to 1; always 1 for a cylinder.

    Raises
    ------
    InvalidInputError
        If one of these does not hold.
    """

    shape: Shape
    width: float = 6 * MM
    height: float = 3 * MM
    cut: float = 1.0

    def __post_init__(self) -> None:
        if self.shape not in SHAPES:
            raise InvalidInputError("shape", expected=f"one of {SHAPES}", got=self.shape)
        check_positive(width=self.width, height=self.height)
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

    Parameters
    ----------
    cut
        Radius of the flat top as a part of the sphere's, 0 to below 1.
    radius
        Of the sphere, m.

    Examples
    --------
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

    Raises
    ------
    InvalidInputError
        If y is outside the element.
    """
    part = y / element.height
    if not np.all((part >= 0) & (part <= 1)):
        raise InvalidInputError("y", expected=f"0 to {element.height:g} m", got=y)
    if element.shape == "pyramid":
        return element.base_area * (1 - (1 - element.cut) * part) ** 2
    return element.base_area * (1 - (1 - element.cut**2) * part**2)
