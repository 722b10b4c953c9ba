"""The optimal design problem, Eq. (3.17) and (3.20), and its feasible set."""

from dataclasses import dataclass, field
from math import inf, isfinite, pi
from typing import Any, Literal, get_args

from softgrip.actuator.bending import Finger, bending_angle, check_power
from softgrip.actuator.frequency import stiffness_product, stiffness_product_for
from softgrip.actuator.section import Section, torque
from softgrip.arrays import Number, check_positive
from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.materials.table import material
from softgrip.plausible import ANGLE, DIMENSION, LENGTH, MASS, PRESSURE, YOUNG_MODULUS
from softgrip.quantities import fields_in_si
from softgrip.units import MM, MPa

Range = tuple[float, float]
Combined = Literal["sum", "product", "torque"]
DIMENSIONS = ("top", "bottom", "width", "wall")

SCRIPT_POWER, SCRIPT_MASS = 1.0, 0.36
"""n, and M as a number of kilograms, of the design script that the author published.

The dissertation states no n, and of M only the "N" of Table 3.3.
"""


class InfeasibleDesignError(SoftgripError, ValueError):
    """No section fulfils all constraints; names the one that cannot be met, and what could be."""


@dataclass(frozen=True)
class Bounds:
    """The box of a, b and w, Eq. (3.22), and of t and h: least and largest value of each, m.

    The defaults are those of Section 3.3, with the ranges of a and b exchanged: as printed, a (2
    to 5 mm) and b (14 to 24 mm) contradict Table 3.1, where a is 20 and b 4 mm.

    Attributes:
        top, bottom, width, wall: Of a, b, w and t.
        height: Of h = a + b.

    Raises:
        InvalidInputError: If a range is empty, or a section with the thinnest wall would be none:
            ``t < a``, ``2 t < w``.
    """

    top: Range = (14 * MM, 24 * MM)
    bottom: Range = (2 * MM, 5 * MM)
    width: Range = (10 * MM, 30 * MM)
    wall: Range = (1.5 * MM, 3.0 * MM)
    height: Range = (15 * MM, 25 * MM)

    def __post_init__(self) -> None:
        fields_in_si(self, dict.fromkeys((*DIMENSIONS, "height"), "m"))
        for name in (*DIMENSIONS, "height"):
            low, high = getattr(self, name)
            if not (0 < low <= high and isfinite(high)):
                raise InvalidInputError(
                    name, expected="0 < least <= largest, finite, m", got=(low, high)
                )
        for name, factor in (("top", 1), ("width", 2)):
            if not getattr(self, name)[0] > factor * self.wall[0]:
                raise InvalidInputError(
                    name,
                    expected=f"more than {factor} x the thinnest wall, {factor * self.wall[0]:g} m",
                    got=getattr(self, name)[0],
                )


SCRIPT_BOUNDS = Bounds(bottom=(2 * MM, 4 * MM), height=(18 * MM, 24 * MM))
"""Those of the design script, where b and h end lower than Section 3.3 has them."""


@dataclass(frozen=True)
class FrequencyBand:
    """A band of natural frequencies, as those of Table 3.2.

    Attributes:
        low, high: omega_n1 and omega_n2, rad/s, 0 <= low <= high.
        least_mass, largest_mass: M_1 and M_2, kg. Their values are not printed; the defaults are
            those of the author's script.
    """

    low: float
    high: float
    least_mass: float = SCRIPT_MASS
    largest_mass: float = SCRIPT_MASS

    def __post_init__(self) -> None:
        fields_in_si(
            self, {"low": "rad/s", "high": "rad/s", "least_mass": "kg", "largest_mass": "kg"}
        )
        check_positive(least_mass=self.least_mass, largest_mass=self.largest_mass, high=self.high)
        if not 0 <= self.low <= self.high:
            raise InvalidInputError(
                "low, high", expected="0 <= low <= high, rad/s", got=(self.low, self.high)
            )


