"""Ludwick's law: stress proportional to a power of strain, and its fit to a tensile test."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Value, check_positive, tensile_curve
from softgrip.errors import InvalidInputError
from softgrip.materials.power_curve import fit_line, fit_power

Loss = Literal["stress", "log", "strain"]


@dataclass(frozen=True)
class LudwickFit:
    """Ludwick's law fitted to a tensile test.

    Attributes
    ----------
    young_modulus
        E, Pa: the value held, or the fitted one.
    fractional_power
        n, dimensionless.
    rms_stress
        Root mean square of measured minus fitted stress over the rows used, Pa. It is given for
        each loss, so that fits with different losses can be compared.
    loss
        What was made least.
    points
        Number of rows used.
    """

    young_modulus: float
    fractional_power: float
    rms_stress: float
    loss: Loss
    points: int


def stress(strain: Value, young_modulus: float, fractional_power: float) -> Value:
    """Return the stress of Ludwick's law, Eq. (5.2), continued as an odd function.

    Eq. (5.2) speaks of tension only. Below zero, where a real power of a negative number does not
    exist, we take ``-E |strain|**n``, so that a law used in a swinging system pulls back evenly
    from both sides.

    Parameters
    ----------
    strain
        Engineering strain, dimensionless, any shape.
    young_modulus
        E, Pa, > 0. For n other than 1 it is the stress at strain 1, not the slope at the origin.
    fractional_power
        n, dimensionless, > 0. With n = 1 the law is Hooke's.

    Returns
    -------
    float or ndarray
        Engineering stress, Pa, shape of `strain`.

    Raises
    ------
    InvalidInputError
        If a parameter is not a finite number above zero.

    Examples
    --------
    >>> float(stress(2.0, 1e5, 1.5).round()), float(stress(-2.0, 1e5, 1.5).round())
    (282843.0, -282843.0)
    """
    check_positive(young_modulus=young_modulus, fractional_power=fractional_power)
    result: Value = young_modulus * np.sign(strain) * np.abs(strain) ** fractional_power
    return result


def fit(
    strain: ArrayLike,
    stress: ArrayLike,
    *,
    young_modulus: float | None = None,
    loss: Loss = "stress",
) -> LudwickFit:
    """Fit Ludwick's law to a tensile test.

    Each loss is a sum of squares over the rows: of ``stress - E strain**n``; of the difference of
    the logarithms; or, for "strain", of ``strain - (stress / E)**m`` with ``n = 1 / m``, the curve
    read with its axes exchanged. The first weighs the end of the curve most, the second its start.

    Parameters
    ----------
    strain
        Engineering strain, shape (N,), >= 0.
    stress
        Engineering stress, shape (N,), Pa. Rows where strain or stress is not above zero are left
        out by the losses "log" and "strain", which cannot use them.
    young_modulus
        E to hold, Pa, > 0; None to fit it together with n.
    loss
        "stress", "log" or "strain".

    Raises
    ------
    InvalidInputError
        If the curve has fewer than 3 usable rows, is not finite, or has negative strains; if the
        loss is unknown; or if the best exponent is outside `power_curve.EXPONENT_RANGE`.

    Examples
    --------
    >>> e = np.linspace(0, 3, 50)
    >>> found = fit(e, 1e5 * e**1.6, loss="strain")
    >>> round(found.young_modulus), round(found.fractional_power, 6)
    (100000, 1.6)
    """
    if loss not in get_args(Loss):
        raise InvalidInputError("loss", expected=f"one of {get_args(Loss)}", got=loss)
    e, s = tensile_curve(strain, stress, at_least=3)
    if loss != "stress":
        usable = (e > 0) & (s > 0)
        e, s = tensile_curve(e[usable], s[usable], at_least=3)
    free = young_modulus is None
    scale = float(s.max()) if young_modulus is None else young_modulus
    check_positive(young_modulus=scale)
    if loss == "stress":
        factor, n = fit_power(e, s / scale, free=free)
    elif loss == "log":
        factor, n = fit_line(e, s / scale, free=free)
    else:
        # strain = c (stress / scale)**m, hence stress = scale c**(-1/m) strain**(1/m)
        c, m = fit_power(s / scale, e, free=free)
        factor, n = c ** (-1 / m), 1 / m
    E = scale * factor
    rms = float(np.sqrt(np.mean((s - E * e**n) ** 2)))
    return LudwickFit(E, n, rms, loss, e.size)
