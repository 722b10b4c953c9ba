"""Multiplicative uncertainty: how far real fingers stray from the model, Eq. (6.17) and (6.18)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError
from softgrip.gripper.inversion import Complex
from softgrip.gripper.plant import FingerDynamics
from softgrip.gripper.shaping_filter import filter_state_space

if TYPE_CHECKING:
    import control


DAMPING_BOUND, STIFFNESS_BOUND = 0.143, 0.059
"""Largest deviations of C_n and K_n from their means over the step tests of Section 6.4."""

LEAST = 1e-6
"""Least of the squares of a weight's numerator and denominator, against a leading 1."""


def finger_response(finger: FingerDynamics, frequency: ArrayLike) -> Complex:
    """Return the finger's element of P(s) at ``s = j frequency``, rad/s, > 0, shape (N,)."""
    s = 1j * np.asarray(frequency, dtype=np.float64)
    return np.asarray(finger.gain / (s**3 + finger.damping * s**2 + finger.stiffness * s))


def excited_band(command: ArrayLike, period: float, *, share: float) -> tuple[float, float]:
    """Return the lowest and highest frequency at which a command holds a share of its peak, rad/s.

    Args:
        command: Shape (N,).
        period: s, > 0. No frequency above ``pi / period`` can be told from one below.
        share: Of the largest magnitude of the FFT, 0 to 1, frequency 0 left out.

    >>> t = 0.01 * np.arange(1000)
    >>> [round(w, 2) for w in excited_band(np.sin(2 * np.pi * 2 * t), 0.01, share=0.5)]
    [12.57, 12.57]
    """
    check_positive(period=period, share=share)
    u = np.asarray(command, dtype=np.float64)
    size = np.abs(np.fft.rfft(u))[1:]
    frequency = 2 * np.pi * np.fft.rfftfreq(u.size, period)[1:]
    held = frequency[size >= share * size.max()]
    return float(held[0]), float(held[-1])


def deviation(responses: ArrayLike, nominal: ArrayLike) -> Floats:
    """Return the least ``|W_T|`` that Eq. (6.18) allows at each frequency, over all runs.

    Args:
        responses: Complex, shape (runs, N).
        nominal: Complex, shape (N,), nowhere 0.
    """
    return np.asarray(np.abs(np.asarray(responses) / np.asarray(nominal) - 1).max(axis=0))


def parameter_bounds(fingers: Sequence[FingerDynamics]) -> tuple[float, float]:
    """Return the bounds of damping and stiffness, Eq. (6.13), as shares of their means.

    The largest deviations: those printed in Section 6.4 are 0.143 and 0.059.
    """
    found = np.array([(f.damping, f.stiffness) for f in fingers])
    mean = found.mean(axis=0)
    worst = np.abs(found / mean - 1).max(axis=0)
    return float(worst[0]), float(worst[1])


def bounding_weight(
    frequency: ArrayLike, bound: ArrayLike, *, order: int = 2
) -> control.StateSpace:
    """Return a stable minimum-phase W_T whose magnitude lies on or above a bound, and close to it.

    ``|W|**2`` is a rational function of ``w**2``. That it lies between the bound squared and g
    times it is linear in its coefficients, so the least g is found by halving; the factor with
    poles and zeros on the left is W.

    Args:
        frequency: rad/s, > 0, shape (N,).
        bound: Shape (N,), > 0.
        order: Number of poles, >= 1; 1 or 2 are usual.

    Raises:
        InvalidInputError: If shapes or values do not fit.
    """
    import control

    w, size = np.asarray(frequency, dtype=np.float64), np.asarray(bound, dtype=np.float64)
    if w.shape != size.shape or w.ndim != 1 or order < 1 or not (w.min() > 0 and size.min() > 0):
        raise InvalidInputError(
            "frequency, bound, order",
            expected="two positive arrays of shape (N,), >= 1",
            got=(w.shape, size.shape, order),
        )
    unit = float(np.sqrt(w.min() * w.max()))

    def powers_at(points: Floats) -> Floats:
        found = (points[:, None] / unit) ** (2 * np.arange(order + 1))
        return np.asarray(found / found.max(axis=1, keepdims=True))

    powers, wanted = powers_at(w), (size**2)[:, None]
    # Squares are positive, beyond the samples too.
    beyond = -powers_at(np.geomspace(w.min() / 100, w.max() * 100, 400))

    def coefficients(excess: float) -> Floats | None:
        none = np.zeros_like(beyond)
        sides = np.block(
            [
                [-powers, wanted * powers],
                [powers, -excess * wanted * powers],
                [beyond, none],
                [none, beyond],
            ]
        )
        found = scipy.optimize.linprog(
            np.zeros(2 * order + 2),
            A_ub=sides,
            b_ub=np.repeat([0.0, -LEAST], [2 * w.size, 2 * len(beyond)]),
            A_eq=[[0.0] * (2 * order + 1) + [1.0]],
            b_eq=[1.0],
            bounds=(None, None),
        )
        return np.asarray(found.x) if found.status == 0 else None

    worse = float((size.max() / size.min()) ** 2) * 1.01
    better, best = 1.0, coefficients(worse)
    for _ in range(40):
        middle = np.sqrt(better * worse)
        found = coefficients(middle)
        better, worse, best = (middle, worse, best) if found is None else (better, middle, found)
    assert best is not None  # a constant at the largest bound is always feasible
    top, low = (_left_factor(part) for part in (best[: order + 1], best[order + 1 :]))
    top, low = top / low[0], low / low[0]
    beyond = (top - top[0] * low)[1:]
    if beyond.any():
        rest = filter_state_space(beyond, low)
        found = control.ss(unit * rest.A, unit * rest.B, rest.C, top[0])
    else:  # the bound is a gain alone
        found = control.ss([], [], [], top[0])
    # The program's tolerance may leave the weight below the bound by a percent.
    return found * float(max(1.0, np.max(size / np.abs(found(1j * w)).ravel())))


def _left_factor(squares: Floats) -> Floats:
    """Return p(s) with roots on the left, ``|p(j w)|**2 = sum squares[k] w**(2 k)``."""
    in_s = np.zeros(2 * len(squares) - 1)
    in_s[::2] = squares[::-1] * (-1.0) ** np.arange(len(squares) - 1, -1, -1)
    roots = np.roots(in_s)
    left = np.poly(roots[np.argsort(roots.real)][: len(squares) - 1]).real
    return np.asarray(left * np.sqrt(squares[-1]))
