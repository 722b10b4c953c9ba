"""Yeoh's law for an incompressible solid pulled along one axis, and its fit to a tensile test."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Value, check_stretch, floats, tensile_curve
from softgrip.checks import check_finite, takes_numbers
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class YeohFit:
    """Yeoh's law fitted to a tensile test.

    Attributes:
        coefficients: C_1, C_2, C_3, Pa.
        rms_stress: Root mean square of measured minus fitted stress, Pa.
    """

    coefficients: tuple[float, ...]
    rms_stress: float


@takes_numbers
def stress(stretch: Value, coefficients: Sequence[float]) -> Value:
    """Return the engineering stress that follows from the energy ``sum C_i (I1 - 3)**i``.

    Args:
        stretch: Length over first length, 1 + strain, > 0, any shape.
        coefficients: C_i, Pa, usually three. One alone is the neo-Hookean law with shear modulus 2
            C_1.

    Returns:
        float or ndarray: Engineering stress, Pa, shape of `stretch`.

    Raises:
        InvalidInputError: If a stretch is not above zero.

    >>> stress(2.0, (1e5,))
    350000.0
    """
    check_stretch(stretch)
    (constants,) = floats(coefficients=coefficients)
    check_finite(coefficients=constants)
    if constants.ndim != 1:
        raise InvalidInputError("coefficients", expected="shape (k,)", got=coefficients)
    x = stretch**2 + 2 / stretch - 3
    slope = 0 * stretch
    for i, C in enumerate(constants.tolist(), start=1):
        slope = slope + i * C * x ** (i - 1)
    return 2 * (stretch - stretch**-2) * slope


@takes_numbers
def fit(strain: ArrayLike, engineering_stress: ArrayLike) -> YeohFit:
    """Fit three coefficients, which enter linearly, by least squares of the stress.

    Nothing keeps a coefficient from being negative, so the law holds for the strains fitted only.

    Args:
        strain: Engineering strain, shape (N,), >= 0, N >= 4.
        engineering_stress: Shape (N,), Pa.

    Raises:
        InvalidInputError: If the curve is too short, is not finite or has negative strains.

    >>> e = np.linspace(0, 3, 20)
    >>> fit(e, stress(1 + e, (3e4, 2e2, 1.0))).coefficients[0].__round__(3)
    30000.0
    """
    e, s = tensile_curve(strain, engineering_stress, at_least=4)
    A = np.column_stack([stress(1 + e, unit) for unit in np.eye(3).tolist()])
    # The columns differ by orders of magnitude at large strain: bring them to one length first.
    norms = np.linalg.norm(A, axis=0)
    C = np.linalg.lstsq(A / norms, s)[0] / norms
    return YeohFit(tuple(C.tolist()), float(np.sqrt(np.mean((A @ C - s) ** 2))))
