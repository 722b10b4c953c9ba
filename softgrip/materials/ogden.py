"""Ogden's law for an incompressible solid pulled along one axis, and its fit to a tensile test."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.materials.arrays import Value, check_stretch, tensile_curve
from softgrip.materials.search import least

EXPONENT_RANGE = (-10.0, 10.0)
"""Exponents alpha that the fit searches."""


@dataclass(frozen=True)
class OgdenFit:
    """Ogden's law of one term fitted to a tensile test.

    Attributes
    ----------
    modulus
        mu, Pa.
    exponent
        alpha, dimensionless.
    rms_stress
        Root mean square of measured minus fitted stress, Pa.
    """

    modulus: float
    exponent: float
    rms_stress: float


def stress(stretch: Value, moduli: Sequence[float], exponents: Sequence[float]) -> Value:
    """Return the engineering stress of the energy ``sum mu_i/alpha_i (l1**alpha_i + ... - 3)``.

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

    Raises
    ------
    InvalidInputError
        If a stretch is not above zero.

    Examples
    --------
    >>> stress(2.0, (2e5,), (2.0,))
    350000.0
    """
    check_stretch(stretch)
    total = 0 * stretch
    for mu, alpha in zip(moduli, exponents, strict=True):
        total = total + mu * (stretch ** (alpha - 1) - stretch ** (-alpha / 2 - 1))
    return total


def fit(strain: ArrayLike, engineering_stress: ArrayLike) -> OgdenFit:
    """Fit one term, two parameters as in Ludwick's law, by least squares of the stress.

    More terms are not fitted: on tensile tests of elastomers their exponents run together and
    leave large moduli of both signs that cancel, which no longer tell of the material.

    Parameters
    ----------
    strain
        Engineering strain, shape (N,), >= 0, N >= 3.
    engineering_stress
        Shape (N,), Pa.

    Raises
    ------
    InvalidInputError
        If the curve is too short, is not finite or has negative strains; or if the best exponent
        is not inside `EXPONENT_RANGE`.

    Examples
    --------
    >>> e = np.linspace(0, 3, 20)
    >>> found = fit(e, stress(1 + e, (2e4,), (2.5,)))
    >>> round(found.modulus), round(found.exponent, 6)
    (20000, 2.5)
    """
    e, s = tensile_curve(strain, engineering_stress, at_least=3)

    def modulus(alpha: float) -> float:
        shape = stress(1 + e, (1.0,), (alpha,))
        return float(shape @ s / (shape @ shape))

    def rms(alpha: float) -> float:
        return float(np.sqrt(np.mean((stress(1 + e, (modulus(alpha),), (alpha,)) - s) ** 2)))

    # Positive and negative exponents have each their valley. An even number of points leaves out
    # 0, where the law vanishes.
    alpha = least(rms, np.linspace(*EXPONENT_RANGE, 80), name="exponents")
    return OgdenFit(modulus(alpha), alpha, rms(alpha))
