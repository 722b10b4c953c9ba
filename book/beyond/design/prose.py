"""Computed numbers in the prose of the page *Design yours*."""

from collections import Counter
from collections.abc import Callable

import numpy as np

from book.beyond.design.explorer import yours
from book.beyond.design.lighter import CASES, KEPT, RUBBER, saved
from book.beyond.design.pump import RISE, pump_for
from book.beyond.design.tables import SHOWN, chosen_points, percent
from book.beyond.design.tasks import (
    FIRST,
    HIGH_TOP,
    SOFTEST,
    both_bear,
    highest,
    softest_bears,
    split_mass,
)
from softgrip.actuator import front
from softgrip.actuator.bending import Finger
from softgrip.actuator.buckling import buckling_pressure
from softgrip.actuator.design import SCRIPT_MASS
from softgrip.actuator.front import Question, undominated
from softgrip.actuator.limits import DRAGON_SKIN_20
from softgrip.actuator.limits_certificate import MASS_TOLERANCE
from softgrip.actuator.mould import BED, LEAST_CAST, LEAST_PRINTED
from softgrip.actuator.printed import table_3_1
from softgrip.actuator.size import Layout, air_volume, envelope, finger_mass
from softgrip.materials.draws import DRAWS, draws
from softgrip.materials.facts import facts
from softgrip.materials.table import material, table_5_1
from softgrip.units import DEG, ML, MM, MPa


def _points() -> list[front.Point]:
    return list(front.KEPT.read())


def _feasible() -> list[front.Point]:
    return [one for one in _points() if one.answer.feasible]


def _saved(case: str) -> str:
    return percent(saved(case)[0])


def _between(case: str) -> str:
    """Return the 95 % interval over the draws."""
    low, high = np.percentile(saved(case)[1], [2.5, 97.5])
    return f"{percent(low)} to {percent(high)}"


def _torque(chambers: int) -> float:
    """Return the torque of the printed rubber at the middle pressure and the larger mass, N m."""
    asked = Question(RUBBER, chambers, front.PRESSURES[1], max(front.MASSES))
    return next(one.answer.torque for one in _points() if one.question == asked)


def _best_of(chambers: int) -> int:
    rows = _points()
    best = [p.question.chambers for p, good in zip(rows, undominated(rows), strict=True) if good]
    return Counter(best)[chambers]


def _feasible_of(chambers: int) -> int:
    return sum(one.question.chambers == chambers for one in _feasible())


def _buckles(name: str) -> float:
    """Return from which pressure Design 1 of a rubber buckles, MPa."""
    rubber = material(name)
    made = Finger(
        table_3_1()["Opt. parameters"], 94 * MM, rubber.young_modulus, rubber.fractional_power
    )
    return float(buckling_pressure(made)) / MPa


def _part_of_print() -> float:
    """Return the least share of the printed E that a test has."""
    return min(
        float(np.median(draws()[name][:, 0])) / rubber.young_modulus
        for name, rubber in table_5_1().items()
    )


def _farthest() -> str:
    """Return the rubber whose test is farthest below the printed E."""
    share = {
        name: float(np.median(draws()[name][:, 0])) / rubber.young_modulus
        for name, rubber in table_5_1().items()
    }
    return min(share, key=lambda name: share[name])


def _band() -> float:
    """Return how wide the band of the angle is where the explorer starts, % to each side."""
    found = yours(**FIRST)
    return float(100 * (found["high"][-1] / found["tested"][-1] - 1))


def _pumped() -> list[bool]:
    return [pump_for(point).feasible for point in _feasible()]


def _design_1() -> tuple[float, float, float]:
    """Return mass, kg, box and air, m^3, of Design 1."""
    section = table_3_1()["Opt. parameters"]
    layout = Layout()
    mass = finger_mass(section, layout, DRAGON_SKIN_20)
    return float(mass), float(envelope(section, layout)), float(air_volume(section, layout))


