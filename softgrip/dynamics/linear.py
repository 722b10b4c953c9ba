"""The finger as a mass, a damper and a spring after Hooke's law, Eq. (5.9)-(5.11) and (5.17)."""

from softgrip.arrays import Number, check_positive
from softgrip.dynamics.ludwick import LudwickFinger
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError


def moment_of_inertia(width: Number, height: Number) -> Number:
    """Return I of a rectangular section, Eq. (5.11), m^4.

    Args:
        width, height: b and h, m, > 0.

    >>> moment_of_inertia(12.0, 1.0)
    1.0
    """
    return width * height**3 / 12


def spring_constant(young_modulus: Number, width: Number, height: Number, length: Number) -> Number:
    """Return K, Eq. (5.10), N/rad: the spring of a cantilever with a force at its tip.

    Args:
        young_modulus: E, Pa, > 0.
        width, height, length: b, h and L_0, m, > 0.

    >>> spring_constant(6.0, 1.0, 1.0, 1.0)
    1.0
    """
    return 2 * young_modulus * moment_of_inertia(width, height) / length**2


def force(angle: Number, stiffness: Number) -> Number:
    """Return the force at the tip, N, that holds an angle [rad], Eq. (5.9).

    The print calls it P here and F in the sentence below; it is a force, not a pressure.
    """
    return stiffness * angle


def linear_finger(mass: float, damping: float, stiffness: float) -> LudwickFinger:
    """Return the finger with a linear spring, n = 1, Eq. (5.17); units as in `LudwickFinger`."""
    return LudwickFinger(mass, damping, stiffness, 1.0)


def second_order(finger: LudwickFinger, force_per_pressure: float) -> SecondOrder:
    """Return a linear finger by its damping ratio and natural frequency, Eq. (3.12) at n = 1.

    It is the system from pressure to angle of Eq. (4.13).

    Args:
        finger: One finger with n = 1 and a stiffness above zero.
        force_per_pressure: F over P, N/Pa, > 0.

    Raises:
        InvalidInputError: If the finger is not linear.

    >>> second_order(linear_finger(0.5, 1.0, 2.0), 1e-5)
    SecondOrder(natural_frequency=2.0, damping_ratio=0.5, gain=5e-06)
    """
    m, c, k, n = (
        float(value)  # type: ignore[arg-type]
        for value in (finger.mass, finger.damping, finger.stiffness, finger.fractional_power)
    )
    if n != 1:
        raise InvalidInputError("finger", expected="a fractional power of 1", got=n)
    check_positive(stiffness=k)
    frequency = (k / m) ** 0.5
    return SecondOrder(frequency, c / (2 * m * frequency), force_per_pressure / k)
