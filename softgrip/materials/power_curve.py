"""Fit of a power curve y = c x**p, by least squares of y or of log y."""

from collections.abc import Callable

import numpy as np
from scipy.optimize import minimize_scalar

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

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


def least(misfit: Callable[[float], float], scan: Floats, *, name: str) -> float:
    """Return where `misfit` is least: scan it, refine every valley, keep the deepest.

    Parameters
    ----------
    misfit
        Function to make least.
    scan
        Rising parameter values, shape (N,), so dense that each valley spans three of them.
    name
        What the parameter is called in the error.

    Raises
    ------
    InvalidInputError
        If the least value is at an end of the scan: the data do not fix the parameter within it.

    Examples
    --------
    >>> round(least(lambda x: (x - 0.3) ** 2, np.linspace(0, 1, 11), name="x"), 6)
    0.3
    """
    found = np.array([misfit(float(p)) for p in scan])
    valleys = 1 + np.flatnonzero((found[1:-1] <= found[:-2]) & (found[1:-1] <= found[2:]))
    ends = [
        minimize_scalar(
            misfit, bounds=(scan[i - 1], scan[i + 1]), method="bounded", options={"xatol": 1e-10}
        )
        for i in valleys
    ]
    deepest = min(ends, key=lambda end: float(end.fun), default=None)
    if deepest is None or deepest.fun > min(found[0], found[-1]):
        raise InvalidInputError(
            "strain, stress",
            expected=f"a curve that is best fitted by {name} from {scan[0]:g} to {scan[-1]:g}",
            got=f"one best fitted at or beyond {scan[np.argmin(found)]:g}",
        )
    return float(deepest.x)
