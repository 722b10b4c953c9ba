"""Transport and response delay of a gripper's fingers, from logs of a step in open loop.

What comes late of a finger's motion has two parts (Section 7.2). The *transport delay* passes from
the command to the pressure in the tube and is the same for all fingers. The *response delay* passes
from there to the first bending, since a chamber expands before it bends, and is each finger's own.

Each is the dead time of a model that is fitted by least squares: of the pressure, a parabola in
what the plunger has swept, less what the fingers take up by bending; of an angle, a second-order
system behind the plunger, as Chapter 6 identifies it. All else is fitted anew for each dead time,
so that the squares that are left are a profile over it, and the interval is where they rise by less
than chance makes of them. What a motor's ramp and the sensors' lags add is in the numbers: they are
a part of what a controller meets.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy

from softgrip.arrays import Floats
from softgrip.checks import takes_numbers
from softgrip.dynamics.scatter import dependence
from softgrip.dynamics.second_order import free_motion
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.fingers import fingers_of
from softgrip.logs.gaps import check_even
from softgrip.logs.repeated_steps import read_alike

CONFIDENCE = 0.95
LATEST = 0.6
"""s: the largest delay that is looked for."""
GRID, FINE = 0.04, 0.002
"""s: steps in which delays are tried, and to which an end of an interval is found."""
STEP = 0.005
"""s: at which the answer of a finger is computed; straight between."""
FREQUENCIES, DAMPING = (0.3, 30.0), (0.1, 5.0)
"""Natural frequencies, rad/s, and damping ratios among which a finger is looked for."""
LEAST_SAMPLES = 12

Left = Callable[[float], Floats]
"""From a dead time to the residual that the best of all else leaves."""


@dataclass(frozen=True)
class Delay:
    """A delay with its 95 % interval, s.

    Attributes:
        value: Where the squares that are left are least.
        low, high: Ends of the interval; 0 and `LATEST` where the record tells nothing.
    """

    value: float
    low: float
    high: float

    @property
    def told(self) -> bool:
        """Whether the interval is within what was looked for, at its upper end at least."""
        return self.high < LATEST - GRID


@dataclass(frozen=True)
class GripperDelays:
    """The delays of a gripper's fingers.

    Attributes:
        whole: From the command to each finger's bending.
        transport: From the command to the pressure; None for a log without a pressure.
        response: From the pressure to each finger's bending, the difference of the two; None where
            the transport is not told. The interval is that of a difference of independent errors.
    """

    whole: tuple[Delay, ...]
    transport: Delay | None
    response: tuple[Delay, ...] | None


@takes_numbers
def bending_delay(time: Floats, motor_angle: Floats, angle: Floats) -> Delay:
    """Return by how much a finger's angle comes later than a finger of second order would have it.

    Args:
        time: s, even, shape (N,), N >= `LEAST_SAMPLES`, beginning at rest.
        motor_angle: What the motor has turned until each time, rad, shape (N,); straight between.
        angle: rad, shape (N,).

    Raises:
        InvalidInputError: If the record has another form, or nothing moves.

    >>> t = np.arange(0, 5, 0.05)
    >>> pushed = np.clip(t, 0, 0.5)
    >>> answer = second_order(t, pushed, 2.0, 0.7, late=0.12)
    >>> round(bending_delay(t, pushed, 0.3 * answer).value, 3)
    0.12
    """
    time, motor_angle, angle = _checked(time, motor_angle, angle)
    bounds = tuple(np.log([FREQUENCIES, DAMPING]).T)
    starts = [np.log([w, z]) for w in (1.5, 4.0) for z in (0.5, 1.2)]
    known: list[Floats] = []

    def residual(x: Floats, late: float) -> Floats:
        w, z = np.exp(x)
        moved = second_order(time, motor_angle, float(w), float(z), late=late)
        return _unexplained(np.column_stack([moved, np.ones_like(moved)]), angle)

    def left(late: float) -> Floats:
        tried = known[-1:] or starts
        found = [
            scipy.optimize.least_squares(
                residual, x, args=(late,), bounds=bounds, max_nfev=40, ftol=1e-6, xtol=1e-6
            )
            for x in tried
        ]
        best = min(found, key=lambda one: float(one.cost))
        known.append(best.x)
        return np.asarray(best.fun)

    return _profiled(left, parameters=5)


@takes_numbers
def pressure_delay(time: Floats, motor_angle: Floats, pressure: Floats, angles: Floats) -> Delay:
    """Return by how much the pressure comes later than what the plunger sweeps.

    Args:
        time, motor_angle: As of `bending_delay`.
        pressure: Gauge, Pa, shape (N,).
        angles: Of all fingers, rad, shape (fingers, N): by bending they take up air.

    A push should last for many samples. With a few only, a delay looks like a line that is bent.
    """
    time, motor_angle, pressure = _checked(time, motor_angle, pressure)
    late_angles = np.atleast_2d(angles)

    def left(late: float) -> Floats:
        swept = np.interp(time - late, time, motor_angle)
        columns = [np.ones_like(time), time, swept, swept**2, *late_angles]
        return _unexplained(np.column_stack(columns), pressure)

    return _profiled(left, parameters=5 + len(late_angles))


def read_delays(paths: Sequence[Path | str]) -> GripperDelays:
    """Return the delays that logs of one step in open loop tell, of the mean of the runs.

    Args:
        paths: Of logs of any rig as `softgrip.logs.reader` reads them: columns ``command``,
            ``angle``, ``angle_2`` and so on, and ``pressure`` where there is one.

    Raises:
        DataFileError: If a log has no such column, or as of `read_alike`.
        InvalidInputError: If nothing moves.
    """
    logs = read_alike(paths)
    for path, log in zip(paths, logs, strict=True):
        if lacking := [name for name in ("command", "angle") if name not in log.columns]:
            raise DataFileError(
                path, expected=f"a column {lacking[0]!r}", got=", ".join(log.columns)
            )
    time = logs[0]["time"]
    period = float((time[-1] - time[0]) / (time.size - 1))
    # A row tells the command that was held until its time.
    motor = period * np.cumsum(np.mean([log["command"] for log in logs], axis=0))
    angles = np.mean([fingers_of(log) for log in logs], axis=0)
    whole = tuple(bending_delay(time, motor, one) for one in angles)
    if not all("pressure" in log.columns for log in logs):
        return GripperDelays(whole, None, None)
    pressure = np.mean([log["pressure"] for log in logs], axis=0)
    transport = pressure_delay(time, motor, pressure, angles)
    if not transport.told:
        return GripperDelays(whole, transport, None)
    return GripperDelays(whole, transport, tuple(_less(one, transport) for one in whole))


def second_order(
    time: Floats, drive: Floats, natural_frequency: float, damping_ratio: float, *, late: float
) -> Floats:
    """Return the answer of a second-order system of unit gain, from rest, after a dead time.

    As `dynamics.second_order.response`, many times a second.

    Args:
        time: s, even, shape (N,).
        drive: Shape (N,), straight between the times, and before the first what it then is.
        natural_frequency, damping_ratio: rad/s and dimensionless, > 0.
        late: s, >= 0.
    """
    parts = max(1, round(float(time[1] - time[0]) / STEP))
    fine = np.linspace(time[0], time[-1], (time.size - 1) * parts + 1)
    w, z = natural_frequency, damping_ratio
    step = float(fine[1] - fine[0])
    c, s = free_motion(step * np.arange(1.0, 4.0), w, z)
    # What is a ramp between the times is met exactly: from the answer to a ramp at three times.
    ramp = step * np.arange(1.0, 4.0) - 2 * z / w + (c + z * w * s) * (2 * z / w) - s
    low = np.array([1.0, -2 * c[0], np.exp(-2 * z * w * step)])
    top = np.convolve(np.convolve(low, [1.0, -2.0, 1.0]), ramp)[:3] / step
    moved = scipy.signal.lfilter(top, low, np.interp(fine, time, drive) - drive[0])
    return np.asarray(np.interp(time - late, fine, moved, left=0.0) + drive[0])


def _checked(time: Floats, motor_angle: Floats, output: Floats) -> tuple[Floats, Floats, Floats]:
    shapes = (time.shape, motor_angle.shape, output.shape)
    if time.ndim != 1 or len(set(shapes)) > 1 or time.size < LEAST_SAMPLES:
        raise InvalidInputError(
            "time, motor_angle, output", expected=f"one shape (N,), N >= {LEAST_SAMPLES}",
            got=shapes,
        )  # fmt: skip
    if not (np.isfinite(output).all() and np.isfinite(motor_angle).all()):
        raise InvalidInputError("motor_angle, output", expected="finite numbers", got=output)
    if not (np.ptp(motor_angle) > 0 and np.ptp(output) > 0):
        raise InvalidInputError("motor_angle, output", expected="a motion", got="none")
    check_even(time)
    return time, motor_angle, output


def _unexplained(columns: Floats, output: Floats) -> Floats:
    scale = np.linalg.norm(columns, axis=0)
    columns = columns / np.where(scale > 0, scale, 1.0)
    return np.asarray(columns @ np.linalg.lstsq(columns, output, rcond=None)[0] - output)


def _profiled(left: Left, *, parameters: int) -> Delay:
    """Return the least of the squares over the delay, and where they rise by less than chance."""
    tried = np.arange(0.0, LATEST + GRID / 2, GRID)
    squares = np.array([float(np.sum(left(late) ** 2)) for late in tried.tolist()])
    k = int(np.argmin(squares))
    found = scipy.optimize.minimize_scalar(
        lambda late: float(np.sum(left(late) ** 2)),
        bounds=(tried[max(k - 1, 0)], tried[min(k + 1, tried.size - 1)]),
        method="bounded",
        options={"xatol": FINE / 2},
    )
    value, least = float(found.x), float(found.fun)
    if squares[k] <= least:
        value, least = float(tried[k]), float(squares[k])
    residual = left(value)
    free = residual.size - parameters
    rise = scipy.special.fdtri(1, free, CONFIDENCE) / free * dependence(residual, parameters)
    inside = squares <= least * (1 + rise) + np.finfo(float).tiny

    def end(inner: float, side: int) -> float:
        place = int(np.searchsorted(tried, inner, side="right" if side > 0 else "left"))
        outer = list(tried[place:]) if side > 0 else list(tried[:place][::-1])
        for late in outer:
            if not inside[round(late / GRID)]:
                return _crossing(left, least * (1 + rise), inner, float(late))
            inner = float(late)
        return float(LATEST if side > 0 else 0.0)

    return Delay(value, end(value, -1), end(value, 1))


def _crossing(left: Left, most: float, inside: float, outside: float) -> float:
    while abs(outside - inside) > FINE:
        middle = (inside + outside) / 2
        if float(np.sum(left(middle) ** 2)) <= most:
            inside = middle
        else:
            outside = middle
    return (inside + outside) / 2


def _less(whole: Delay, part: Delay) -> Delay:
    value = whole.value - part.value
    below = np.hypot(whole.value - whole.low, part.high - part.value)
    above = np.hypot(whole.high - whole.value, part.value - part.low)
    return Delay(value, value - float(below), value + float(above))
