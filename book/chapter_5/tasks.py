"""Answers of the tasks of Chapter 5."""

from math import log

import numpy as np
from scipy.optimize import brentq
from scipy.stats import spearmanr

from book.chapter_5.matched_model import resting_angle
from softgrip.materials.facts import facts
from softgrip.materials.powerlaw import FractionalPowerRegressor, predict_power
from softgrip.materials.table import fractional_powers, properties, table_5_1
from softgrip.units import MPa

MATERIAL = "Dragon Skin 20"
"""Of the first task."""
MODULI, VISCOSITY, STRENGTH = (0.05, 0.65), 19.0, 3.2
"""Of the second task: ends of the slider of E (MPa), and where the other two start (Pa s, MPa)."""
POWER = 2.0
"""n of the third task."""


def ending_power(material: str = MATERIAL) -> float:
    """Return the n with which Ludwick's law, E as printed, ends where the tensile test does."""
    known, modulus = facts()[material], table_5_1()[material].young_modulus
    largest = known.peak_stress * (1 + known.peak_strain)
    return log(largest / modulus) / log(known.peak_strain)


def share_at_one(material: str = MATERIAL) -> float:
    """Return the part of the true stress at a strain of one that Ludwick's law gives, for any n."""
    true_stress = 2 * facts()[material].hundred_percent_modulus
    return table_5_1()[material].young_modulus / true_stress


def powers_by_modulus() -> tuple[float, float]:
    """Return the predicted n at the ends of the slider of E."""
    low, high = (predict_power(E * MPa, VISCOSITY, STRENGTH * MPa).power for E in MODULI)
    return low.value, high.value


def modulus_factor() -> float:
    """Return the factor of E (MPa) in Eq. (5.8), fitted to all materials."""
    known = [*table_5_1().values()]
    model = FractionalPowerRegressor().fit(properties(known), fractional_powers(known))
    return float(model.coef_[0])


def stiff_and_strong() -> float:
    """Return Spearman's rank correlation of E and tensile strength over the materials."""
    modulus, _, strength = properties(table_5_1().values()).T
    return float(spearmanr(modulus, strength).statistic)


def window(first: float, bound: float, power: float = POWER) -> tuple[float, float]:
    """Return between which angles a linear spring rests within a bound, deg.

    Args:
        first: Where it agrees with Ludwick's spring, deg.
        bound: deg, below ``first / 4``, so that n from 2 to 3 has an end on either side.
        power: n.
    """

    def off(angle: float) -> float:
        return abs(float(resting_angle(first, angle, power)) - angle) - bound

    # The error is largest between 0 and `first` where the slopes are the same.
    turn = first * power ** (-1 / (power - 1))
    return float(brentq(off, turn, first)), float(brentq(off, first, 2 * first))


def window_width(first: float, bound: float, power: float = POWER) -> float:
    """Return how wide a `window` is, deg."""
    low, high = window(first, bound, power)
    return float(np.subtract(high, low))