@dataclass(frozen=True)
class DesignProblem:
    """The best section within bounds, Eq. (3.17); with a band of frequencies it is Eq. (3.20).

    A number is in SI; words such as ``"20 kPa"``, or a quantity of `pint`, are put into it. So are
    those of `Bounds` and of `FrequencyBand`.

    Attributes:
        pressure: P, Pa, > 0: held, as ``P' = 0`` says. Its value is not printed.
        young_modulus, fractional_power, length: Of the material and the finger: Pa, dimensionless,
            m. The default n is that of the author's script.
        torque_scale, angle_scale: What T and theta are divided by, N m and rad (Section 3.3).
        bounds: Of the dimensions.
        band: Of the natural frequency, or None.
        combined: The sum of Eq. (3.17), the product of torque and angle, or the torque alone.
    """

    pressure: float = 0.15 * MPa
    young_modulus: float = 0.34 * MPa
    fractional_power: float = SCRIPT_POWER
    length: float = 94 * MM
    torque_scale: float = 0.4
    angle_scale: float = 1.4 * pi
    bounds: Bounds = field(default_factory=Bounds)
    band: FrequencyBand | None = None
    combined: Combined = "sum"

    def __post_init__(self) -> None:
        fields_in_si(
            self,
            {"pressure": "Pa", "young_modulus": "Pa", "length": "m", "torque_scale": "N m",
             "angle_scale": "rad"},
        )  # fmt: skip
        check_positive(
            pressure=self.pressure,
            young_modulus=self.young_modulus,
            length=self.length,
            torque_scale=self.torque_scale,
            angle_scale=self.angle_scale,
        )
        check_power(self.fractional_power)
        if self.combined not in get_args(Combined):
            raise InvalidInputError(
                "combined", expected=f"one of {get_args(Combined)}", got=self.combined
            )

    @classmethod
    def for_material(cls, name: str, **others: Any) -> "DesignProblem":
        """Return the problem for a material of Table 5.1, with its E and n; the rest as given.

        UnknownNameError is raised if the table has no such material, and lists those it has.

        >>> DesignProblem.for_material("Ecoflex 00-30", pressure=30e3).young_modulus
        70000.0
        """
        rubber = material(name)
        return cls(
            young_modulus=rubber.young_modulus, fractional_power=rubber.fractional_power, **others
        )

    def finger(self, section: Section) -> Finger:
        """Return the finger with a section."""
        return Finger(section, self.length, self.young_modulus, self.fractional_power)

    def product_for(self, frequency: float, mass: float) -> float:
        """Return C, N m^n, for a frequency [rad/s] and a mass [kg]."""
        found: float = stiffness_product_for(frequency, mass, self.fractional_power, self.length)
        return found

    @property
    def product_range(self) -> Range:
        """C_1 and C_2, Eq. (3.23), N m^n; 0 and infinity without a band."""
        if self.band is None:
            return 0.0, inf
        return (
            self.product_for(self.band.low, self.band.least_mass),
            self.product_for(self.band.high, self.band.largest_mass),
        )


def combine(combined: Combined, torque: Number, angle: Number) -> Number:
    """Return the sum or the product of ``T / T_0`` and ``theta / theta_0``, or the first alone."""
    if combined == "torque":
        return torque
    return torque + angle if combined == "sum" else torque * angle


def objective(problem: DesignProblem, section: Section) -> Number:
    """Return what is made large, ``T / T_0 + theta / theta_0`` or the product, where b >= t."""
    bent = bending_angle(problem.finger(section), problem.pressure)
    pushed = torque(section, problem.pressure)
    return combine(problem.combined, pushed / problem.torque_scale, bent / problem.angle_scale)


def product(problem: DesignProblem, section: Section) -> Number:
    """Return what Eq. (3.21) keeps between C_1 and C_2: ``E w (a + b)**(n + 2)``, N m^n."""
    return stiffness_product(section, problem.young_modulus, problem.fractional_power)


def height_range(bounds: Bounds) -> Range:
    """Return the heights that a, b and h allow together, m; empty if the first is larger."""
    return (
        max(bounds.height[0], bounds.top[0] + bounds.bottom[0]),
        min(bounds.height[1], bounds.top[1] + bounds.bottom[1]),
    )


def check_units(problem: DesignProblem) -> None:
    """Raise InvalidInputError for the first number that is likely to be in another unit than SI."""
    bounds, band = problem.bounds, problem.band
    LENGTH.check("length", problem.length)
    for name in (*DIMENSIONS, "height"):
        DIMENSION.check(name, getattr(bounds, name))
    PRESSURE.check("pressure", problem.pressure)
    YOUNG_MODULUS.check("young_modulus", problem.young_modulus)
    ANGLE.check("angle_scale", problem.angle_scale)
    if band is not None:
        MASS.check("least_mass, largest_mass", (band.least_mass, band.largest_mass))


def check_feasible(problem: DesignProblem) -> None:
    """Raise InfeasibleDesignError if no section fulfils the constraints.

    The product of Eq. (3.21) grows with w, a and b, so what it can be lies between two corners.
    InvalidInputError is raised for numbers in other units (`check_units`).
    """
    check_units(problem)
    bounds = problem.bounds
    low, high = height_range(bounds)
    if low > high:
        raise InfeasibleDesignError(
            f"height: expected {bounds.height[0]:g} to {bounds.height[1]:g} m, but a and b allow "
            f"{bounds.top[0] + bounds.bottom[0]:g} to {bounds.top[1] + bounds.bottom[1]:g} m"
        )
    if bounds.bottom[1] <= bounds.wall[0]:
        raise InfeasibleDesignError(
            f"bottom: expected one that can exceed the thinnest wall, {bounds.wall[0]:g} m, for a "
            f"positive torque; got at most {bounds.bottom[1]:g} m"
        )
    if problem.band is None:
        return
    power = problem.fractional_power + 2
    least = problem.young_modulus * bounds.width[0] * low**power
    largest = problem.young_modulus * bounds.width[1] * high**power
    first, last = problem.product_range
    if first > largest or last < least or first > last:
        band = problem.band
        slowest = (least / problem.product_for(1.0, band.largest_mass)) ** 0.5
        fastest = (largest / problem.product_for(1.0, band.least_mass)) ** 0.5
        nearest = min(max(band.low, slowest), fastest), min(max(band.high, slowest), fastest)
        raise InfeasibleDesignError(
            f"frequency band, Eq. (3.21): {band.low:g} to {band.high:g} rad/s asks for E w h**(n+2)"
            f" from {first:.4g} to {last:.4g}, the dimensions allow {least:.4g} to {largest:.4g}; "
            f"feasible are {slowest:.4g} to {fastest:.4g} rad/s, the nearest band is "
            f"{nearest[0]:.4g} to {nearest[1]:.4g} rad/s"
        )
