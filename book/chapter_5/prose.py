"""Computed numbers in the prose of Chapter 5."""

from collections.abc import Iterable
from itertools import chain
from math import ceil

import numpy as np

from book.chapter_5 import figures_dynamics as dynamics
from book.chapter_5 import tasks
from book.chapter_5.figures_materials import BEST, meets
from book.chapter_5.logs import RUNS
from book.chapter_5.matched_model import (
    Setting,
    largest_share_at_rest,
    linear_errors,
    resting_angle,
    settings,
)
from book.chapter_5.numbers import (
    BOUND,
    fitted_power,
    hundred_percent_modulus,
    linear_limit,
    printed_rms,
)
from book.chapter_5.step_models import ANGLES, FINGERS, Kind, identified_at, kept_test
from book.chapter_5.step_models import step_test_error as error
from book.chapter_5.step_protocols import SMALL, kept_errors, stated_stiffness
from book.chapter_5.step_sweep import ANGLES as STEPS
from book.chapter_5.step_sweep import KEPT
from book.companion.choices import choice
from book.companion.claims import claim_of, printed
from book.companion.verdict import recomputed
from softgrip.actuator.cantilever import angle_limit
from softgrip.dynamics.consistency import POWER
from softgrip.dynamics.identify import CONFIDENCE
from softgrip.materials.facts import facts
from softgrip.materials.fitting import comes_out, fractional_power, grid
from softgrip.materials.leave_out import RIVALS, leave_k_out
from softgrip.materials.table import table_5_1
from softgrip.simulator.fitted_rigs import design_1
from softgrip.units import DEG, MPa

EARLY = ("Dragon Skin 20", "Dragon Skin 30", "SORTA-Clear 40")
"""Materials whose printed n comes out where the fit stops at small strains."""
LOW = ("Ecoflex 00-10", "Dragon Skin FX Pro")
"""Materials whose tests give the smallest parts of the printed E."""
LEAST, MOST = min(dynamics.POWERS), max(dynamics.POWERS)


def _span(values: Iterable[float], form: str = ".0f") -> str:
    found = [*values]
    return f"{min(found):{form}} to {max(found):{form}}"


def _pair(values: Iterable[float], form: str = ".0f") -> str:
    first, second = (f"{value:{form}}" for value in values)
    return first if first == second else f"{first} and {second}"


def _missed() -> list[float]:
    """Return by how much the powers that do not come out are off, %, as the ledger fits them."""
    fitted = {x: fitted_power(x, BEST.longest_strain, two_decimals=True) for x in table_5_1()}
    pairs = [(n, table_5_1()[name].fractional_power) for name, n in fitted.items()]
    return [100 * abs(n / true - 1) for n, true in pairs if not comes_out(n, true)]


def _more() -> int:
    """Count the materials whose true stress at a strain of one is above E and its rounding."""
    moduli = {name: printed(claim_of(5, "table-5.1-e-{key}", name).id) for name in table_5_1()}
    return sum(hundred_percent_modulus(x, "true") > E + E.half for x, E in moduli.items())


def _errors() -> list[float]:
    """Return the errors of n by Eq. (5.8) when each material is left out, %."""
    return [100 * abs(one.error / one.printed) for one in leave_k_out(1).predictions]


def _off() -> list[float]:
    """Return by how much the eight errors are off the printed ones, %, the farthest first."""
    pairs = ((error(*_case(case)), own) for case, own in printed_rms().items())
    return sorted((100 * abs(found / own - 1) for found, own in pairs), reverse=True)


def _case(case: tuple[str, int, Kind]) -> tuple[str, Kind, int]:
    design, angle, kind = case
    return design, kind, angle


def _unmatched(design: str) -> float:
    """Return the error of the linear model with its gain of the first test at the second, deg."""
    return kept_errors()["identified at 60 deg"][design, ANGLES[1], "linear"]


def _again_at(angle: int) -> list[float]:
    return [point.ludwick_again for point in KEPT.read() if point.angle == angle]


def _end(design: str, kind: Kind) -> float:
    """Return where a model of the second test ends, less the mean of the runs, deg."""
    test = kept_test(design, ANGLES[1])
    fitted = identified_at(design, kind)
    return float(fitted.response(test.time, test.pressure)[-1] - test.angle[-1]) / DEG


def _largest(design: str) -> float:
    test = kept_test(design, ANGLES[1])
    return float(identified_at(design, "linear").response(test.time, test.pressure).max()) / DEG


