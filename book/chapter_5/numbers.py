"""Recomputation of the numbers printed in Chapter 5."""

from math import inf, pi

import numpy as np

from book.chapter_5 import step_sweep
from book.chapter_5.step_models import FINGERS, Kind, identified_at, step_test_error
from book.companion.verdict import simulated
from softgrip.dynamics.consistency import agreement
from softgrip.materials.facts import facts
from softgrip.materials.fitting import Fitting, fractional_power
from softgrip.materials.powerlaw import FractionalPowerRegressor
from softgrip.materials.table import HELD_OUT, material, properties, table_5_1
from softgrip.materials.table import fractional_powers as printed_powers
from softgrip.units import DEG, MPa

TABLE_5_2 = {"Dragon Skin 20": (2.174, 2.365), "Dragon Skin FX Pro": (1.538, 1.727)}
"""True and estimated n as Table 5.2 prints them."""

PRINTED_RMS: dict[tuple[str, int, Kind], float] = {
    ("Design 1", 60, "linear"): 2.03,
    ("Design 1", 60, "ludwick"): 1.29,
    ("Design 1", 90, "linear"): 6.15,
    ("Design 1", 90, "ludwick"): 3.17,
    ("Design 2", 60, "linear"): 3.49,
    ("Design 2", 60, "ludwick"): 1.46,
    ("Design 2", 90, "linear"): 7.98,
    ("Design 2", 90, "ludwick"): 3.61,
}
"""RMS errors that Section 5.4 prints, deg, by finger, set point (deg) and model."""

LINEAR_RANGE = {"Section 3.4": 90.0, "Section 6.2": 4 * pi / 9 / DEG, "Section 7.1": 80.0}
"""Up to where other chapters call the linear model valid, deg."""


def number_of_materials(held_out: bool = False) -> int:
    """Count the materials of Table 5.1, with or without those held out."""
    return len(table_5_1()) - (0 if held_out else len(HELD_OUT))


def number_held_out() -> int:
    """Count the materials of Table 5.2."""
    return len(TABLE_5_2)


def fitted_power(name: str, longest_strain: float = inf, *, two_decimals: bool = False) -> float:
    """Fit n to the public tensile test: true stress, E held, least squares of the stress.

    With ``two_decimals`` the fitted 1/n is rounded to two decimals, as the printed column shows.
    """
    n = fractional_power(name, Fitting(longest_strain=longest_strain))
    return 1 / round(1 / n, 2) if two_decimals else n


def table_power(name: str) -> float:
    """Return n of Table 5.1, which Table 5.2 repeats as the true value."""
    return material(name).fractional_power


def estimated_power(name: str) -> float:
    """Predict n of a held-out material by Eq. (5.8), fitted to the other eight."""
    known = [m for m in table_5_1().values() if m.name not in HELD_OUT]
    model = FractionalPowerRegressor().fit(properties(known), printed_powers(known))
    return float(model.predict(properties([material(name)]))[0])


def largest_error() -> float:
    """Return the larger error of the two estimates of Table 5.2, in percent of its true value."""
    return max(100 * abs(estimated / true - 1) for true, estimated in TABLE_5_2.values())


def hundred_percent_modulus(name: str) -> float:
    """Return the stress at strain 1 in the public tensile test, in MPa."""
    return facts()[name].hundred_percent_modulus / MPa


def peak_stress(name: str) -> float:
    """Return the largest engineering stress of the public tensile test, in MPa."""
    return facts()[name].peak_stress / MPa


def agreement_ratio(name: str) -> float:
    """Return the ratio of two expressions that should be one; see `dynamics.consistency`."""
    return agreement(name).ratio


def _case(case: str) -> tuple[str, int, Kind]:
    """Read such as ``Design 1, 60 deg, Ludwick``."""
    words = {"linear": "linear", "ludwick": "Ludwick"}
    return {f"{d}, {a} deg, {words[k]}": (d, a, k) for d, a, k in PRINTED_RMS}[case]


def percent_of_set_point(case: str) -> float:
    """Return a printed RMS error in percent of its set point."""
    design, angle, kind = _case(case)
    return 100 * PRINTED_RMS[design, angle, kind] / angle


@simulated
def rms_on_rig(case: str, identified: int = 60) -> float:
    """Return the RMS error, deg, of a model on the simulated rig, identified at one test."""
    design, angle, kind = _case(case)
    return step_test_error(design, kind, angle, identified=identified)


@simulated
def average_fit() -> float:
    """Return the mean fit of Eq. (5.16) to the 60 deg tests of the simulated rig, in percent."""
    return float(np.mean([identified_at(design, "ludwick").fit_percent for design in FINGERS]))


def allowed_fit() -> float:
    """Return the largest mean fit, percent, that the four RMS errors of Eq. (5.16) leave room for.

    A record between 0 and its set point deviates from its own mean by half of that at most, in the
    root mean square; a fit is an RMS error over this deviation, taken from 100.
    """
    errors = {case: error for case, error in PRINTED_RMS.items() if case[2] == "ludwick"}
    fits = [100 * (1 - error / (angle / 2)) for (_, angle, _), error in errors.items()]
    return float(np.mean(fits))


def extreme_rms(end: str, kind: Kind) -> float:
    """Return the least ("min") or largest ("max") printed RMS error of a model, deg."""
    errors = [error for (_, _, of), error in PRINTED_RMS.items() if of == kind]
    return {"min": min, "max": max}[end](errors)


@simulated
def linear_limit(design: str, bound: float = 3.0) -> float:
    """Return up to which step one linear model stays within a bound on the simulated rig, deg."""
    points = [point for point in step_sweep.KEPT.read() if point.design == design]
    errors = [point.linear_range for point in points]
    return float(np.interp(bound, errors, [point.angle for point in points]))


def other_linear_range(place: str) -> float:
    """Return up to where another section calls the linear model valid, deg."""
    return LINEAR_RANGE[place]
