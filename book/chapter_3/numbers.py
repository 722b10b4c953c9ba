"""Recomputation of the numbers printed in Chapter 3."""

from collections.abc import Mapping, Sequence
from math import hypot, nan, pi, prod, tanh

import numpy as np
from scipy.optimize import brentq

from book.chapter_3.stepped import identified_row
from book.chapter_4.identified_model import identified_model
from book.companion.choices import choice
from book.companion.relations import ratio
from book.companion.verdict import simulated
from softgrip.actuator.bending import Finger
from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import (
    SCRIPT_MASS,
    SCRIPT_POWER,
    Bounds,
    Combined,
    DesignProblem,
    FrequencyBand,
    InfeasibleDesignError,
    objective,
)
from softgrip.actuator.frequency import (
    natural_frequency,
    rubber_mass,
    stiffness_product,
    stiffness_product_for,
)
from softgrip.actuator.printed import table_3_2, table_3_3
from softgrip.actuator.section import Section, chamber_area, torque
from softgrip.arrays import Number, largest_of, least_of
from softgrip.control.lqr import Weights, linear_settling_time
from softgrip.control.lqr import step_response as lqr_response
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, step_response, upper_pole
from softgrip.logs.steps import judge_step_log
from softgrip.provenance import data_file
from softgrip.units import DEG, MM, MPa

G = 9.80665


def highest_power(power: float) -> float:
    """Return the highest power of the pressure in Eq. (3.10), T being proportional to it."""
    return 1 + 1 / power


def _section(sizes: Mapping[str, float]) -> Section:
    return Section(**{name: size * MM for name, size in sizes.items()})


def section_torque(
    pressure: float, section: Mapping[str, float], wall_pulls: bool = False
) -> Number:
    """Return the torque of a section, N m.

    As Eq. (3.4) is printed, the moments of chamber and wall are added; if the wall pulls, the
    second is subtracted.

    Args:
        pressure: MPa.
        section: Its dimensions by name, mm.
        wall_pulls: How the moments are put together.
    """
    found = _section(section)
    subtracted = torque(found, pressure * MPa)
    chamber = pressure * MPa * chamber_area(found) * (found.top - found.wall) / 2
    return subtracted if wall_pulls else 2 * chamber - subtracted


def objective_sum(
    section: Mapping[str, float],
    power: float,
    pressure: float,
    modulus: float,
    torque_scale: float,
    angle_scale: float,
) -> Number:
    """Return the sum of Eq. (3.20) for a section, mm by name; MPa, N m, and parts of pi."""
    problem = DesignProblem(
        pressure * MPa,
        modulus * MPa,
        power,
        torque_scale=torque_scale,
        angle_scale=angle_scale * pi,
    )
    return objective(problem, _section(section))


def angle_left(
    total: float, torque: float, at: float, of: float, torque_scale: float, angle_scale: float
) -> float:
    """Return what a sum of Eq. (3.20) leaves for the angle, deg.

    Args:
        total: The sum.
        torque: At the pressure `of`, N m; Eq. (3.4) is proportional to pressure.
        at: Pressure of the sum, in the unit of `of`.
        torque_scale, angle_scale: N m, and a part of pi.
    """
    return (total - torque * at / of / torque_scale) * angle_scale * pi / DEG


def sum_of_measured(
    torque: float,
    angle: float,
    torque_scale: float,
    angle_scale: float,
    share: float = 1.0,
    weaker: Mapping[str, float] | None = None,
) -> Number:
    """Return the sum of Eq. (3.20) from a measured torque, N m, and an angle, deg.

    Args:
        torque, angle: As printed.
        torque_scale, angle_scale: N m, and a part of pi.
        share: Of the torque that there is at the pressure of the angle.
        weaker: Arguments of `width_torque_ratio`, where the torque of a wider finger is printed.
    """
    own = torque * share * (width_torque_ratio(**weaker) if weaker else 1.0)
    return own / torque_scale + angle * DEG / (angle_scale * pi)


def width_torque_ratio(
    width: float, of_width: float, top: float, bottom: float, wall: float
) -> Number:
    """Return the torque of a section over that of one of another width, by Eq. (3.4); mm."""
    own, other = (
        _section({"top": top, "bottom": bottom, "width": w, "wall": wall})
        for w in (width, of_width)
    )
    return torque(own, 1.0) / torque(other, 1.0)


