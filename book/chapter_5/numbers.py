"""Recomputation of the numbers printed in Chapter 5."""

from collections.abc import Sequence
from itertools import product
from math import inf

import numpy as np

from book.chapter_5 import step_sweep
from book.chapter_5.step_models import ANGLES, FINGERS, KINDS, Kind, identified_at, step_test_error
from book.companion.choices import choice
from book.companion.claims import claim_of
from book.companion.relations import mean
from book.companion.verdict import simulated
from softgrip.dynamics.consistency import agreement
from softgrip.materials import ludwick
from softgrip.materials.facts import facts
from softgrip.materials.fitting import Fitting, Modulus, Stress, fractional_power
from softgrip.materials.powerlaw import FractionalPowerRegressor
from softgrip.units import DEG, MPa

WORDS: dict[Kind, str] = {"linear": "linear", "ludwick": "Ludwick"}
TESTS = {
    f"{design}, {angle} deg, {WORDS[kind]}": (design, angle, kind)
    for design, angle, kind in product(FINGERS, ANGLES, KINDS)
}
"""Finger, set point (deg) and model by the words that the claims have for them."""
BOUND = 3.0
"""deg: the upper end of what Section 5.4 puts down to the material itself."""


def printed_rms() -> dict[tuple[str, int, Kind], float]:
    """Return the RMS errors that Section 5.4 prints, deg, by finger, set point (deg) and model."""
    return {case: float(claim_of(5, "5.4-rms-{key}", key).printed) for key, case in TESTS.items()}


def fitted_power(
    name: str,
    longest_strain: float = inf,
    stress: Stress = "true",
    loss: ludwick.Loss = "stress",
    modulus: Modulus = "held",
    *,
    two_decimals: bool = False,
) -> float:
    """Fit n to the public tensile test; NaN where a way of fitting gives none.

    With ``two_decimals`` the fitted 1/n is rounded to two decimals, as the printed column shows.
    """
    n = fractional_power(name, Fitting(stress, loss, longest_strain, modulus))
    return 1 / round(1 / n, 2) if two_decimals else n


def estimated_power(
    known: Sequence[Sequence[float]],
    new: Sequence[float],
    exponents: Sequence[float],
    scales: Sequence[float],
) -> float:
    """Predict n by Eq. (5.8).

    Args:
        known: Rows of n, E, MV and TS that it is fitted to.
        new: E, MV and TS.
        exponents, scales: Power and unit of E, MV and TS.
    """
    model = FractionalPowerRegressor(tuple(exponents), tuple(scales))
    model.fit([row[1:] for row in known], [row[0] for row in known])
    return float(model.predict([new])[0])


def hundred_percent_modulus(name: str, stress: Stress = "engineering") -> float:
    """Return the stress at strain 1 in the public tensile test, in MPa.

    There a solid that keeps its volume has half its area.
    """
    engineering = facts()[name].hundred_percent_modulus / MPa
    return 2 * engineering if stress == "true" else engineering


def peak_stress(name: str, share: float = 1.0) -> float:
    """Return a share of the largest engineering stress of the public tensile test, in MPa."""
    return share * facts()[name].peak_stress / MPa


def agreement_ratio(name: str) -> float:
    """Return the ratio of two expressions that should be one; see `dynamics.consistency`."""
    return agreement(name).ratio


@simulated
def rms_on_rig(case: str, identified: int = 60) -> float:
    """Return the RMS error, deg, of a model on the simulated rig, identified at one test.

    ``case`` is a key of `TESTS`.
    """
    design, angle, kind = TESTS[case]
    return step_test_error(design, kind, angle, identified=identified)


@simulated
def average_fit() -> float:
    """Return the mean fit of Eq. (5.16) to the 60 deg tests of the simulated rig, in percent."""
    return float(np.mean([identified_at(design, "ludwick").fit_percent for design in FINGERS]))


def allowed_fit(
    errors: Sequence[float], set_points: Sequence[float], overshoot: float = 0.0
) -> float:
    """Return the largest mean fit, percent, that RMS errors leave room for.

    A record that stays between two angles deviates from its own mean by half their distance at
    most, in the root mean square; a fit is an RMS error over this deviation, taken from 100.

    Args:
        errors: RMS errors, deg.
        set_points: Of the same tests, deg.
        overshoot: By which each record passes its set point, as a share of it.

    >>> allowed_fit([3.0], [60.0])
    90.0
    """
    halves = [(1 + overshoot) * angle / 2 for angle in set_points]
    return mean([100 * (1 - error / half) for error, half in zip(errors, halves, strict=True)])


@simulated
def linear_limit(design: str, bound: float | None = None) -> float:
    """Return up to which step one linear model will do on the simulated rig, deg.

    Args:
        design: Chapter 5's name.
        bound: RMS error up to which it does, deg; None for the fitted one.
    """
    points = [point for point in step_sweep.KEPT.read() if point.design == design]
    errors = [point.linear_range for point in points]
    most = choice("linear_bound") / DEG if bound is None else bound
    return float(np.interp(most, errors, [point.angle for point in points]))
