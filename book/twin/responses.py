"""Responses of many small systems to many sampled inputs, and what least squares need of them.

Compiled, several records side by side. A system of a record may come in variants, in each of which
a parameter is a little more: the differences of their responses are the slopes of the sum of
squares.
"""

from typing import Any

import numpy as np
from numba import njit

from softgrip.arrays import Floats
from softgrip.simulator.lane_power import power

LANES = 16
"""Records side by side: two registers of the processor each."""
FARTHEST = 1e3
"""rad: what has run away stays there."""

WORK = np.dtype(
    [(name, "f8", LANES) for name in ["angle", "rate", "now", "then", "a", "b", "c", "d", "e", "f"]]
)
"""State, input before and after a period, and the rows of a system: in one record, so that the
compiler knows that none is another."""

_compiled: Any = njit(error_model="numpy", fastmath={"contract"})
_power = _compiled(power)


@_compiled
def _second_order(w: Any) -> None:
    """Move freely about what a ramp would give, over a period."""
    for j in range(LANES):
        change = w.then[j] - w.now[j]
        slope, level = change * w.e[j], w.now[j] - change * w.f[j]
        off, drift = w.angle[j] - level, w.rate[j] - slope
        w.angle[j] = level + change + w.a[j] * off + w.b[j] * drift
        w.rate[j] = slope + w.c[j] * off + w.d[j] * drift


@_compiled
def _acceleration(w: Any, j: int, angle: float, rate: float, push: float) -> float:
    size = min(abs(angle), FARTHEST)
    found: float = push * w.a[j] - w.b[j] * rate - w.c[j] * _power(size, w.d[j]) * angle
    return found


@_compiled
def _ludwick(w: Any) -> None:
    """Take a Runge-Kutta step of a period."""
    for j in range(LANES):
        a, v, middle, h = w.angle[j], w.rate[j], (w.now[j] + w.then[j]) / 2, w.e[j]
        k1 = _acceleration(w, j, a, v, w.now[j])
        k2 = _acceleration(w, j, a + h / 2 * v, v + h / 2 * k1, middle)
        k3 = _acceleration(w, j, a + h / 2 * (v + h / 2 * k1), v + h / 2 * k2, middle)
        k4 = _acceleration(w, j, a + h * (v + h / 2 * k2), v + h * k3, w.then[j])
        a += h * v + h * h / 6 * (k1 + k2 + k3)
        w.angle[j] = a if abs(a) <= FARTHEST else FARTHEST
        w.rate[j] = v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


@_compiled
def _take(records: Floats, which: Any, first: int, row: Floats) -> int:
    """Fill with some records side by side, shape (N, LANES), and return how many there are."""
    count = min(LANES, len(which) - first)
    own = np.array([which[first + min(j, count - 1)] for j in range(LANES)])
    for k in range(len(row)):
        for j in range(LANES):
            row[k, j] = records[own[j], k]
    return count


@_compiled
def _run(linear: bool, u: Floats, systems: Floats, first: int, count: int, made: Floats) -> None:
    """Fill with responses from rest; the first sample is 0 already."""
    w = np.zeros(1, WORK)[0]
    for j in range(LANES):
        own = systems[:, first + min(j, count - 1)]
        w.a[j], w.b[j], w.c[j], w.d[j], w.e[j], w.f[j] = (
            own[0],
            own[1],
            own[2],
            own[3],
            own[4],
            own[5],
        )
    for k in range(len(u) - 1):
        for j in range(LANES):
            w.now[j] = u[k, j]
            w.then[j] = u[k + 1, j]
        if linear:
            _second_order(w)
        else:
            _ludwick(w)
        for j in range(LANES):
            made[k + 1, j] = w.angle[j]


