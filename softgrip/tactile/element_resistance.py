"""Resistance of an element's conductive skin, from how far the element is shortened.

The dissertation prints a range, 1 to 1.5 MOhm, and no law. The one here is the simplest without a
number of its own: rubber keeps its volume, so an element whose height shrinks by the factor 1 - e
widens by ``1 / sqrt(1 - e)`` both ways; its ink, a film that keeps its volume too, then has the
same length by width, but only the part 1 - e of its thickness. The resistance is divided by 1 - e.
"""

import numpy as np

from softgrip.arrays import Floats, Value, check_positive
from softgrip.errors import InvalidInputError
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

    Parameters
    ----------
    shortening
        m, >= 0, float or array. From a third of the height on, the ceiling is returned.
    height
        Of the element without load, m.
    at_rest, ceiling
        Range of the resistance, Ohm, ceiling above at_rest.

    Raises
    ------
    InvalidInputError
        If one of these does not hold.

    Examples
    --------
    >>> round(resistance(0.5e-3)), round(resistance(2e-3))
    (1200000, 1500000)
    """
    check_positive(height=height, at_rest=at_rest)
    if not ceiling > at_rest:
        raise InvalidInputError("ceiling", expected=f"Ohm, > {at_rest:g}", got=ceiling)
    if not np.all(np.asarray(shortening) >= 0):
        raise InvalidInputError("shortening", expected="m, >= 0", got=shortening)
    # Bounded before the division: a linear law may shorten by more than the height.
    thinned: float | Floats = np.maximum(1 - shortening / height, at_rest / ceiling)
    return at_rest / thinned  # type: ignore[return-value]
