"""Whether equations agree that the text says do, within Chapter 5 and with Chapter 3.

Ludwick's beam is derived once more by numbers alone: the stress is integrated over the section, and
the curvature along a beam with a force at its tip.
"""

from dataclasses import dataclass

from scipy.integrate import quad

from softgrip.actuator import bending, frequency
from softgrip.actuator.section import Section
from softgrip.dynamics import linear, ludwick
from softgrip.units import MM, MPa

WIDTH, HEIGHT, LENGTH = 30 * MM, 24 * MM, 94 * MM
"""Of the finger (Section 3.4). No ratio below depends on them."""
YOUNG_MODULUS = 0.34 * MPa
POWER = 2.365
"""n of Dragon Skin 20 as Table 5.2 estimates it."""


@dataclass(frozen=True)
class Agreement:
    """Two quantities that should be the same.

    Attributes:
        name: Key.
        what: Both, in words.
        ratio: First over second; 1 where they agree.
    """

    name: str
    what: str
    ratio: float

    @property
    def holds(self) -> bool:
        """Whether the two agree, up to the error of the quadrature."""
        return abs(self.ratio - 1) < 1e-6


def section_integral(fractional_power: float, width: float, height: float) -> float:
    """Return I_n of ``M = E I_n kappa**n`` by quadrature, m^(3 + n).

    A fibre at distance y from the middle is strained by ``kappa y``; its stress by Ludwick's law,
    Eq. (5.2), odd in y, has the lever y.

    >>> round(section_integral(1.0, 12.0, 1.0), 9)
    1.0
    """
    n = fractional_power
    above, _ = quad(lambda y: y * width * y**n, 0, height / 2, epsabs=0)
    return float(2 * above)


def tip_loaded_angle(
    force: float, bending_stiffness: float, fractional_power: float, length: float
) -> float:
    """Return the slope at the tip, rad, of a nearly straight cantilever with a force there.

    At s the moment is ``force (length - s)``, and the curvature ``(moment / (E I_n))**(1/n)``.

    Args:
        force: N, across the beam.
        bending_stiffness: ``E I_n``, N m^(1 + n).
        fractional_power: n, >= 1.
        length: m.

    >>> round(tip_loaded_angle(2.0, 1.0, 1.0, 1.0), 9)  # F L**2 / (2 E I)
    1.0
    """
    n = fractional_power
    angle, _ = quad(
        lambda s: (force * (length - s) / bending_stiffness) ** (1 / n), 0, length, epsabs=0
    )
    return float(angle)


def pressed_angle(
    moment: float, bending_stiffness: float, fractional_power: float, length: float
) -> float:
    """Return the angle, rad, of a beam bent by one moment (N m) all along, as pressure does."""
    return float((moment / bending_stiffness) ** (1 / fractional_power) * length)


def agreements(power: float = POWER) -> tuple[Agreement, ...]:
    """Compare the equations; `power` is the n of those that hold for any.

    >>> [a.name for a in agreements() if not a.holds]
    ['moment', 'spring', 'force', 'moment-3', 'moment-integral', 'spring-3', 'pressed']
    """
    size = {"width": WIDTH, "height": HEIGHT}
    whole = {**size, "length": LENGTH}
    E, n = YOUNG_MODULUS, power
    section = Section(HEIGHT - 4 * MM, 4 * MM, WIDTH, 1.5 * MM)
    finger = bending.Finger(section, LENGTH, E, n)
    integral = section_integral(n, **size)
    # Any force will do; that of Eq. (5.12) is the one that holds 1 rad.
    tip_force = E * integral / LENGTH ** (n + 1)
    tip = tip_loaded_angle(tip_force, E * integral, n, LENGTH)
    pressed = pressed_angle(tip_force * LENGTH, E * integral, n, LENGTH)
    spring = ludwick.spring_constant(E, n, **whole)
    longer = {name: 10 * value for name, value in whole.items()}
    return (
        Agreement("moment", "I_n of Eq. (5.14) at n = 1 to I of Eq. (5.11)",
                  ludwick.modified_moment(1.0, **size) / linear.moment_of_inertia(**size)),
        Agreement("spring", "K_n of Eq. (5.13) at n = 1 to K of Eq. (5.10)",
                  ludwick.spring_constant(E, 1.0, **whole) / linear.spring_constant(E, **whole)),
        Agreement("force", "force of Eq. (5.12) at n = 1 to that of Eq. (5.9)",
                  float(ludwick.restoring_force(1.0, ludwick.spring_constant(E, 1.0, **whole), 1.0))
                  / linear.force(1.0, linear.spring_constant(E, **whole))),
        Agreement("chapter-3", "I_n of Eq. (3.8) at n = 1 to I of Eq. (5.11)",
                  bending.modified_moment(1.0, **size) / linear.moment_of_inertia(**size)),
        Agreement("moment-3", "I_n of Eq. (5.14) to that of Eq. (3.8)",
                  ludwick.modified_moment(n, **size) / bending.modified_moment(n, **size)),
        Agreement("integral-3", "Ludwick's stress, integrated over the section, to Eq. (3.8)",
                  integral / bending.modified_moment(n, **size)),
        Agreement("moment-integral", "I_n of Eq. (5.14) to the stress, integrated",
                  ludwick.modified_moment(n, **size) / integral),
        Agreement("spring-3", "K_n of Eq. (5.13) to K of Eq. (3.14)",
                  spring / frequency.spring_constant(finger)),
        Agreement("tip", "factor ((n + 1) / n)^n to a beam with a force at its tip, integrated",
                  ((n + 1) / n) ** n * tip**n),
        Agreement("pressed", "the same factor to a beam with one moment all along",
                  ((n + 1) / n) ** n * pressed**n),
        Agreement("unit", "K_n of a finger ten times as large to 100 K_n: is it a force?",
                  ludwick.spring_constant(E, n, **longer) / (100 * spring)),
    )  # fmt: skip


def agreement(name: str) -> Agreement:
    """Find one of `agreements` by its name."""
    return {one.name: one for one in agreements()}[name]