@_compiled
def respond(linear: bool, inputs: Floats, systems: Floats, out: Floats) -> None:
    """Fill with responses, shape (records, N), to inputs of that shape, straight between samples.

    Args:
        linear: True for a second-order system, False for a finger after Eq. (5.16).
        inputs: Shape (records, N).
        systems: Shape (rows, records).
        out: Shape (records, N).
    """
    every = np.arange(len(inputs))
    u, made = np.zeros((inputs.shape[1], LANES)), np.zeros((inputs.shape[1], LANES))
    for first in range(0, len(inputs), LANES):
        count = _take(inputs, every, first, u)
        _run(linear, u, systems, first, count, made)
        for j in range(count):
            for k in range(len(u)):
                out[first + j, k] = made[k, j]


@_compiled
def squares(
    linear: bool,
    offset: bool,
    inputs: Floats,
    outputs: Floats,
    which: Any,
    systems: Floats,
    step: float,
    gains: Floats,
    cost: Floats,
    pull: Floats,
    normal: Floats,
) -> None:
    """Fill with the sums of squares of responses less outputs, and their derivatives.

    A second-order system is that of unit gain: its response is multiplied by the gain of least
    squares.

    Args:
        linear: As of `respond`.
        offset: Whether a second-order response is taken without its mean; the outputs have none.
        inputs, outputs: Shape (records, N).
        which: The record of each fit, shape (fits,).
        systems: Shape (1 + P, rows, fits): each, then with one parameter more, in turn.
        step: By how much more.
        gains: To fill, shape (fits,): of the first variant.
        cost, pull, normal: To fill: the sum, half its gradient, and J' J, shapes (fits,), (fits, P)
            and (fits, P, P).
    """
    size, P = inputs.shape[1], pull.shape[1]
    u, y = np.zeros((size, LANES)), np.zeros((size, LANES))
    made = np.zeros((1 + P, size, LANES))
    level, gain = np.zeros((1 + P, LANES)), np.ones((1 + P, LANES))
    slope, total = np.zeros((P, LANES)), np.zeros(LANES)
    here, off = np.zeros(LANES), np.zeros(LANES)
    along, across = np.zeros((P, LANES)), np.zeros((P, P, LANES))
    for first in range(0, len(which), LANES):
        count = _take(inputs, which, first, u)
        _take(outputs, which, first, y)
        for v in range(len(made)):
            _run(linear, u, systems[v], first, count, made[v])
            if linear:
                _scale(offset, made[v], y, level[v], gain[v])
        total[:], along[:], across[:] = 0.0, 0.0, 0.0
        for k in range(size):
            for j in range(LANES):
                here[j] = gain[0, j] * (made[0, k, j] - level[0, j])
                off[j] = here[j] - y[k, j]
                total[j] += off[j] * off[j]
            for p in range(P):
                for j in range(LANES):
                    more = gain[1 + p, j] * (made[1 + p, k, j] - level[1 + p, j])
                    slope[p, j] = (more - here[j]) / step
                    along[p, j] += slope[p, j] * off[j]
                for q in range(p + 1):
                    for j in range(LANES):
                        across[p, q, j] += slope[p, j] * slope[q, j]
        for j in range(count):
            cost[first + j], gains[first + j] = total[j], gain[0, j]
            for p in range(P):
                pull[first + j, p] = along[p, j]
                for q in range(p + 1):
                    normal[first + j, p, q] = normal[first + j, q, p] = across[p, q, j]


@_compiled
def _scale(offset: bool, made: Floats, y: Floats, level: Floats, gain: Floats) -> None:
    """Fill with the mean of a response, and the gain that brings it nearest to an output."""
    power = np.zeros(LANES)
    level[:], gain[:] = 0.0, 0.0
    if offset:
        for k in range(len(made)):
            for j in range(LANES):
                level[j] += made[k, j] / len(made)
    for k in range(len(made)):
        for j in range(LANES):
            off = made[k, j] - level[j]
            power[j] += off * off
            gain[j] += off * y[k, j]
    for j in range(LANES):
        gain[j] /= max(power[j], 1e-300)
