"""How far a sensing element of the feature-detection layer is shortened by a force, Eq. (2.1).

Each slice of an element is taken to bear the force evenly and to be free to widen. What this
leaves out, the clamped base and a small top that sinks into a wide body, is left to
`softgrip.tactile.element_fem`.
"""

from collections.abc import Callable
from math import acosh, inf, isfinite, sqrt

import numpy as np
from scipy.integrate import quad

from softgrip.arrays import Value, check_positive
from softgrip.errors import InvalidInputError
from softgrip.tactile.element_shape import SHAPES, Element, Shape, cross_section, cut_sphere
from softgrip.units import MPa

__all__ = [
    "SHAPES",
    "STATED_MODULUS",
    "TABLE_MODULUS",
    "Element",
    "Shape",
    "compliance",
    "compliance_of",
    "cross_section",
    "cut_sphere",
    "shortening",
]

STATED_MODULUS = 0.125 * MPa
"""E of Ecoflex 00-30 as Section 2.2 states it, Pa."""

TABLE_MODULUS = 0.1 * MPa
"""E with which the Hertzian row of Table 2.1 comes out, Pa; no place prints it."""


def compliance(element: Element, young_modulus: float = STATED_MODULUS) -> float:
    """Return shortening by force, m/N, Eq. (2.1) in closed form; infinite for a sharp top.

    With the width w, the height L, the base A and the cut k it is ``L / (E A)`` times 1 for a
    cylinder, ``1 / k`` for a pyramid, ``arcosh(1 / k) / sqrt(1 - k**2)`` for a hemisphere.

    Examples
    --------
    Table 2.1 in mm at 0.1 N, a pyramid whose top is 0.72 mm wide:

    >>> round(1e3 * 0.1 * compliance(Element("pyramid", cut=0.12), TABLE_MODULUS), 3)
    0.694
    >>> compliance(Element("pyramid", cut=0.0))
    inf
    """
    check_positive(young_modulus=young_modulus)
    block, k = element.height / (young_modulus * element.base_area), element.cut
    if k == 0:
        return inf
    if k == 1:
        return block
    return block * (1 / k if element.shape == "pyramid" else acosh(1 / k) / sqrt(1 - k**2))


def compliance_of(
    area: Callable[[float], float], height: float, young_modulus: float = STATED_MODULUS
) -> float:
    """Return shortening by force, m/N, Eq. (2.1) by quadrature for any cross-section.

    Parameters
    ----------
    area
        A(y), m^2, smooth and above zero from y = 0 to the height.
    height
        L, m.
    young_modulus
        E, Pa.

    Raises
    ------
    InvalidInputError
        If the cross-section is not above zero at either end: with a sharp top the integral
        diverges.
    """
    check_positive(height=height, young_modulus=young_modulus)
    ends = area(0.0), area(height)
    if not min(ends) > 0:
        raise InvalidInputError("area", expected="a cross-section > 0 at both ends", got=ends)
    # Over the part of the height, so that the tolerance is relative to a number near one.
    mean = quad(lambda part: ends[0] / area(part * height), 0, 1, epsrel=1e-10, limit=200)[0]
    return float(mean * height / (young_modulus * ends[0]))


def shortening(element: Element, force: Value, young_modulus: float = STATED_MODULUS) -> Value:
    """Return how far a force shortens an element, m, Eq. (2.1).

    It is linear: where it is no longer small beside the height, it is an extrapolation.

    Parameters
    ----------
    element
        With a flat top: cut > 0.
    force
        N, >= 0, float or array.
    young_modulus
        E, Pa.

    Raises
    ------
    InvalidInputError
        If the force is not, or the top is sharp, where any force shortens without limit.
    """
    if not np.all(np.asarray(force) >= 0):
        raise InvalidInputError("force", expected="N, >= 0", got=force)
    soft = compliance(element, young_modulus)
    if not isfinite(soft):
        raise InvalidInputError("element", expected="a flat top (cut > 0)", got=element)
    return soft * force
