"""The natural frequency of the finger from its dimensions, Eq. (3.11)-(3.23)."""

from softgrip.actuator.bending import Finger, modified_moment
from softgrip.actuator.section import Section, wall_area
from softgrip.arrays import Number


def spring_constant(finger: Finger) -> Number:
    """Return K of ``F = K theta**n``, Eq. (3.14), N per rad**n.

    The force F acts at the tip, across the beam, and Eq. (3.13) takes the beam as nearly straight.
    """
    section, n = finger.section, finger.fractional_power
    moment = modified_moment(n, section.width, section.height)
    return ((n + 1) / n) ** n * finger.young_modulus * moment / finger.length ** (n + 1)


def natural_frequency(finger: Finger, mass: Number) -> Number:
    """Return omega_n, rad/s, Eq. (3.16), the root of Eq. (3.18), which is K / M_eq in Eq. (3.15).

    For n other than 1 it is the frequency of no motion: that of ``theta'' + omega**2 theta**n = 0``
    depends on the amplitude, and equals omega_n at no particular one.

    Args:
        finger: Its section, length and material.
        mass: M_eq, kg, > 0. The unit of ``K / M`` is m/s^2 and not 1/s^2: Eq. (3.11) sets a force
            equal to a mass times an *angular* acceleration, so that a length of 1 m is hidden in
            it.

    >>> finger = Finger(Section(0.02, 0.004, 0.03, 0.0015), fractional_power=1.05)
    >>> round(natural_frequency(finger, 0.35), 2)
    2.61
    """
    return (spring_constant(finger) / mass) ** 0.5


def stiffness_product(section: Section, young_modulus: Number, fractional_power: Number) -> Number:
    """Return ``E w (a + b)**(n + 2)``, N m^n: what of a section its natural frequency hangs on."""
    return young_modulus * section.width * section.height ** (fractional_power + 2)


def stiffness_product_for(
    frequency: Number, mass: Number, fractional_power: Number, length: Number
) -> Number:
    """Return the stiffness product, Eq. (3.19), for a frequency [rad/s] and a mass [kg], N m^n."""
    n = fractional_power
    return (n / (n + 1)) ** n * 2 ** (n + 1) * (n + 2) * mass * frequency**2 * length ** (n + 1)


def rubber_mass(section: Section, length: Number, density: Number) -> Number:
    """Return the mass of the wall over the length, kg (Remark 2: volume times density).

    End caps and the partitions between chambers are not counted: their sizes are not printed.

    >>> round(rubber_mass(Section(0.02, 0.004, 0.03, 0.0015), 0.094, 1080.0), 4)
    0.0224
    """
    return density * length * wall_area(section)
