"""Ludwick's law: stress proportional to a power of strain, and its fit to a tensile test."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from softgrip.arrays import Floats, Value, check_positive, tensile_curve
from softgrip.checks import takes_numbers
from softgrip.errors import FitWarning, InvalidInputError
from softgrip.materials.toe import FEWEST, noise

Loss = Literal["stress", "log", "strain"]

EXPONENT_RANGE = (0.1, 10.0)
"""Exponents that are searched; those of elastomers in tension lie near 1 to 3."""
REST = 2e-3
"""Share of the largest strain within which a row is at strain 0, where the law has no stress."""
MISSED = 0.02
"""Share of the largest stress that the law may miss beyond the noise, root mean square."""
PRELOAD, CHANCE = 0.01, 4.0
"""Share of the largest stress, and standard deviations of the noise, above which one at strain 0 is
neither: it bends each power towards 1."""


@dataclass(frozen=True)
class LudwickFit:
    """Ludwick's law fitted to a tensile test.

    Attributes:
        young_modulus: E, Pa: the value held, or the fitted one.
        fractional_power: n, dimensionless.
        rms_stress: Root mean square of measured minus fitted stress over the rows used, Pa. It is
            given for each loss, so that fits with different losses can be compared.
        loss: What was made least.
        points: Number of rows used.
        missed: What the law misses of the curve beyond its noise, root mean square, as a share of
            the largest stress.
    """

    young_modulus: float
    fractional_power: float
    rms_stress: float
    loss: Loss
    points: int
    missed: float = 0.0

    @property
    def holds(self) -> bool:
        """Whether the law describes the curve: its power is else not to be relied on."""
        return self.missed <= MISSED


@takes_numbers
def stress(strain: Value, young_modulus: float, fractional_power: float) -> Value:
    """Return the stress of Ludwick's law, Eq. (5.2), continued as an odd function.

    Eq. (5.2) speaks of tension only. Below zero, where a real power of a negative number does not
    exist, we take ``-E |strain|**n``, so that a law used in a swinging system pulls back evenly
    from both sides.

    Args:
        strain: Engineering strain, dimensionless, any shape.
        young_modulus: E, Pa, > 0. For n other than 1 it is the stress at strain 1, not the slope at
            the origin.
        fractional_power: n, dimensionless, > 0. With n = 1 the law is Hooke's.

    Returns:
        float or ndarray: Engineering stress, Pa, shape of `strain`.

    Raises:
        InvalidInputError: If a parameter is not a finite number above zero.

    >>> float(stress(2.0, 1e5, 1.5).round()), float(stress(-2.0, 1e5, 1.5).round())
    (282843.0, -282843.0)
    """
    check_positive(young_modulus=young_modulus, fractional_power=fractional_power)
    result: Value = young_modulus * np.sign(strain) * np.abs(strain) ** fractional_power
    return result


@takes_numbers
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

    Args:
        strain: Engineering strain, shape (N,), >= 0.
        stress: Engineering stress, shape (N,), Pa. Rows where strain or stress is not above zero
            are left out by the losses "log" and "strain", which cannot use them.
        young_modulus: E to hold, Pa, > 0; None to fit it together with n.
        loss: "stress", "log" or "strain".

    Raises:
        InvalidInputError: If the curve has fewer than 3 usable rows, is not finite, or has negative
            strains; if the loss is unknown; or if the best exponent is outside `EXPONENT_RANGE`.

    Warns:
        FitWarning: If the curve has a stress at strain 0, a preload; `tester.read_export` takes it
            off.

    >>> e = np.linspace(0, 3, 50)
    >>> found = fit(e, 1e5 * e**1.6, loss="strain")
    >>> round(found.young_modulus), round(found.fractional_power, 6)
    (100000, 1.6)
    """
    if loss not in get_args(Loss):
        raise InvalidInputError("loss", expected=f"one of {get_args(Loss)}", got=loss)
    e, s = tensile_curve(strain, stress, at_least=3)
    _warn_of_preload(e, s)
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
    beyond = max(rms**2 - (noise(s) ** 2 if s.size >= FEWEST else 0.0), 0.0) ** 0.5
    return LudwickFit(E, n, rms, loss, e.size, beyond / float(s.max()))


def _warn_of_preload(strain: Floats, stress: Floats) -> None:
    rest = stress[strain <= REST * strain.max()]
    if rest.size == 0 or strain.size < FEWEST:
        return
    level = abs(float(rest.mean()))
    if level > max(PRELOAD * float(stress.max()), CHANCE * noise(stress)):
        warnings.warn(
            f"the curve begins at {level:.4g} Pa at strain 0, where Ludwick's law has none: a "
            "preload changes its power, take it off first",
            FitWarning,
            stacklevel=4,
        )


def fit_power(x: Floats, y: Floats, *, free: bool) -> tuple[float, float]:
    """Fit ``y = c x**p`` by least squares of y.

    The factor is linear: for each p the best c is known, which leaves one bounded search over p.

    Args:
        x, y: Shape (N,), dimensionless. x >= 0 with some value above zero.
        free: Whether to fit c; else c = 1.

    Returns:
        c and p.

    Raises:
        InvalidInputError: If the best p is not inside `EXPONENT_RANGE`.

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

    Args:
        x, y: Shape (N,), dimensionless, > 0; x not all equal.
        free: Whether to fit c; else c = 1.

    Returns:
        c and p.

    Raises:
        InvalidInputError: If the best p is not inside `EXPONENT_RANGE`.

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

    Args:
        misfit: Function to make least.
        scan: Rising parameter values, shape (N,), so dense that each valley spans three of them.
        name: What the parameter is called in the error.

    Raises:
        InvalidInputError: If the least value is at an end of the scan: the data do not fix the
            parameter within it.

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