WORDS: dict[str, Callable[[], str]] = {
    "points": lambda: f"{len(_points())}",
    "none": lambda: f"{len(_points()) - len(_feasible())}",
    "boxes": lambda: f"{sum(one.answer.boxes for one in _points()):,}",
    "quarter": lambda: f"{front.LEAST_ANGLE / DEG:.0f}",
    "script_mass": lambda: f"{SCRIPT_MASS:g}",
    "mass_1": lambda: f"{1e3 * _design_1()[0]:.1f}",
    "box_1": lambda: f"{_design_1()[1] / ML:.1f}",
    "air_1": lambda: f"{_design_1()[2] / ML:.1f}",
    "script_saved": lambda: _saved("limits of the script"),
    "sum_saved": lambda: _saved("the same sum"),
    "sum_between": lambda: _between("the same sum"),
    "all_saved": lambda: _saved("the same torque, angle and frequency"),
    "all_between": lambda: _between("the same torque, angle and frequency"),
    "tenth_saved": lambda: _saved("nine tenths of torque and angle"),
    "tenth_between": lambda: _between("nine tenths of torque and angle"),
    "cases": lambda: f"{len(KEPT.read())}",
    "kinds": lambda: f"{len(CASES)}",
    "thousandth": lambda: f"{100 * MASS_TOLERANCE:g}",
    "four_pushes": lambda: f"{_torque(4):.3f}",
    "six_pushes": lambda: f"{_torque(6):.3f}",
    "four": lambda: f"{front.CHAMBERS[0]}",
    "six": lambda: f"{front.CHAMBERS[1]}",
    "eight": lambda: f"{front.CHAMBERS[2]}",
    "both_bears": lambda: f"{both_bear():.0f}",
    "feasible_four": lambda: f"{_feasible_of(4)}",
    "feasible_six": lambda: f"{_feasible_of(6)}",
    "feasible_eight": lambda: f"{_feasible_of(8)}",
    "best_four": lambda: f"{_best_of(4)}",
    "best_six": lambda: f"{_best_of(6)}",
    "best_eight": lambda: f"{_best_of(8)}",
    "middle_pressure": lambda: f"{front.PRESSURES[1] / 1e3:g}",
    "largest_angle": lambda: f"{max(one.answer.angle for one in _feasible()) / DEG:,.0f}",
    "buckles_1": lambda: f"{_buckles(RUBBER):.2f}",
    "buckles_3": lambda: f"{_buckles('Dragon Skin FX Pro'):.2f}",
    "draws": lambda: f"{DRAWS}",
    "part_of_print": lambda: f"{100 * _part_of_print():.0f}",
    "farthest": _farthest,
    "farthest_facts": lambda: f"{facts()[_farthest()].hundred_percent_modulus / MPa:.3f}",
    "band": lambda: f"{_band():.1f}",
    "rise": lambda: f"{RISE:g}",
    "pumped": lambda: f"{sum(_pumped())}",
    "not_pumped": lambda: f"{len(_pumped()) - sum(_pumped())}",
    "shown_pressure": lambda: f"{SHOWN['pressure'] / 1e3:g}",
    "shown_mass": lambda: f"{1e3 * SHOWN['largest_mass']:g}",
    "shown_none": lambda: f"{sum(not one.answer.feasible for one in chosen_points())}",
    "bed": lambda: f"{BED:g}",
    "least_printed": lambda: f"{LEAST_PRINTED:g}",
    "least_cast": lambda: f"{LEAST_CAST:g}",
    "start_top": lambda: f"{FIRST['top']:g}",
    "start_mass": lambda: f"{FIRST['mass']:g}",
    "start_pressure": lambda: f"{FIRST['pressure']:g}",
    "highest": lambda: f"{HIGH_TOP:g}",
    "highest_torque": lambda: f"{highest()['pushes']:.3f}",
    "start_torque": lambda: f"{yours(**FIRST)['pushes']:.3f}",
    "start_width": lambda: f"{yours(**FIRST)['width']:.1f}",
    "highest_width": lambda: f"{highest()['width']:.1f}",
    "start_bears": lambda: f"{yours(**FIRST)['bears']:.0f}",
    "highest_bears": lambda: f"{highest()['bears']:.0f}",
    "softest_rubber": lambda: SOFTEST,
    "softest_bears": lambda: f"{softest_bears():.0f}",
    "upper_mass": lambda: f"{split_mass()[0]:.1f}",
    "lower_mass": lambda: f"{split_mass()[1]:.1f}",
}
