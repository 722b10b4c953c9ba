"""The filters H(s) of Chapter 6 that make the inverse proper: printed, and the plain low-pass."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import check_positive, read_only
from softgrip.errors import InvalidInputError

if TYPE_CHECKING:
    import control


FAST = (
    (1009.0, 2.52e5, 6.829e5, 1.027e6),
    (1.0, 282.7, 6.14e3, 8.022e4, 4.335e5, 8.948e5, 1.027e6),
)
"""Numerator and denominator of H(s) for the target loop 4.8/s (Section 6.4, simulation)."""

SLOW = (
    (49.47, 1991.0, 4917.0, 6270.0),
    (1.0, 51.21, 442.5, 2339.0, 6400.0, 9281.0, 6270.0),
)
"""Numerator and denominator of H(s) for the target loop 2/s (Section 6.4, experiment)."""


def filter_state_space(numerator: ArrayLike, denominator: ArrayLike) -> control.StateSpace:
    """Return a strictly proper filter from its coefficients, highest power first.

    The companion form counts time in units of the mean pole, without which the powers of the
    printed filters' matrices span twelve decades.

    Raises:
        InvalidInputError: If the degree of the numerator is not below that of the denominator.

    >>> filter_state_space(*FAST)(0).round(12).real.item()
    1.0
    """
    import control

    top = np.trim_zeros(np.atleast_1d(np.asarray(numerator, dtype=np.float64)), "f")
    low = np.trim_zeros(np.atleast_1d(np.asarray(denominator, dtype=np.float64)), "f")
    order = len(low) - 1
    if not 0 < len(top) <= order:
        raise InvalidInputError(
            "numerator, denominator", expected="a lower degree on top", got=(len(top) - 1, order)
        )
    top, low = top / low[0], low / low[0]
    unit = abs(low[-1]) ** (1 / order) if low[-1] else 1.0
    low = low / unit ** np.arange(order + 1)
    top = np.pad(top, (order - len(top), 0)) / unit ** np.arange(1, order + 1)
    A = np.eye(order, k=-1)
    A[0] = -low[1:]
    return control.ss(unit * A, unit * np.eye(order)[:, :1], top[None], 0)


def low_pass(cut_off: float, order: int = 3) -> control.StateSpace:
    """Return the filter of Remark 4, ``a_0 / (s^l + ... + a_0)``, of Butterworth's shape.

    Args:
        cut_off: Where it is 3 dB down, rad/s, > 0.
        order: l, the relative order of the inverse or more: 3 here.

    >>> abs(low_pass(4.8)(4.8j)).round(6).item()  # 1 / sqrt(2)
    0.707107
    """
    check_positive(cut_off=cut_off)
    if order < 1:
        raise InvalidInputError("order", expected=">= 1", got=order)
    angles = np.pi * (2 * np.arange(order) + order + 1) / (2 * order)
    poles = np.exp(1j * angles) * cut_off
    return filter_state_space([cut_off**order], np.poly(poles).real)


def bandwidth(low_pass: control.StateSpace) -> float:
    """Return the first frequency at which the gain is 3 dB below that at 0, rad/s.

    >>> [round(bandwidth(filter_state_space(*printed)), 1) for printed in (FAST, SLOW)]
    [6.8, 2.5]
    """
    edge = np.abs(low_pass.poles()).max()
    w = np.geomspace(1e-3 * edge, 10 * edge, 20001)
    gain = np.abs(low_pass(1j * w)).ravel()
    below = gain < abs(low_pass(0).item()) / np.sqrt(2)
    return float(w[np.argmax(below)]) if below.any() else np.inf


def plant_inside(numerator: ArrayLike, denominator: ArrayLike) -> tuple[float, float]:
    """Return damping [1/s] and stiffness [1/s^2] of the plant that a filter was shaped around.

    If H is ``L / (1 + L)``, then ``L = numerator / (denominator - numerator)``, and the loop holds
    the plant's poles: 0 and the slowest pair.

    >>> [round(value, 3) for value in plant_inside(*FAST)]
    [2.537, 3.284]
    """
    low = np.asarray(denominator, dtype=np.float64)
    top = np.asarray(numerator, dtype=np.float64)
    poles = np.roots(np.polysub(low, top))
    pair = poles[np.argsort(np.abs(poles))][1:3]
    return float(-pair.sum().real), float(pair.prod().real)


def far_pole(numerator: ArrayLike, denominator: ArrayLike) -> float:
    """Return the decay rate of the fastest pole of ``H / (1 - H)``, 1/s.

    >>> [round(far_pole(*printed), 1) for printed in (FAST, SLOW)]
    [260.3, 41.9]
    """
    loop = np.polysub(read_only(denominator), read_only(numerator))
    return float(np.abs(np.roots(loop)).max())


def rounding_margin(
    numerator: ArrayLike, denominator: ArrayLike, *, digits: int = 4
) -> tuple[float, float]:
    """Return by how much `plant_inside` may be off because the coefficients are rounded.

    The effects of all coefficients add up, to first order: no rounding does worse.

    Args:
        numerator, denominator: As printed; a leading 1 is exact.
        digits: Significant digits of the print.
    """
    printed = [np.asarray(p, dtype=np.float64) for p in (numerator, denominator)]
    middle = np.array(plant_inside(*printed))
    total = np.zeros(2)
    for which, coefficients in enumerate(printed):
        for k, value in enumerate(coefficients):
            if value == 1:
                continue
            moved = [p.copy() for p in printed]
            moved[which][k] += 0.5 * 10.0 ** (np.floor(np.log10(abs(value))) - digits + 1)
            total += np.abs(np.array(plant_inside(*moved)) - middle)
    return float(total[0]), float(total[1])
