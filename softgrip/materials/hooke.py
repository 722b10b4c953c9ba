"""Hooke's law: stress proportional to strain."""

from softgrip.arrays import Value, check_positive
from softgrip.checks import takes_numbers


@takes_numbers
def stress(strain: Value, young_modulus: float) -> Value:
    """Return the stress of a linear material, Eq. (5.1).

    Args:
        strain: Engineering strain, dimensionless, any shape. Meant for small strains; an elastomer
            leaves the line well before it has doubled its length.
        young_modulus: E, Pa, > 0.

    Returns:
        float or ndarray: Engineering stress, Pa, shape of `strain`.

    Raises:
        InvalidInputError: If `young_modulus` is not a finite number above zero.

    >>> stress(0.1, 0.26e6)
    26000.0
    """
    check_positive(young_modulus=young_modulus)
    return young_modulus * strain