def _again() -> int:
    """Return the step, deg, up to which the linear model identified anew keeps `BOUND`."""
    # NaN, where a step tells no linear model, does not keep it.
    beyond = min(point.angle for point in KEPT.read() if not point.linear_again <= BOUND)
    return max(step for step in STEPS if step < beyond)


def _limits(powers: Iterable[float], part: float) -> list[float]:
    return [angle_limit(part, n) / DEG for n in powers]


def _stiffer(kind: Kind) -> list[float]:
    """Return how many times as stiff as identified the fingers are by the text."""
    return [stated_stiffness(x, kind) / identified_at(x, kind).stiffness.value for x in FINGERS]


def _shared() -> tuple[Setting, ...]:
    """Return what both fingers may share, with the damping ratio of Section 3.4 and its ends."""
    middle, spread = (float(printed(f"3.4-damping-{x}")) for x in ("ratio", "spread"))
    return settings(ANGLES, (middle - spread, middle, middle + spread))


def _grows_in() -> int:
    """Count the settings in which the larger n of Table 5.2 has the larger error, by either row."""
    larger, smaller = FINGERS["Design 1"], FINGERS["Design 2"]
    pairs = ((larger.estimated, smaller.estimated), (larger.true, smaller.true))
    found = [linear_errors(n, _shared()) > linear_errors(m, _shared()) for n, m in pairs]
    return int(np.logical_and(*found).sum())


def _powers() -> list[tuple[str, float]]:
    return [(x, n) for x, finger in FINGERS.items() for n in (finger.estimated, finger.true)]


def _share_at_rest(design: str, power: float) -> float:
    error = printed(f"5.4-rms-{design.lower().replace(' ', '-')}--90-deg--linear")
    return largest_share_at_rest(error, *ANGLES, power)


