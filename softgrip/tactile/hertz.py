"""A hemisphere pressed by a flat rigid plate: contact theory of Hertz, Eq. (2.2)."""

import numpy as np

from softgrip.arrays import Value, check_positive, is_symbol
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import STATED_MODULUS
from softgrip.units import MM


def hertz_approach(
    force: Value,
    radius: float = 3 * MM,
    young_modulus: float = STATED_MODULUS,
    poisson_ratio: float = 0.49,
    exponent: float = 2 / 3,
) -> Value:
    """Return by how much a plate approaches the hemisphere's middle, m, Eq. (2.2).

    ``d = (3 F (1 - nu**2) / (4 E sqrt(R)))**(2/3)``. The print lacks the exponent, without which
    the right side is not a length. Valid while d is small beside R: the body below the contact is
    taken as a half space.

    Args:
        force: F, N, >= 0, float or array.
        radius: R of the hemisphere (w in the print), m.
        young_modulus, poisson_ratio: E, Pa, > 0; nu, above -1 and up to 0.5.
        exponent: 1 is what is printed.

    Raises:
        InvalidInputError: If one of these does not hold.

    The row of Table 2.1, mm, comes out with 0.1 MPa:

    >>> np.round(hertz_approach(np.array([0.1, 0.2, 0.3]), young_modulus=0.1e6) / MM, 3)
    array([0.477, 0.757, 0.991])
    """
    check_positive(radius=radius, young_modulus=young_modulus, exponent=exponent)
    if not is_symbol(poisson_ratio) and not -1 < poisson_ratio <= 0.5:
        raise InvalidInputError("poisson_ratio", expected="above -1, up to 0.5", got=poisson_ratio)
    if not is_symbol(force) and not np.all(np.asarray(force) >= 0):
        raise InvalidInputError("force", expected="N, >= 0", got=force)
    unit = 0.75 * (1 - poisson_ratio**2) / (young_modulus * np.sqrt(radius))
    return (unit * force) ** exponent  # type: ignore[no-any-return]
