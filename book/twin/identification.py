"""The identifications of Chapters 3 to 6, for a batch of records at once.

Each is `dynamics.identify.identify` or `dynamics.ludwick_fit.fit_finger` without intervals: the
same model, the same squares, the same grid of starts, and so the same minimum.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from book.twin.least_squares import Squares, Which, fit
from softgrip.arrays import Flags, Floats, Number
from softgrip.dynamics.identify import START_DAMPING
from softgrip.dynamics.ludwick import LudwickFinger
from softgrip.dynamics.second_order import free_motion

FREQUENCIES = 12
"""Of the starts of `identify_second_order`, as of `identify`."""
COARSE = 4
"""Samples of which one serves to search a start: which of a grid is nearest, a quarter tells."""
MORE = 1e-7
"""Of the differences of logarithms: between what a curve and what rounding makes of a slope."""
FARTHEST = 60.0
"""Size of a logarithm of mass, damping or stiffness beyond which nothing changes any more."""
MOST_DAMPING = 1e3
"""Largest damping ratio, and the inverse of the least, on which a controller is designed."""
LEAST_ANGLE, LEAST_PRESSURE = 1e-3, 1.0
"""rad and Pa."""


Fit = tuple[Squares, Callable[[Floats, Which], tuple[Floats, Floats]]]
"""The squares of a fit, and their sum and the gains without derivatives."""


@dataclass(frozen=True)
class SecondOrders:
    """Second-order systems, each of shape (records,): rad/s, dimensionless, output by input."""

    natural_frequency: Floats
    damping_ratio: Floats
    gain: Floats

    @property
    def usable(self) -> Flags:
        """Which have a positive gain and a damping that a record can tell from none or from all."""
        z = self.damping_ratio
        told = np.isfinite(self.natural_frequency) & (z > 1 / MOST_DAMPING) & (z < MOST_DAMPING)
        return np.asarray(told & np.isfinite(self.gain) & (self.gain > 0))


def _second_orders(period: float, w: Floats, z: Floats) -> Floats:
    """Return systems of unit gain as `responses` has them, shape (..., 6, records).

    How angle and rate move freely over a period, and by the difference of the input its slope and
    how far a ramp is ahead of the angle.
    """
    c, s = free_motion(period, w, z)
    rows = (c + z * w * s, s, -w * w * s, c - z * w * s, np.full_like(w, 1 / period))
    return np.stack([*rows, 2 * z / (w * period)], axis=-2)


def _fingers(
    period: float, mass: Floats, damping: Floats, stiffness: Floats, power: Number
) -> Floats:
    """Return fingers after Eq. (5.16) as `responses` has them, shape (..., 6, records)."""
    rows = (1 / mass, damping / mass, stiffness / mass, power - 1.0, period, 0.0)
    return np.stack(np.broadcast_arrays(*rows), axis=-2)


def second_order_responses(
    signal: Floats, period: float, natural_frequency: Floats, damping_ratio: Floats
) -> Floats:
    """Return the responses of systems of unit gain, from rest at an input of 0.

    As `dynamics.second_order.response`, but for a system to each record.

    Args:
        signal: Inputs, straight between samples, shape (records, N).
        period: s.
        natural_frequency, damping_ratio: Shape (records,).

    Returns:
        Floats: Shape (records, N).
    """
    return _responses(True, signal, _second_orders(period, natural_frequency, damping_ratio))


def ludwick_responses(
    finger: LudwickFinger, time: Floats, pressure: Floats, force_per_pressure: float = 1.0
) -> Floats:
    """Return the angles of fingers after Eq. (5.16), from rest at 0, rad, shape (records, N).

    As `dynamics.ludwick.pressure_response`, but for a pressure to each record.

    Args:
        finger: Parameters of shape (records,); the power may be one number.
        time: Even, s, shape (N,).
        pressure: Pa, shape (records, N), straight between samples.
        force_per_pressure: F over P, N/Pa.
    """
    parts: Number = (finger.mass, finger.damping, finger.stiffness, finger.fractional_power)
    parts = np.broadcast_arrays(*parts, np.zeros(len(pressure)))
    systems = _fingers(float(time[1] - time[0]), *parts[:-1])
    return _responses(False, force_per_pressure * pressure, systems)


def _responses(linear: bool, inputs: Floats, systems: Floats) -> Floats:
    from book.twin.responses import respond

    out = np.empty(inputs.shape)
    respond(linear, np.ascontiguousarray(inputs), systems, out)
    return out


def _squares(
    linear: bool,
    inputs: Floats,
    outputs: Floats,
    systems: Callable[[Floats], Floats],
    *,
    offset: bool = False,
) -> Fit:
    """Return the squares of a fit of systems to records, and the same without derivatives.

    Args:
        linear, inputs, outputs, offset: As of `responses.squares`.
        systems: From parameters, shape (..., fits, P), to systems, shape (..., rows, fits).

    """
    from book.twin.responses import squares

    u, y = np.ascontiguousarray(inputs), np.ascontiguousarray(outputs)

    def found(x: Floats, which: Which) -> tuple[Floats, ...]:
        fits, slopes = x.shape[1], len(x) - 1
        gains, cost = np.empty(fits), np.empty(fits)
        pull, normal = np.empty((fits, slopes)), np.empty((fits, slopes, slopes))
        own = np.ascontiguousarray(systems(x))
        squares(linear, offset, u, y, which, own, MORE, gains, cost, pull, normal)
        return cost, gains, pull, normal

    def whole(x: Floats, which: Which) -> tuple[Floats, Floats, Floats]:
        moved = np.concatenate([x[None], x + MORE * np.eye(x.shape[1])[:, None]])
        cost, _, pull, normal = found(moved, which)
        return cost, pull, normal

    def cost_alone(x: Floats, which: Which) -> tuple[Floats, Floats]:
        cost, gains, _, _ = found(x[None], which)
        return cost, gains

    return whole, cost_alone


def identify_second_order(
    time: Floats,
    signal: Floats,
    output: Floats,
    *,
    start: SecondOrders | None = None,
    offset: bool = True,
) -> SecondOrders:
    """Fit a second-order system to each record.

    Args:
        time: Even, s, shape (N,).
        signal, output: Shapes (..., N) that broadcast; at rest at an input of 0 before the first
            sample.
        start: Systems near those that are looked for, of a shape that broadcasts to that of the
            records; NaN, or None, where none is known: there a grid is searched for one.
        offset: Whether the output may have any. Without, this is `fit_ludwick` of power 1, which
            refuses no frequency.

    Returns:
        SecondOrders: NaN where the frequency leaves what the record can tell, as `identify` refuses
            it: below a tenth of one by its length, or above what its samples follow.
    """
    shape = np.broadcast_shapes(signal.shape, output.shape)
    u, y = (np.broadcast_to(x, shape).reshape(-1, shape[-1]) for x in (signal, output))
    period, duration = float(time[1] - time[0]), float(time[-1] - time[0])
    u_scale, y_scale = np.abs(u).max(axis=1), np.ptp(y, axis=1)
    u, y = u / u_scale[:, None], y / y_scale[:, None]
    y -= offset * y.mean(axis=1, keepdims=True)

    def made(every: int) -> Fit:
        return _squares(
            True,
            u[:, ::every],
            y[:, ::every],
            lambda x: _second_orders(every * period, np.exp(x[..., 0]), np.exp(x[..., 1])),
            offset=offset,
        )

    squares, alone = made(1)
    band = (0.1 / duration, np.pi / period)
    if start is None:
        x = np.full((len(u), 2), np.nan)
    else:
        known = np.stack([start.natural_frequency, start.damping_ratio], axis=-1)
        x = np.broadcast_to(np.log(known), (*shape[:-1], 2)).reshape(-1, 2).copy()
    grid = np.stack(
        np.meshgrid(np.log(np.geomspace(*band, FREQUENCIES)), np.log(START_DAMPING)), axis=-1
    ).reshape(-1, 2)
    lost = np.flatnonzero(np.isnan(x).any(axis=1))
    if lost.size:
        roughly = made(COARSE)[1]
        costs = [roughly(np.broadcast_to(one, (lost.size, 2)), lost)[0] for one in grid]
        x[lost] = grid[np.argmin(costs, axis=0)]
    x = fit(squares, x)
    w, z = np.exp(x).T
    gain = alone(x, np.arange(len(u)))[1]
    told = (w > 1.01 * band[0]) & (w < band[1] / 1.01) | (not offset)
    found = (np.where(told, x, np.nan) for x in (w, z, gain * y_scale / u_scale))
    return SecondOrders(*(values.reshape(shape[:-1]) for values in found))


def fit_ludwick(
    time: Floats, pressure: Floats, angle: Floats, power: float, force_per_pressure: float
) -> LudwickFinger:
    """Fit mass, damping and stiffness of Eq. (5.16) to each record; arguments as above.

    Args:
        time, pressure, angle: s, Pa and rad, shapes (N,), (records, N), (records, N).
        power: n, to hold; 1 for the linear model.
        force_per_pressure: F over P, N/Pa.
    """
    duration, period = time[-1] - time[0], float(time[1] - time[0])

    def systems(x: Floats) -> Floats:
        mass, damping, stiffness = np.moveaxis(np.exp(np.clip(x, -FARTHEST, FARTHEST)), -1, 0)
        return _fingers(period, mass, damping, stiffness, power)

    # A finger too stiff for the step runs away: that it is far off says that it is a bad guess.
    squares, alone = _squares(False, pressure, angle, systems)
    tail = slice(-max(1, time.size // 10), None)
    # A finger that does not bend has no stiffness to begin with.
    end = np.maximum(angle[:, tail].mean(axis=1), LEAST_ANGLE)
    push = np.maximum(pressure[:, tail].mean(axis=1), LEAST_PRESSURE)
    stiffness = push / end**power

    frequency, ratio = np.meshgrid(
        np.geomspace(1 / duration, 0.3 / period, 10), START_DAMPING, indexing="ij"
    )
    mass = power * stiffness * end ** (power - 1) / frequency.reshape(-1, 1) ** 2
    damping = 2 * (ratio * frequency).reshape(-1, 1) * mass
    starts = np.log([mass, damping, np.broadcast_to(stiffness, mass.shape)]).transpose(1, 2, 0)
    everyone = np.arange(len(angle))
    costs = [alone(one, everyone)[0] for one in starts]
    start = starts[np.argmin(costs, axis=0), everyone]
    mass, damping, spring = np.exp(fit(squares, start)).T * force_per_pressure
    return LudwickFinger(mass, damping, spring, power)