WORDS = {
    # The ten exponents: ways to fit, strains, %.
    "ways": lambda: f"{len(grid())}",
    "strain": lambda: f"{BEST.longest_strain:g}",
    "strain_percent": lambda: f"{100 * BEST.longest_strain:.0f}",
    "come_out": lambda: f"{len(table_5_1()) - len(_missed())}",
    "missed": lambda: _span(_missed()),
    "fitted_20": lambda: f"{fractional_power('Dragon Skin 20', BEST):.3f}",
    "rounded_20": lambda: (
        f"{fitted_power('Dragon Skin 20', BEST.longest_strain, two_decimals=True):.3f}"
    ),
    "e_low": lambda: _span(
        100 * hundred_percent_modulus(x) * MPa / table_5_1()[x].young_modulus for x in LOW
    ),
    "e_more": lambda: f"{_more()}",
    "longest": lambda: f"{1 + max(one.peak_strain for one in facts().values()):.0f}",
    "meets_late": lambda: _span(meets(name)[0] for name in table_5_1() if name not in EARLY),
    "meets_early": lambda: _span(chain.from_iterable(map(meets, EARLY)), ".1f"),
    # The formula: n, and errors in %.
    "estimated_20": lambda: f"{recomputed(5, 'table-5.2-estimated-dragon-skin-20').value:.3f}",
    "estimated_fx": lambda: f"{recomputed(5, 'table-5.2-estimated-dragon-skin-fx-pro').value:.3f}",
    "least_fx": lambda: f"{recomputed(5, 'table-5.2-estimated-dragon-skin-fx-pro').low:.3f}",
    "error": lambda: f"{recomputed(5, '5.5-error-below-ten-percent').value:.1f}",
    "left_out_rms": lambda: f"{leave_k_out(1).rms_error:.2f}",
    "mean_rms": lambda: f"{leave_k_out(1, model=RIVALS['mean of the others']()).rms_error:.2f}",
    "missed_more": lambda: f"{sum(e > printed('5.5-error-below-ten-percent') for e in _errors())}",
    "worst": lambda: f"{max(_errors()):.0f}",
    # The equations: factors, and deg for parts in %.
    "power": lambda: f"{POWER}",
    "rig_power": lambda: f"{design_1().finger.fractional_power:.2f}",
    "limits": lambda: _pair(100 * part for part in dynamics.LIMITS),
    "limit": lambda: f"{100 * dynamics.LIMITS[0]:.0f}",
    "other_limit": lambda: f"{100 * dynamics.LIMITS[1]:.0f}",
    "powers": lambda: _span((LEAST, MOST), "g"),
    "most_power": lambda: f"{MOST:g}",
    "hooke_to": lambda: f"{_limits([LEAST], dynamics.LIMITS[0])[0]:.0f}",
    "hooke_to_other": lambda: f"{_limits([LEAST], dynamics.LIMITS[1])[0]:.0f}",
    "most_to": lambda: _pair(_limits([MOST], part)[0] for part in dynamics.LIMITS),
    "all_to": lambda: _span(_limits((LEAST, MOST), dynamics.LIMITS[0])),
    "all_to_other": lambda: _span(_limits((LEAST, MOST), dynamics.LIMITS[1])),
    "ludwick_stiffer": lambda: _pair(_stiffer("ludwick"), ".1f"),
    "hooke_stiffer": lambda: _pair(_stiffer("linear")),
    # The step tests: deg, and pressures as multiples.
    "first": lambda: f"{ANGLES[0]}",
    "second": lambda: f"{ANGLES[1]}",
    "small": lambda: f"{SMALL}",
    "confidence": lambda: f"{100 * CONFIDENCE:g}",
    "linear_climbs": lambda: f"{_largest('Design 1'):.0f}",
    "ludwick_ends_1": lambda: f"{ceil(abs(_end('Design 1', 'ludwick')))}",
    "ludwick_ends_2": lambda: f"{ceil(abs(_end('Design 2', 'ludwick')))}",
    "sensor_end": lambda: f"{design_1().sensors.angle_range / DEG:.0f}",
    "linear_above": lambda: f"{_end('Design 2', 'linear'):.0f}",
    "linear_misses": lambda: _pair(map(_unmatched, FINGERS)),
    "farthest": lambda: f"{_off()[0]:.0f}",
    "others_within": lambda: f"{ceil(_off()[1])}",
    "without_sensors": lambda: _pair(_again_at(ANGLES[0]), ".1f"),
    "more_pressure": lambda: f"{(ANGLES[1] / ANGLES[0]) ** POWER:.1f}",
    "linear_answers": lambda: f"{resting_angle(*ANGLES, POWER):.0f}",
    "rests": lambda: _span(resting_angle(*ANGLES, n) for _, n in _powers()),
    "share_at_rest": lambda: f"{100 * max(_share_at_rest(*one) for one in _powers()):.0f}",
    "settings": lambda: f"{len(_shared())}",
    "grows_in": lambda: f"{_grows_in()}",
    "noise": lambda: f"{design_1().sensors.angle_noise / DEG:.1f}",
    "mean_noise": lambda: f"{design_1().sensors.angle_noise / DEG / RUNS**0.5:.1f}",
    "fit_allowed": lambda: f"{recomputed(5, '5.3-average-fit-allowed').value:.1f}",
    "percent": lambda: f"{recomputed(5, '5.4-percent-design-1--90-deg--linear').value:.1f}",
    # How far a straight line goes: deg.
    "bound": lambda: f"{BOUND:g}",
    "stated_limits": lambda: "{}, {} and {}".format(*dynamics.STATED_LIMITS),
    "ranges": lambda: _pair(linear_limit(design, BOUND) for design in FINGERS),
    "fitted_bound": lambda: f"{choice('linear_bound') / DEG:.1f}",
    "fitted_ranges": lambda: _pair(map(linear_limit, FINGERS)),
    "away": lambda: f"{STEPS[1] - STEPS[0]}",
    "again": lambda: f"{_again()}",
    # Answers of the tasks: n, %, correlation, deg.
    "ends_with": lambda: f"{tasks.ending_power():.2f}",
    "at_one": lambda: f"{100 * tasks.share_at_one():.0f}",
    "power_at_least_modulus": lambda: f"{tasks.powers_by_modulus()[0]:.2f}",
    "power_at_most_modulus": lambda: f"{tasks.powers_by_modulus()[1]:.2f}",
    "factor_of_modulus": lambda: f"{tasks.modulus_factor():.2f}",
    "stiff_and_strong": lambda: f"{tasks.stiff_and_strong():.2f}",
    "window_first": lambda: _pair(tasks.window(ANGLES[0], BOUND), ".1f"),
    "window_second": lambda: _pair(tasks.window(ANGLES[1], BOUND), ".1f"),
    "window_width": lambda: f"{tasks.window_width(ANGLES[0], BOUND):.0f}",
    # Figures that the text refers to by another's number.
    "correlations_in": lambda: f"{recomputed(5, '5.2-correlations-shown-in').value:g}",
    "bending_in": lambda: f"{recomputed(5, '5.3-bending-shown-in').value:g}",
    "setup_in": lambda: f"{recomputed(5, '5.4-setup-shown-in').value:g}",
}
