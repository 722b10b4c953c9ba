"""The optimal design problem with weight and size in the loop, as Section 7.2 asks."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf

from softgrip.actuator.bending import Finger, bending_angle
from softgrip.actuator.buckling import buckling_pressures
from softgrip.actuator.design import DesignProblem, combine
from softgrip.actuator.frequency import stiffness_product
from softgrip.actuator.section import Section, torque
from softgrip.actuator.size import (
    CHAMBERS,
    Layout,
    air_volume,
    envelope,
    finger_mass,
    layout_of,
)
from softgrip.arrays import Number, check_positive
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.materials.densities import density as density_of
from softgrip.materials.table import material
from softgrip.quantities import fields_in_si

DRAGON_SKIN_20 = 1080.0
"""Density of the printed finger's rubber, kg/m^3, by its supplier."""


@dataclass(frozen=True)
class Limits:
    """What a design must do, and what it may weigh and take, beside the limits of its dimensions.

    A number is in SI; words such as ``"30 g"`` are put into it.

    Attributes:
        torque, angle: Least torque, N m, and bending, rad, at the problem's pressure.
        mass, envelope, air: Largest mass of the rubber, kg, volume of the box around the finger,
            and of the air at rest, m^3.
        buckling: Least buckling pressure over the pressure; 0 if buckling is not looked at.
    """

    torque: float = 0.0
    angle: float = 0.0
    mass: float = inf
    envelope: float = inf
    air: float = inf
    buckling: float = 0.0

    def __str__(self) -> str:
        """Return the limits that are set, in words and SI."""
        words = {
            "torque": "torque of {:.4g} N m at least",
            "angle": "bending of {:.4g} rad at least",
            "mass": "rubber of {:.4g} kg at most",
            "envelope": "box of {:.4g} m^3 at most",
            "air": "air of {:.4g} m^3 at most",
            "buckling": "buckling from {:.4g} times the pressure on",
        }
        told = {name: getattr(self, name) for name in words}
        told = {name: value for name, value in told.items() if value not in (0.0, inf)}
        return ", ".join(words[name].format(value) for name, value in told.items()) or "no limit"

    def __post_init__(self) -> None:
        units = {"torque": "N m", "angle": "rad", "mass": "kg", "envelope": "m^3", "air": "m^3"}
        asked = {name: unit for name, unit in units.items() if getattr(self, name) != inf}
        fields_in_si(self, asked)
        check_not_negative(torque=self.torque, angle=self.angle, buckling=self.buckling)
        for name in ("mass", "envelope", "air"):
            if not getattr(self, name) > 0:
                raise InvalidInputError(name, expected="more than 0", got=getattr(self, name))


@dataclass(frozen=True)
class LimitedProblem:
    """The optimal design of a finger of so many chambers, with limits of weight and size.

    Attributes:
        problem: Eq. (3.20) with its numbers; its length is that of the layout.
        layout: Chambers, caps and grooves.
        density: Of the rubber, kg/m^3.
        limits: Beside those of the problem.

    Raises:
        InvalidInputError: If the two lengths differ, the density is none, or a section within the
            bounds could be too small for the duct, where the laws of `size` are not monotone.
    """

    problem: DesignProblem = field(default_factory=DesignProblem)
    layout: Layout = field(default_factory=Layout)
    density: float = DRAGON_SKIN_20
    limits: Limits = field(default_factory=Limits)

    def __post_init__(self) -> None:
        fields_in_si(self, {"density": "kg/m^3"})
        check_positive(density=self.density)
        bounds, layout = self.problem.bounds, self.layout
        if layout.length != self.problem.length:
            raise InvalidInputError("layout", expected=f"{self.problem.length} m", got=layout)
        thick = bounds.wall[1]
        low, narrow = bounds.top[0] - thick, bounds.width[0] - 2 * thick
        if not (layout.duct <= min(low, narrow) and layout.duct <= layout.groove_floor < low):
            raise InvalidInputError(
                "layout",
                expected=f"duct and grooves within the least chamber, {low:g} x {narrow:g} m",
                got=layout,
            )
        if not layout.air_length(thick) > 0:
            raise InvalidInputError("layout", expected="room for its chambers", got=layout)

    @classmethod
    def for_material(
        cls,
        name: str,
        chambers: int = CHAMBERS,
        *,
        limits: Limits | None = None,
        **others: object,
    ) -> "LimitedProblem":
        """Return the problem for a material of Table 5.1 and chambers of the printed size.

        Args:
            name: The material, for its E, n and density.
            chambers: Their number; it says the length.
            limits: None for none.
            **others: As of `DesignProblem`, without the length.

        >>> LimitedProblem.for_material("Ecoflex 00-30", 4).problem.length
        0.063
        """
        layout = layout_of(chambers)
        rubber = material(name)
        problem = DesignProblem(
            young_modulus=rubber.young_modulus,
            fractional_power=rubber.fractional_power,
            length=layout.length,
            **others,  # type: ignore[arg-type]
        )
        return cls(problem, layout, density_of(name), limits or Limits())

    def within(self, **limits: float) -> "LimitedProblem":
        """Return the same problem with some limits changed."""
        return replace(self, limits=replace(self.limits, **limits))


def laws(
    section: Section,
    layout: Layout,
    pressure: Number,
    young_modulus: Number,
    fractional_power: Number,
    density: Number,
) -> dict[str, Number]:
    """Return what a section does, weighs and takes, by name; floats, arrays or symbols.

    Returns:
        torque [N m], angle [rad], stiffness (of Eq. (3.21)), mass [kg], envelope [m^3], air [m^3],
        up and aside: the pressure at which it buckles that way, over that of the problem.
    """
    finger = Finger(section, layout.length, young_modulus, fractional_power)
    up, aside = buckling_pressures(finger)
    return {
        "torque": torque(section, pressure),
        "angle": bending_angle(finger, pressure),
        "stiffness": stiffness_product(section, young_modulus, fractional_power),
        "mass": finger_mass(section, layout, density),
        "envelope": envelope(section, layout),
        "air": air_volume(section, layout),
        "up": up / pressure,
        "aside": aside / pressure,
    }


def measures(limited: LimitedProblem, section: Section) -> dict[str, Number]:
    """Return the `laws` of a section, and its objective; floats or arrays."""
    problem = limited.problem
    found = laws(
        section,
        limited.layout,
        problem.pressure,
        problem.young_modulus,
        problem.fractional_power,
        limited.density,
    )
    scaled = found["torque"] / problem.torque_scale, found["angle"] / problem.angle_scale
    return {"objective": combine(problem.combined, *scaled), **found}


def ranges(limited: LimitedProblem) -> Mapping[str, tuple[float, float]]:
    """Return between what each measure of a feasible section lies; what has no limit is left out.

    >>> dict(ranges(LimitedProblem(limits=Limits(mass=0.03))))
    {'mass': (0.0, 0.03)}
    """
    limits = limited.limits
    all_of_them = {
        "torque": (limits.torque, inf),
        "angle": (limits.angle, inf),
        "stiffness": limited.problem.product_range,
        "mass": (0.0, limits.mass),
        "envelope": (0.0, limits.envelope),
        "air": (0.0, limits.air),
        "up": (limits.buckling, inf),
        "aside": (limits.buckling, inf),
    }
    return {name: ends for name, ends in all_of_them.items() if ends != (0.0, inf)}
