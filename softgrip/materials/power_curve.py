"""Fit of a power curve y = c x**p, by least squares of y or of log y."""

import numpy as np

from softgrip.errors import InvalidInputError
from softgrip.materials.arrays import Floats
from softgrip.materials.search import least

EXPONENT_RANGE = (0.1, 10.0)
"""Exponents that are searched; those of elastomers in tension lie near 1 to 3."""


def fit_power(x: Floats, y: Floats, *, free: bool) -> tuple[float, float]:
    """Fit ``y = c x**p`` by least squares of y.

    The factor is linear: for each p the best c is known, which leaves one bounded search over p.

    Parameters
    ----------
    x, y
        Shape (N,), dimensionless. x >= 0 with some value above zero.
    free
        Whether to fit c; else c = 1.

    Returns
    -------
    c, p : float

    Raises
    ------
    InvalidInputError
        If the best p is not inside `EXPONENT_RANGE`.

    Examples
    --------
    >>> x = np.array([0.5, 1.0, 2.0])
    >>> c, p = fit_power(x, 3 * x**2, free=True)
    >>> round(c, 6), round(p, 6)
    (3.0, 2.0)
    """

    def factor(p: float) -> float:
        return float(y @ x**p / (x**p @ x**p)) if free else 1.0

    def misfit(p: float) -> float:
        return float(np.sum((y - factor(p) * x**p) ** 2))

    p = least(misfit, np.geomspace(*EXPONENT_RANGE, 60), name="powers")
    return factor(p), p


def fit_line(x: Floats, y: Floats, *, free: bool) -> tuple[float, float]:
    """Fit ``log y = log c + p log x`` by least squares of log y.

    Parameters
    ----------
    x, y
        Shape (N,), dimensionless, > 0; x not all equal.
    free
        Whether to fit c; else c = 1.

    Returns
    -------
    c, p : float

    Raises
    ------
    InvalidInputError
        If the best p is not inside `EXPONENT_RANGE`.

    Examples
    --------
    >>> x = np.array([0.5, 1.0, 2.0])
    >>> c, p = fit_line(x, 3 * x**2, free=True)
    >>> round(c, 6), round(p, 6)
    (3.0, 2.0)
    """
    u, v = np.log(x), np.log(y)
    u0, v0 = (float(u.mean()), float(v.mean())) if free else (0.0, 0.0)
    p = float((u - u0) @ (v - v0) / ((u - u0) @ (u - u0)))
    low, high = EXPONENT_RANGE
    if not low < p < high:
        raise InvalidInputError(
            "strain, stress",
            expected=f"a curve that is best fitted by powers from {low:g} to {high:g}",
            got=f"one best fitted by {p:.3g}",
        )
    return float(np.exp(v0 - p * u0)), p
