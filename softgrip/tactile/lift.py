"""What a grip can lift by friction, Eq. (2.8) and (2.9), and how surely."""

from scipy.stats import norm

from softgrip.arrays import Value, check_positive
from softgrip.errors import InvalidInputError


def contact_force(lift_force: Value, friction: float) -> Value:
    """Return the force with which each of two fingers must press, N: Eq. (2.8).

    Parameters
    ----------
    lift_force
        What the fingers are to bear by friction, N, any shape; it should exceed the weight.
    friction
        Coefficient of Coulomb's law between finger and object, > 0, the same for both fingers.

    Raises
    ------
    InvalidInputError
        If the coefficient is not above zero.

    Examples
    --------
    >>> contact_force(0.6, friction=1.0)
    0.3
    """
    check_positive(friction=friction)
    return lift_force / (2 * friction)


def lift_force(contact_force: Value, friction: float) -> Value:
    """Return what two fingers can bear by friction, N: Eq. (2.9); arguments as `contact_force`."""
    check_positive(friction=friction)
    return 2 * friction * contact_force


def holding_probability(lift_force: float, weight: float, friction: float, error: float) -> float:
    """Return how probable it is that a grip holds whose force is known by a sensor only.

    The sensor says that the grip lifts `lift_force`; the true contact force deviates from what it
    says by a normal error. The object is held if the true lift force is at least its weight.

    Parameters
    ----------
    lift_force, weight
        N.
    friction
        As of `contact_force`.
    error
        Deviation of the measured contact force, N, > 0.

    Raises
    ------
    InvalidInputError
        If friction or error is not above zero, or the weight is below it.

    Examples
    --------
    A lift force that is the weight holds every second time, whatever the sensor.

    >>> holding_probability(0.6, 0.6, friction=1.0, error=0.015)
    0.5
    """
    check_positive(error=error)
    if not weight >= 0:
        raise InvalidInputError("weight", expected="N, >= 0", got=weight)
    spare = contact_force(lift_force - weight, friction)
    return float(norm.cdf(spare / error))
