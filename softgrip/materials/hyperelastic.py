"""Yeoh's and Ogden's laws for an incompressible solid pulled along one axis, and their fits."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares

from softgrip.errors import InvalidInputError
from softgrip.materials.arrays import Floats, Value, tensile_curve

_STARTS = (-3.0, -1.0, 1.5, 3.0, 6.0)


@dataclass(frozen=True)
class YeohFit:
    """Yeoh's law fitted to a tensile test: C1, C2, C3 [Pa] and the RMS stress misfit [Pa]."""

    coefficients: tuple[float, ...]
    rms_stress: float


@dataclass(frozen=True)
class OgdenFit:
    """Ogden's law fitted to a tensile test: mu [Pa], alpha and the RMS stress misfit [Pa]."""

    moduli: tuple[float, ...]
    exponents: tuple[float, ...]
    rms_stress: float


def yeoh(stretch: Value, coefficients: Sequence[float]) -> Value:
    """Return Yeoh's engineering stress, from the energy ``sum C_i (I1 - 3)**i``, i = 1, 2, ...

    Parameters
    ----------
    stretch
        Length over first length, 1 + strain, > 0, any shape.
    coefficients
        C_i, Pa, usually three. One alone is the neo-Hookean law with shear modulus 2 C_1.

    Returns
    -------
    float or ndarray
        Engineering stress, Pa, shape of `stretch`.

    Examples
    --------
    >>> yeoh(2.0, (1e5,))
    350000.0
    """
    x = stretch**2 + 2 / stretch - 3
    slope = sum(i * C * x ** (i - 1) for i, C in enumerate(coefficients, start=1))
    return 2 * (stretch - stretch**-2) * slope


def ogden(stretch: Value, moduli: Sequence[float], exponents: Sequence[float]) -> Value:
    """Return Ogden's engineering stress, from ``sum mu_i/alpha_i (l1**alpha_i + ... - 3)``.

    Parameters
    ----------
    stretch
        Length over first length, 1 + strain, > 0, any shape.
    moduli
        mu_i, Pa. In this convention the shear modulus is half the sum of mu_i alpha_i.
    exponents
        alpha_i, dimensionless, not 0, as many as `moduli`.

    Returns
    -------
    float or ndarray
        Engineering stress, Pa, shape of `stretch`.

    Examples
    --------
    >>> ogden(2.0, (2e5,), (2.0,))
    350000.0
    """
    pairs = zip(moduli, exponents, strict=True)
    return sum(mu * (stretch ** (a - 1) - stretch ** (-a / 2 - 1)) for mu, a in pairs)


def fit_yeoh(strain: ArrayLike, stress: ArrayLike) -> YeohFit:
    """Fit Yeoh's three coefficients, which enter linearly, by least squares of the stress.

    Parameters
    ----------
    strain, stress
        Engineering strain >= 0 and engineering stress [Pa], shape (N,), N >= 4.

    Raises
    ------
    InvalidInputError
        If the curve is too short, is not finite or has negative strains.
    """
    e, s = tensile_curve(strain, stress, at_least=4)
    C, rms = _linear(np.column_stack([yeoh(1 + e, unit) for unit in np.eye(3)]), s)
    return YeohFit(tuple(C.tolist()), rms)


def fit_ogden(strain: ArrayLike, stress: ArrayLike, *, terms: int = 2) -> OgdenFit:
    """Fit Ogden's law by least squares of the stress: search the exponents, solve for the moduli.

    The search starts from a fixed set of exponents and keeps the best end. Moduli of either sign
    are allowed, so the law may be unstable outside the strains that it was fitted to.

    Parameters
    ----------
    strain, stress
        Engineering strain >= 0 and engineering stress [Pa], shape (N,), N > 2 `terms`.
    terms
        1, 2 or 3. Exponents are searched between -10 and 10.

    Raises
    ------
    InvalidInputError
        If `terms` is out of range, or the curve is too short, not finite or of negative strains.
    """
    if terms not in (1, 2, 3):
        raise InvalidInputError("terms", expected="1, 2 or 3", got=terms)
    e, s = tensile_curve(strain, stress, at_least=2 * terms + 1)
    size = float(np.sqrt(np.mean(s**2)))

    def columns(alpha: Floats) -> Floats:
        return np.column_stack([ogden(1 + e, (1.0,), (a,)) for a in alpha])

    def misfit(alpha: Floats) -> Floats:
        A = columns(alpha)
        return np.asarray((A @ _linear(A, s)[0] - s) / size)

    ends = [least_squares(misfit, x0, bounds=(-10, 10)) for x0 in combinations(_STARTS, terms)]
    alpha = np.sort(min(ends, key=lambda end: float(end.cost)).x)
    mu, rms = _linear(columns(alpha), s)
    return OgdenFit(tuple(mu.tolist()), tuple(alpha.tolist()), rms)


def _linear(A: Floats, s: Floats) -> tuple[Floats, float]:
    # Columns of different powers differ by many orders of magnitude: scale them before solving.
    norms = np.linalg.norm(A, axis=0) + np.finfo(np.float64).tiny
    x = np.linalg.lstsq(A / norms, s)[0] / norms
    return x, float(np.sqrt(np.mean((A @ x - s) ** 2)))