def height_limit(
    end: str, stated: float, tops: Sequence[float], bottoms: Sequence[float]
) -> Number:
    """Return the least or largest height that a + b of some sections needs, in their unit.

    >>> height_limit("largest", stated=25, tops=[20, 22], bottoms=[4, 4])
    26
    """
    heights = [stated, *(top + bottom for top, bottom in zip(tops, bottoms, strict=True))]
    return least_of(heights) if end == "least" else largest_of(heights)


def surpassing(own: Sequence[float], others: Sequence[Sequence[float]]) -> Number:
    """Count the designs that have more of everything than one has.

    Args:
        own: Metrics of which more is better.
        others: The same of other designs.

    >>> surpassing([2.0, 3.0], others=[[2.5, 2.0], [2.5, 3.5]])
    1
    """
    return sum(prod(b > a for a, b in zip(own, other, strict=True)) for other in others)


def off_integers(sizes: Sequence[float]) -> Number:
    """Return the largest distance of a number from the nearest integer.

    >>> float(off_integers([4.0, 1.75]))
    0.25
    """
    return largest_of(abs(size - np.floor(size + 0.5)) for size in sizes)


def optimum(
    name: str,
    band: Sequence[float] | None = None,
    power: float = SCRIPT_POWER,
    mass: float = SCRIPT_MASS,
    combined: Combined = "product",
    bottom_limit: float = 4.0,
    height_limit: float = 24.0,
) -> float:
    """Return a dimension of the best section, mm, proved to be the best; by default his script's.

    Args:
        name: Of the dimension.
        band: That the frequency keeps, as in Table 3.2, rad/s; none for Table 3.1.
        power: n.
        mass: M_1 = M_2, kg.
        combined: Product or sum of torque and angle, at 0.15 MPa.
        bottom_limit: Largest b, mm.
        height_limit: Largest a + b, mm.

    Returns:
        float: NaN if no section keeps the band.
    """
    bounds = Bounds(bottom=(2 * MM, bottom_limit * MM), height=(18 * MM, height_limit * MM))
    kept = FrequencyBand(band[0], band[1], mass, mass) if band else None
    problem = DesignProblem(fractional_power=power, bounds=bounds, band=kept, combined=combined)
    try:
        return float(getattr(certified_design(problem).design.section, name)) / MM
    except InfeasibleDesignError:
        return nan


@simulated
def stepped_frequency(row: str) -> float:
    """Return what second-order identification says of simulated steps, rad/s.

    `row` is "row 1" to "row 4" of Table 3.2: a bare number would be read as printed.
    """
    return identified_row(int(row.removeprefix("row "))).natural_frequency.value


def rubber_weight(
    section: Mapping[str, float], length: float, density: float, filled: float = 0.0
) -> Number:
    """Return the weight of the rubber of a finger, N, with a part of the chamber filled.

    Args:
        section: Its dimensions by name, mm.
        length: mm.
        density: kg/m^3.
        filled: Part of the chamber.
    """
    found = _section(section)
    inside = filled * density * length * MM * chamber_area(found)
    return G * (rubber_mass(found, length * MM, density) + inside)


def frequency_at(
    top: float,
    bottom: float,
    width: float,
    power: float,
    mass: float,
    modulus: float,
    length: float,
    newtons: bool = False,
) -> Number:
    """Return omega_n of Eq. (3.16), rad/s.

    Args:
        top, bottom, width: a, b and w, mm; the wall does not enter.
        power: n.
        mass: M, kg, or N if `newtons`.
        modulus: E, MPa.
        length: L, mm.
        newtons: Whether M is a weight.
    """
    sizes = _section({"top": top, "bottom": bottom, "width": width, "wall": 0.0})
    finger = Finger(sizes, length * MM, modulus * MPa, power)
    return natural_frequency(finger, mass / G if newtons else mass)


def product_frequency(
    section: Mapping[str, float],
    modulus: float,
    length: float,
    power: float = SCRIPT_POWER,
    mass: float = SCRIPT_MASS,
) -> Number:
    """Return the omega_n to which Eq. (3.19) gives a section's ``E w (a + b)**(n + 2)``, rad/s.

    Args:
        section: Its dimensions by name, mm.
        modulus: E, MPa.
        length: L, mm.
        power: n.
        mass: M, kg.
    """
    made = stiffness_product(_section(section), modulus * MPa, power)
    return (made / stiffness_product_for(1.0, mass, power, length * MM)) ** 0.5


