"""How far pressure bends a free finger, Eq. (3.7)-(3.10)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.actuator.section import Section, check_section, torque, wall_stress_ratio
from softgrip.arrays import Floats, Number, check_positive, is_symbol
from softgrip.errors import InvalidInputError
from softgrip.units import MM, MPa

LARGEST_POWER = 20.0
"""Of Ludwick's law: those of elastomers are up to 3; far above, torques have no number any more."""


@dataclass(frozen=True)
class Finger:
    """A finger as Chapter 3's models see it.

    Attributes:
        section: Its cross-section.
        length: L_i at rest, m, > 0 (94 mm in Section 3.4).
        young_modulus: E, Pa, > 0.
        fractional_power: n, >= 1.

    Raises:
        InvalidInputError: If a number is out of its range. The section is checked where it is used.
    """

    section: Section
    length: Number = 94 * MM
    young_modulus: Number = 0.34 * MPa
    fractional_power: Number = 1.0

    def __post_init__(self) -> None:
        numbers = (self.length, self.young_modulus, self.fractional_power)
        if all(isinstance(number, float | int) for number in numbers):  # symbols have no range
            check_positive(length=self.length, young_modulus=self.young_modulus)
            check_power(self.fractional_power)


def check_power(fractional_power: float) -> None:
    """Raise InvalidInputError unless n is a finite number >= 1, as Section 3.2 has it."""
    if not is_symbol(fractional_power) and not 1 <= fractional_power <= LARGEST_POWER:
        raise InvalidInputError(
            "fractional_power",
            expected=f"a finite number >= 1, up to {LARGEST_POWER:g}",
            got=fractional_power,
        )


def modified_moment(fractional_power: Number, width: Number, height: Number) -> Number:
    """Return the moment of inertia I_n of a solid rectangle, Eq. (3.8), m^(3 + n).

    ``M = E I_n kappa**n`` follows from integrating ``y E (kappa y)**n`` over the section. At n = 1
    it is ``w h**3 / 12``.

    Args:
        fractional_power: n, >= 1.
        width, height: w and h = a + b, m, > 0.

    >>> modified_moment(1.0, 12.0, 1.0)
    1.0
    """
    n = fractional_power
    return 0.5 ** (1 + n) / (2 + n) * width * height ** (2 + n)


def elongation(section: Section, pressure: Number, young_modulus: Number) -> Number:
    """Return ``(L_i + delta L) / L_i`` of Eq. (3.9): ``1 + P A_c / (A_w E)``, dimensionless."""
    return 1 + pressure * wall_stress_ratio(section) / young_modulus


def bending_angle(finger: Finger, pressure: Number, *, elongated: bool = True) -> Number:
    """Return theta, rad, at a pressure [Pa]: Eq. (3.10), or Eq. (3.7) if not `elongated`.

    It holds where the torque is not negative: b >= t and P >= 0. Then ``T**(1/n)`` is real.

    >>> from softgrip.units import DEG
    >>> finger = Finger(Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM))
    >>> round(bending_angle(finger, 0.15 * MPa) / DEG, 1)
    140.1
    """
    section, E, n = finger.section, finger.young_modulus, finger.fractional_power
    stiffness = E * modified_moment(n, section.width, section.height)
    curvature = (torque(section, pressure) / stiffness) ** (1 / n)
    longer = elongation(section, pressure, E) if elongated else 1.0
    return n / (n + 1) * curvature * finger.length * longer


def free_bending(finger: Finger, pressure: ArrayLike) -> Floats:
    """Return `bending_angle` of numbers, elongated, rad, after checking that it is defined.

    Args:
        finger: With a section of numbers.
        pressure: Pa, >= 0, any shape that broadcasts with the section.

    Raises:
        InvalidInputError: If the section is no chamber, b < t, or a pressure is negative or not
            finite.
    """
    check_section(finger.section)
    gauge = np.asarray(pressure, dtype=np.float64)
    if not (np.isfinite(gauge).all() and (gauge >= 0).all()):
        raise InvalidInputError("pressure", expected="finite, >= 0 Pa", got=gauge.tolist())
    bottom, wall = np.asarray(finger.section.bottom), np.asarray(finger.section.wall)
    if not (bottom >= wall).all():
        raise InvalidInputError(
            "bottom",
            expected=f"at least the wall, {wall.tolist()} m (thinner, it bends backwards)",
            got=bottom.tolist(),
        )
    return np.asarray(bending_angle(finger, gauge), dtype=np.float64)
