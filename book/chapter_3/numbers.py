"""Recomputation of the numbers printed in Chapter 3."""

from math import pi

import numpy as np
from scipy.optimize import brentq

from book.chapter_3.stepped import identified_row
from book.chapter_3.torque_and_bending import LENGTH
from book.chapter_4.identified_model import identified_model
from book.companion.verdict import simulated
from softgrip.actuator.bending import Finger, free_bending
from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import Bounds, DesignProblem, objective
from softgrip.actuator.frequency import natural_frequency, rubber_mass
from softgrip.actuator.printed import FREQUENCY_MASS, section, table_3_1, table_3_2, table_3_3
from softgrip.actuator.section import Section, chamber_area, torque
from softgrip.control.lqr import FINGER, Weights, linear_settling_time
from softgrip.control.lqr import step_response as lqr_response
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, step_response
from softgrip.logs.steps import judge_step_log
from softgrip.materials.table import material
from softgrip.provenance import data_file
from softgrip.units import DEG, MM, MPa

TORQUE_SCALE, ANGLE_SCALE = 0.4, 1.4 * pi
G = 9.80665
DENSITY = {"Design 1(E1)": 1080.0, "Design 2(E1)": 1080.0, "Design 3(E2)": 1060.0}
"""Of the cured rubber, kg/m^3, from the supplier's data sheets (the dissertation has none)."""
FULL_ANGLE = {"Design 1(E1)": 206 * DEG, "Design 2(E1)": 201 * DEG, "Design 3(E2)": 232 * DEG}
"""Angles at 0.15 MPa that Section 3.4 prints."""
LARGEST_TORQUE = {"Design 1(E1)": 0.359, "Design 3(E2)": 0.15}
"""Torques of Section 3.4: at 0.25 MPa, and the plateau of Design 3, N m."""


def section_torque(pressure: float, wall_pulls: bool = False) -> float:
    """Return the torque of Design 1, N m, at a pressure in MPa.

    As Eq. (3.4) is printed, the moments of chamber and wall are added; if the wall pulls, the
    second is subtracted.
    """
    found = section("Opt. parameters")
    subtracted = float(torque(found, pressure * MPa))
    chamber = pressure * MPa * chamber_area(found) * (found.top - found.wall) / 2
    return subtracted if wall_pulls else 2 * chamber - subtracted


def bending(pressure: float, power: float) -> float:
    """Return the angle of Design 1 by Eq. (3.10), deg, at a pressure in MPa."""
    finger = Finger(section("Opt. parameters"), fractional_power=power)
    return float(free_bending(finger, pressure * MPa)) / DEG


def objective_sum(name: str, power: float) -> float:
    """Return the sum of Eq. (3.20) at 0.15 MPa for a section of Table 3.1."""
    return float(objective(DesignProblem(fractional_power=power), section(name)))


def sum_of_measured(design: str) -> float:
    """Return the sum of Eq. (3.20) from the printed torque and angle, torque linear in pressure.

    Design 3's torque is its plateau, more than which it does not reach at any pressure.
    """
    share = 0.15 / 0.25 if design != "Design 3(E2)" else 1.0
    return LARGEST_TORQUE[design] * share / TORQUE_SCALE + FULL_ANGLE[design] / ANGLE_SCALE


def optimum(
    name: str,
    exchanged: bool = False,
    bottom_limit: float = 24.0,
    top_limit: float = 5.0,
    power: float = 1.045,
    pressure: float = 0.15,
) -> float:
    """Return a dimension of the best section of Eq. (3.17), mm, proved to be the best.

    As Section 3.3 prints the ranges, a lies in 2 to 5 mm and b in 14 to 24 mm; exchanged, the
    other way about. Limits are the upper ones, mm; the pressure is in MPa.
    """
    low = {"top": 14 * MM, "bottom": 2 * MM} if exchanged else {"top": 2 * MM, "bottom": 14 * MM}
    bounds = Bounds(top=(low["top"], top_limit * MM), bottom=(low["bottom"], bottom_limit * MM))
    problem = DesignProblem(pressure=pressure * MPa, fractional_power=power, bounds=bounds)
    return float(getattr(certified_design(problem).design.section, name)) / MM


def banded_optimum(
    row: str, name: str, power: float, mass: float, bottom_limit: float = 5.0
) -> float:
    """Return a dimension of the best section of Eq. (3.20), mm, for a row of Table 3.2, 1 to 4.

    The range of a ends at 20 mm, as Section 3.5 says; `mass` is M_1 = M_2, kg.
    """
    problem = table_3_2()[int(row) - 1].problem(
        fractional_power=power, mass=mass, bottom_limit=bottom_limit * MM
    )
    return float(getattr(certified_design(problem).design.section, name)) / MM