def scaled_frequency(
    frequency: float,
    mass: tuple[float, float],
    width: tuple[float, float] = (1.0, 1.0),
    modulus: tuple[float, float] = (1.0, 1.0),
) -> Number:
    """Return omega_n of Eq. (3.16) from that of a finger of the same height, length and n.

    Args:
        frequency: Of the other finger.
        mass, width, modulus: M, w and E of this one and of the other.
    """
    stiffer, heavier = modulus[0] / modulus[1] * width[0] / width[1], mass[0] / mass[1]
    return frequency * (stiffer / heavier) ** 0.5


def pole(part: str, frequency: Number, damping_ratio: Number) -> Number:
    """Return the real or the imaginary part of the upper pole, rad/s."""
    return upper_pole(frequency, damping_ratio)[("real", "imaginary").index(part)]


def pole_frequency(real: float, imaginary: float) -> float:
    """Return the natural frequency of a pair of poles, in their unit."""
    return hypot(real, imaginary)


def pole_damping(real: float, imaginary: float) -> float:
    """Return the damping ratio of a pair of poles."""
    return ratio(-real, hypot(real, imaginary))


def step_settling(frequency: float, damping_ratio: float, band: float = 0.02) -> float:
    """Return the settling time of a step of the finger alone, s, within a share of the step."""
    time = np.linspace(0, 10, 20001)
    response = step_response(time, frequency, damping_ratio)
    return float(settling_time(time, response, final=1.0, band=band))


def second_mode_ratio(tip_mass: float) -> float:
    """Return the second natural frequency of a uniform cantilever over its first.

    Args:
        tip_mass: At its tip, as a part of the beam's own.
    """

    def condition(x: float) -> float:
        tip = tip_mass * x * (np.cos(x) * tanh(x) - np.sin(x))
        return float(np.cos(x) + 1 / np.cosh(x) + tip)

    first, second = brentq(condition, 0.1, 1.9), brentq(condition, 3.9, 4.7)
    return float((second / first) ** 2)


def scale_load(torque: float, length: float) -> float:
    """Return what a scale at the tip shows under a torque (N m), Eq. (3.24), kg; length in mm."""
    return torque / (length * MM) / G


def prototypes() -> float:
    """Count the distinct fingers of Tables 3.2 and 3.3: sections, and the softer material.

    A count of prints: what they were rounded from does not matter to it.
    """
    made = [(row.section, row.young_modulus) for row in table_3_3().values()]
    return float(len({*made, *((row.section, made[0][1]) for row in table_3_2())}))


@simulated
def identified_damping() -> float:
    """Return the damping ratio that seven logged steps to 60 deg give."""
    return identified_model().finger.damping_ratio


def lqr_settling(
    p: float,
    q: tuple[float, float, float],
    R: float,
    frequency: float,
    damping_ratio: float,
    band: float = 0.02,
) -> float:
    """Return the settling time of the linear loop of Eq. (3.28)-(3.30), s.

    Args:
        p, q, R: Weights of Eq. (3.29), of the three states and of the command.
        frequency: rad/s.
        damping_ratio: Dimensionless.
        band: Share of the step.
    """
    finger = SecondOrder(frequency, damping_ratio)
    return linear_settling_time(finger, Weights(p, q, R), band)


def lqr_error(
    p: float, q: tuple[float, float, float], R: float, frequency: float, damping_ratio: float
) -> float:
    """Return the steady-state error of that loop, percent of the step; inputs as there."""
    _, response = lqr_response(SecondOrder(frequency, damping_ratio), Weights(p, q, R))
    return 100 * abs(1.0 - float(response[-1]))


@simulated
def lqr_settling_on_rig(design: str, criterion: str = "settled") -> float:
    """Return the settling time of a regulator on the simulated rig, s; step and band are fitted."""
    path = data_file(f"simulated/lqr-{design}.csv").path
    return float(getattr(judge_step_log(path, band=choice("lqr_band")), criterion))
