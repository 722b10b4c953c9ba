"""Finite elements over the width of an element's flat top, between the rows that are kept."""

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import STATED_MODULUS, Shape
from softgrip.tactile.element_results import read


def largest_for(shape: Shape, cut: float) -> float:
    """Return the largest displacement of the top by force, m/N, between the rows of the sweep.

    By straight lines in the logarithms, for E = 0.125 MPa.

    Raises
    ------
    InvalidInputError
        If the cut is outside the sweep, 0.05 to 0.9.
    """
    cuts, soft = _curve(shape)
    return _between(cut, cuts, soft, "cut")


def cut_for(shape: Shape, largest: float, young_modulus: float = STATED_MODULUS) -> float:
    """Return the cut that gives a largest displacement by force, m/N: `largest_for` turned round.

    Raises
    ------
    InvalidInputError
        If no cut of the sweep gives it.
    """
    cuts, soft = _curve(shape)
    given = largest * young_modulus / STATED_MODULUS
    return _between(given, soft[::-1], cuts[::-1], "largest")


def _curve(shape: Shape) -> tuple[Floats, Floats]:
    """Return the cuts of the sweep and the largest displacements by force, m/N."""
    # Up to 0.9: at upright walls the rim of the top sinks further than its middle.
    rows = [r for r in read("cut") if r.element.shape == shape and r.element.cut <= 0.9]
    if not rows:
        raise InvalidInputError("shape", expected="hemisphere or pyramid", got=shape)
    return np.array([r.element.cut for r in rows]), np.array([r.top.largest for r in rows])


def _between(x: float, at: Floats, values: Floats, name: str) -> float:
    if not at[0] <= x <= at[-1]:
        raise InvalidInputError(name, expected=f"{at[0]:g} to {at[-1]:g}", got=x)
    return float(np.exp(np.interp(np.log(x), np.log(at), np.log(values))))
