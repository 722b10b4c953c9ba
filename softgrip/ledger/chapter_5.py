"""Recomputation of the numbers printed in Chapter 5."""

from math import inf

from softgrip.materials.facts import facts
from softgrip.materials.fitting import Fitting, fractional_power
from softgrip.materials.powerlaw import FractionalPowerRegressor
from softgrip.materials.table import HELD_OUT, material, properties, table_5_1
from softgrip.materials.table import fractional_powers as printed_powers
from softgrip.units import MPa

TABLE_5_2 = {"Dragon Skin 20": (2.174, 2.365), "Dragon Skin FX Pro": (1.538, 1.727)}
"""True and estimated n as Table 5.2 prints them."""


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
