"""The identifications of Chapters 3 to 6, for a batch of records at once.

Each is `dynamics.identify.identify` or `dynamics.ludwick_fit.fit_finger` without intervals: the
same model, the same squares, the same grid of starts, and so the same minimum.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats
from softgrip.dynamics.identify import START_DAMPING
from softgrip.dynamics.integrate import rk4
from softgrip.dynamics.ludwick import LudwickFinger, derivative
from softgrip.dynamics.second_order import free_motion
from softgrip.twin.least_squares import Which, fit

FREQUENCIES = 12
"""Of the starts of `identify_second_order`, as of `identify`."""
FARTHEST = 60.0
"""Size of a logarithm of mass, damping or stiffness beyond which nothing changes any more."""
LEAST_ANGLE, LEAST_PRESSURE = 1e-3, 1.0
"""rad and Pa."""


@dataclass(frozen=True)
class SecondOrders:
    """Second-order systems, each of shape (records,): rad/s, dimensionless, output by input."""

    natural_frequency: Floats
    damping_ratio: Floats
    gain: Floats


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
    w, z = natural_frequency, damping_ratio
    c, s = free_motion(period, w, z)
    yy, yr, ry, rr = c + z * w * s, s, -w * w * s, c - z * w * s
    u = np.ascontiguousarray(signal.T)
    slope, lag = np.diff(u, axis=0) / period, 2 * z / w
    # What deviates from the exact solution of a ramp moves freely.
    level = u[:-1] - lag * slope
    angle = np.zeros_like(u)
    y, rate = np.zeros(len(w)), np.zeros(len(w))
    for k, (m, at) in enumerate(zip(slope, level, strict=True)):
        dy, dr = y - at, rate - m
        y = at + m * period + yy * dy + yr * dr
        rate = m + ry * dy + rr * dr
        angle[k + 1] = y
    return angle.T


def identify_second_order(time: Floats, signal: Floats, output: Floats) -> SecondOrders:
    """Fit a second-order system with an offset to each record.

    Args:
        time: Even, s, shape (N,).
        signal, output: Shape (records, N); at rest at an input of 0 before the first sample.

    Returns:
        SecondOrders: NaN where the frequency leaves what the record can tell, as `identify` refuses
            it: below a tenth of one by its length, or above what its samples follow.
    """
    period, duration = float(time[1] - time[0]), float(time[-1] - time[0])
    u_scale, y_scale = np.abs(signal).max(axis=1), np.ptp(output, axis=1)
    u, y = signal / u_scale[:, None], output / y_scale[:, None]

    def residual(x: Floats, which: Which) -> Floats:
        unit = second_order_responses(u[which], period, np.exp(x[:, 0]), np.exp(x[:, 1]))
        # Gain and offset of least squares follow from the rest.
        level, other = unit.mean(axis=1, keepdims=True), y[which].mean(axis=1, keepdims=True)
        off, wanted = unit - level, y[which] - other
        gain = np.sum(off * wanted, axis=1) / np.maximum(np.sum(off**2, axis=1), 1e-300)
        return np.asarray(gain[:, None] * off - wanted)

    band = (0.1 / duration, np.pi / period)
    grid = np.stack(
        np.meshgrid(np.log(np.geomspace(*band, FREQUENCIES)), np.log(START_DAMPING)), axis=-1
    ).reshape(-1, 2)
    everyone = np.tile(np.arange(len(u)), len(grid))
    costs = np.sum(residual(np.repeat(grid, len(u), axis=0), everyone) ** 2, axis=1)
    found = fit(residual, grid[np.argmin(costs.reshape(len(grid), -1), axis=0)])
    w, z = np.exp(found).T
    unit = second_order_responses(u, period, w, z)
    off = unit - unit.mean(axis=1, keepdims=True)
    gain = np.sum(off * y, axis=1) / np.sum(off**2, axis=1)
    told = (w > 1.01 * band[0]) & (w < band[1] / 1.01)
    return SecondOrders(*(np.where(told, x, np.nan) for x in (w, z, gain * y_scale / u_scale)))


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
    period, begin = float(time[1] - time[0]), float(time[0])
    push = force_per_pressure * np.ascontiguousarray(pressure.T) / np.asarray(finger.mass)
    last = len(push) - 1
    still = derivative(finger, 0.0)

    def law(now: float, state: Floats, slope: Floats) -> None:
        still(now, state, slope)
        place = (now - begin) / period
        k = min(int(place + 1e-9), last - 1)
        slope[1] += push[k] + (place - k) * (push[k + 1] - push[k])

    return np.asarray(rk4(law, np.zeros((2, len(pressure))), time, period, keep=(0,))[:, 0].T)


def fit_ludwick(
    time: Floats, pressure: Floats, angle: Floats, power: float, force_per_pressure: float
) -> LudwickFinger:
    """Fit mass, damping and stiffness of Eq. (5.16) to each record; arguments as above.

    Args:
        time, pressure, angle: s, Pa and rad, shapes (N,), (records, N), (records, N).
        power: n, to hold; 1 for the linear model.
        force_per_pressure: F over P, N/Pa.
    """

    def finger(x: Floats) -> LudwickFinger:
        mass, damping, stiffness = np.exp(np.clip(x.T, -FARTHEST, FARTHEST))
        return LudwickFinger(mass, damping, stiffness, power)

    def residual(x: Floats, which: Which) -> Floats:
        with np.errstate(all="ignore"):
            made = ludwick_responses(finger(x), time, pressure[which])
        # A finger too stiff for the step runs away: any large number says that it is a bad guess.
        return np.nan_to_num(np.clip(made, -1e3, 1e3), nan=1e3) - angle[which]

    tail = slice(-max(1, time.size // 10), None)
    # A finger that does not bend has no stiffness to begin with.
    end = np.maximum(angle[:, tail].mean(axis=1), LEAST_ANGLE)
    push = np.maximum(pressure[:, tail].mean(axis=1), LEAST_PRESSURE)
    stiffness = push / end**power
    duration, period = time[-1] - time[0], float(time[1] - time[0])
    frequency, ratio = np.meshgrid(
        np.geomspace(1 / duration, 0.3 / period, 10), START_DAMPING, indexing="ij"
    )
    mass = power * stiffness * end ** (power - 1) / frequency.reshape(-1, 1) ** 2
    damping = 2 * (ratio * frequency).reshape(-1, 1) * mass
    starts = np.log([mass, damping, np.broadcast_to(stiffness, mass.shape)]).transpose(1, 2, 0)
    everyone = np.tile(np.arange(len(angle)), len(starts))
    costs = np.sum(residual(starts.reshape(-1, 3), everyone) ** 2, axis=1)
    best = np.argmin(costs.reshape(len(starts), -1), axis=0)
    start = starts[best, np.arange(len(angle))]
    mass, damping, spring = np.exp(fit(residual, start)).T * force_per_pressure
    return LudwickFinger(mass, damping, spring, power)
