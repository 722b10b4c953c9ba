"""What an element feels: the resistance of its skin, the least force that changes it.

The dissertation prints a range, 1 to 1.5 MOhm, and no law. The one here is the simplest without a
number of its own: rubber keeps its volume, so an element whose height shrinks by the factor 1 - e
widens by ``1 / sqrt(1 - e)`` both ways; its ink, a film that keeps its volume too, then has the
same length by width, but only the part 1 - e of its thickness. The resistance is divided by 1 - e.
"""

import numpy as np
from scipy.optimize import brentq

from softgrip.arrays import Floats, Value, check_positive, is_symbol
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, compliance, shortening
from softgrip.units import MM

AT_REST = 1.0e6
"""Resistance of an element without load as Section 2.2 prints it, Ohm."""

CEILING = 1.5e6
"""Largest resistance that Section 2.2 prints, Ohm; beyond it nothing is read."""


def resistance(
    shortening: Value,
    height: float = 3 * MM,
    at_rest: float = AT_REST,
    ceiling: float = CEILING,
) -> Value:
    """Return the resistance of an element's skin, Ohm: ``at_rest / (1 - shortening / height)``.

    Args:
        shortening: m, >= 0, float or array. From a third of the height on, the ceiling is returned.
        height: Of the element without load, m.
        at_rest, ceiling: Range of the resistance, Ohm, ceiling above at_rest.

    Raises:
        InvalidInputError: If one of these does not hold.

    >>> round(resistance(0.5e-3)), round(resistance(2e-3))
    (1200000, 1500000)
    """
    check_positive(height=height, at_rest=at_rest)
    if not ceiling > at_rest:
        raise InvalidInputError("ceiling", expected=f"Ohm, > {at_rest:g}", got=ceiling)
    if not is_symbol(shortening) and not np.all(np.asarray(shortening) >= 0):
        raise InvalidInputError("shortening", expected="m, >= 0", got=shortening)
    # Bounded before the division: a linear law may shorten by more than the height.
    thinned: float | Floats = np.maximum(1 - shortening / height, at_rest / ceiling)
    return at_rest / thinned  # type: ignore[return-value]


def resistance_under(
    element: Element, force: Value, young_modulus: float = STATED_MODULUS
) -> Value:
    """Return the resistance of an element under a force (N, float or array), Ohm."""
    return resistance(shortening(element, force, young_modulus), element.height)


def least_force(
    element: Element, resistance_change: float, young_modulus: float = STATED_MODULUS
) -> float:
    """Return the force at which the resistance has risen by a change, N.

    The inverse of `resistance_under`. The ratio of two elements' forces depends neither on the
    modulus nor, while it is small, on the change.

    Args:
        element: With a flat top, or with a sharp one, which feels any force: 0.
        resistance_change: Ohm, > 0, up to the range of 0.5 MOhm.
        young_modulus: E, Pa.

    Raises:
        InvalidInputError: If one of these does not hold.
    """
    check_positive(resistance_change=resistance_change)
    if resistance_change > CEILING - AT_REST:
        raise InvalidInputError(
            "resistance_change", expected=f"up to {CEILING - AT_REST:g} Ohm", got=resistance_change
        )
    part = resistance_change / (AT_REST + resistance_change)
    return part * element.height / compliance(element, young_modulus)


def relative_compliance(shape: Shape, cut: float, equal: str = "width") -> float:
    """Return the compliance as a part of a cylinder's of equal height and modulus.

    Args:
        shape, cut: As in `Element`; cut above 0.
        equal: What the element shares with the cylinder: "width" of the base, "area" of the base,
            or "volume".

    Raises:
        InvalidInputError: If one of these is not as said.

    >>> round(relative_compliance("pyramid", 0.5, equal="area"), 9)
    2.0
    """
    found, cylinder = Element(shape, cut=1.0 if shape == "cylinder" else cut), Element("cylinder")
    shares = {
        "width": 1.0,
        "area": found.base_area / cylinder.base_area,
        "volume": found.volume / cylinder.volume,
    }
    if equal not in shares:
        raise InvalidInputError("equal", expected=f"one of {list(shares)}", got=equal)
    # A body made wider by the factor s has s**2 the area and volume, and 1 / s**2 the compliance.
    return shares[equal] * compliance(found) / compliance(cylinder)


def equal_cut() -> float:
    """Return the cut at which pyramid and hemisphere of one width are equally compliant.

    Flatter tops than this make the hemisphere the softer one; a round base has the smaller area.

    >>> round(equal_cut(), 3)
    0.537
    """

    def excess(cut: float) -> float:
        return relative_compliance("pyramid", cut) - relative_compliance("hemisphere", cut)

    return float(brentq(excess, 0.1, 0.9))