@simulated
def stepped_frequency(row: str) -> float:
    """Return what second-order identification says of simulated steps to 60 deg, rad/s."""
    return identified_row(int(row)).natural_frequency.value


def modulus(design: str) -> float:
    """Return E of the rubber by Table 5.1, MPa."""
    rubber = "Dragon Skin FX Pro" if design == "Design 3(E2)" else "Dragon Skin 20"
    return material(rubber).young_modulus / MPa


def finger_length() -> float:
    """Return the length of Section 3.4, m."""
    return LENGTH


def rubber_weight(design: str) -> float:
    """Return the weight of the rubber over the length, N, end caps and partitions not counted."""
    return G * float(rubber_mass(table_3_3()[design].section, LENGTH, DENSITY[design]))


def estimated_frequency(
    design: str,
    power: float = 1.0,
    as_printed: bool = True,
) -> float:
    """Return omega_n of Eq. (3.16), rad/s, from a row of Table 3.3.

    As printed, M is a weight in newtons and L is 0.94 m; else M is the same number in kilograms
    and L is 94 mm.
    """
    row = table_3_3()[design]
    mass, length = (row.weight / G, row.length) if as_printed else (row.weight, LENGTH)
    return float(natural_frequency(Finger(row.section, length, row.young_modulus, power), mass))


def frequency_error(design: str) -> float:
    """Return how far the printed estimate lies from the printed measurement, % of the latter."""
    row = table_3_3()[design]
    return 100 * abs(row.estimated / row.measured - 1)


def extreme_error(which: str) -> float:
    """Return the least or the largest error of Table 3.3, %."""
    errors = [frequency_error(design) for design in table_3_3()]
    return min(errors) if which == "least" else max(errors)


def pole(part: str, frequency: float = 2.86, damping_ratio: float = 0.7) -> float:
    """Return the real or the imaginary part of the upper pole, rad/s."""
    rate = SecondOrder(frequency, damping_ratio).rates[0]
    return float(-rate.real if part == "real" else abs(rate.imag))


def slowest_settling(frequency: float = 2.0, damping_ratio: float = 0.7) -> float:
    """Return the 2 % settling time of a step at the lower end of the frequencies studied, s."""
    time = np.linspace(0, 10, 20001)
    return float(settling_time(time, step_response(time, frequency, damping_ratio), final=1.0))


def second_mode_ratio() -> float:
    """Return the second natural frequency of a uniform cantilever over its first."""
    first, second = (
        brentq(lambda x: np.cos(x) + 1 / np.cosh(x), low, high) for low, high in ((1, 3), (4, 6))
    )
    return float((second / first) ** 2)


def overall(name: str) -> float:
    """Return height or width of the optimum of Table 3.1, mm."""
    return float(getattr(section("Opt. parameters"), name)) / MM


def prototypes() -> float:
    """Count the distinct fingers of Tables 3.2 and 3.3: sections, and the softer material."""
    first: list[tuple[Section, float]] = [(row.section, 0.34) for row in table_3_2()]
    more = [(row.section, row.young_modulus / MPa) for row in table_3_3().values()]
    return float(len({*first, *more}))


def variances() -> float:
    """Count the sections of Table 3.1 beside the optimum."""
    return float(len(table_3_1()) - 1)


def frequency_at(top: float, bottom: float, power: float, mass: float = FREQUENCY_MASS) -> float:
    """Return omega_n of Eq. (3.16), rad/s, for a and b in mm, the rest as in the optimum."""
    best = section("Opt. parameters")
    changed = Section(top * MM, bottom * MM, best.width, best.wall)
    return float(natural_frequency(Finger(changed, fractional_power=power), mass))


@simulated
def identified_damping() -> float:
    """Return the damping ratio that seven logged steps to 60 deg give."""
    return identified_model().finger.damping_ratio


def lqr_settling(band: float = 0.02, p: float = 100.0, q2: float = 0.3) -> float:
    """Return the settling time of the linear loop of Eq. (3.28)-(3.30), s."""
    return linear_settling_time(FINGER, Weights(p, (1.0, q2, 0.0)), band)


def lqr_error() -> float:
    """Return the steady-state error of the linear loop, percent of the step."""
    return 100 * abs(1.0 - float(lqr_response(FINGER, Weights())[1][-1]))


@simulated
def lqr_settling_on_rig(design: str, criterion: str = "settled_5_deg") -> float:
    """Return the settling time of a regulator on the simulated rig, a step to 60 deg, s."""
    path = data_file(f"simulated/lqr-{design}.csv").path
    return float(getattr(judge_step_log(path), criterion))
