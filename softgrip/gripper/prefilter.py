"""The prefilter of loop shaping: it gives a plant the crossover and the slope of a target loop."""

import control
import numpy as np
from scipy.optimize import least_squares

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError

DECADES = 3.0
"""The rule is fitted this far below and above the crossover."""
EXTREME = 1e6
"""Largest gain of W over that at the crossover that is asked for, and one over the least."""
GRID = np.geomspace(10**-DECADES, 10**DECADES, 241)
"""Frequencies over the crossover."""
SECTIONS = 3
"""Largest number of first-order sections."""
FIT = 0.05
"""Error of the logarithm of the gain, RMS, at which no further section is added."""


def polynomials(system: control.LTI) -> tuple[Floats, Floats]:
    """Return numerator and denominator, highest power first, the latter starting with 1.

    Args:
        system: One input, one output, continuous, proper.

    Raises:
        InvalidInputError: If it is not.

    >>> [p.round(6).tolist() for p in polynomials(control.ss(-2, 1, 3, 0))]
    [[3.0], [1.0, 2.0]]
    """
    if system.ninputs != 1 or system.noutputs != 1 or system.dt:
        raise InvalidInputError(
            "system",
            expected="one input, one output, continuous",
            got=f"{system.ninputs} inputs, {system.noutputs} outputs, dt = {system.dt}",
        )
    if isinstance(system, control.TransferFunction):
        top, low = (np.trim_zeros(p[0][0], "f") for p in (system.num, system.den))
    else:
        degree, gain = _leading(control.ss(system))
        # Those at infinity come out as very large numbers.
        zeros = sorted(system.zeros(), key=abs)[: max(degree, 0)]
        low = np.atleast_1d(np.poly(system.poles()).real)
        top = gain * np.atleast_1d(np.poly(zeros).real)
    if not (np.any(top) and len(top) <= len(low)):
        raise InvalidInputError(
            "system", expected="a proper one that is not 0", got=(len(top) - 1, len(low) - 1)
        )
    return np.asarray(top / low[0], np.float64), np.asarray(low / low[0], np.float64)


def _leading(system: control.StateSpace) -> tuple[int, float]:
    """Return degree and leading coefficient of the numerator: the first Markov parameter not 0."""
    A, B, C = system.A, system.B, system.C
    unit = np.abs(np.linalg.eigvals(A)).max(initial=0) or 1.0
    size, power = np.linalg.norm(C) * np.linalg.norm(B), B
    if abs(system.D.item()) > 1e-9 * size / unit:
        return len(A), system.D.item()
    for k in range(len(A)):
        if abs((C @ power).item()) > 1e-9 * size:
            return len(A) - 1 - k, (C @ power).item() * unit**k
        power = A @ power / unit
    return -1, 0.0


def prefilter(plant: control.LTI, crossover: float) -> control.TransferFunction:
    """Return the W that gives ``G W`` the crossover of ``Gd = crossover / s``, and its slope.

    Relative to the crossover, where ``|G W|`` is 1, W raises the gain below it, if the plant's is
    less than the target's there, and lowers it above, if it is more; elsewhere it is constant. So
    a plant that falls faster than the target, such as a finger with its pump, gets a constant,
    and its own gain is gone from what is shaped.

    Args:
        plant: G: one input, one output, continuous, proper.
        crossover: rad/s, > 0, where the plant has a gain other than 0.

    Returns:
        TransferFunction: Stable, minimum phase, of first-order sections fitted to the rule's gain.

    >>> W = prefilter(control.tf([7.0], [1, 2, 0, 0]), 2.0)
    >>> W.num[0][0].round(4).tolist(), W.den[0][0].tolist()  # 4 sqrt(8) / 7
    ([1.6162], [1.0])
    """
    check_positive(crossover=crossover)
    top, low = polynomials(plant)
    at = abs(np.polyval(top, 1j * crossover) / np.polyval(low, 1j * crossover))
    check_positive(gain_at_the_crossover=at)
    s = 1j * crossover * GRID
    gain = np.abs(np.polyval(top, s) / np.polyval(low, s)) / at
    with np.errstate(divide="ignore"):
        short = 1 / (GRID * gain)
    wanted = np.where(GRID < 1, np.maximum(short, 1), np.minimum(short, 1))
    log_gain = np.log(np.clip(wanted, 1 / EXTREME, EXTREME))
    numerator, denominator = np.ones(1), np.ones(1)
    for sections in range(1, SECTIONS + 1):
        error = log_gain - _log_gain(numerator, denominator, GRID)
        if np.sqrt(np.mean(error**2)) < FIT:
            break
        numerator, denominator = _fitted(log_gain, sections)
    numerator = numerator / abs(np.polyval(numerator, 1j) / np.polyval(denominator, 1j)) / at
    return control.tf(
        numerator * crossover ** np.arange(len(numerator)),
        denominator * crossover ** np.arange(len(denominator)),
    )


def _log_gain(numerator: Floats, denominator: Floats, frequency: Floats) -> Floats:
    s = 1j * frequency
    return np.asarray(np.log(np.abs(np.polyval(numerator, s) / np.polyval(denominator, s))))


def _fitted(log_gain: Floats, sections: int) -> tuple[Floats, Floats]:
    """Return the product of so many ``(s + z) / (s + p)``, times a gain, nearest to a log gain."""

    def ratio(x: Floats) -> tuple[Floats, Floats]:
        zeros, poles = np.exp(x[1:]).reshape(2, -1)
        return np.asarray(np.exp(x[0]) * np.poly(-zeros)), np.asarray(np.poly(-poles))

    edge = DECADES * np.log(10)
    fits = []
    for width in (0.5, 1.0, 1.5):
        apart = np.linspace(-width, width, sections + 2)[1:-1] * edge
        fits.append(
            least_squares(
                lambda x: _log_gain(*ratio(x), GRID) - log_gain,
                np.concatenate([[0.0], apart + 0.1, apart - 0.1]),
                bounds=(-2 * edge, 2 * edge),
            )
        )
    return ratio(min(fits, key=lambda fit: float(fit.cost)).x)
