"""The angle that a sampled pressure makes on a second-order finger, exact between the samples."""

from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.dynamics.second_order import SecondOrder, free_motion
from softgrip.errors import InvalidInputError

Hold = Literal["linear", "zero"]


def response(
    system: SecondOrder,
    time: ArrayLike,
    pressure: ArrayLike,
    *,
    initial_pressure: float | None = None,
    hold: Hold = "linear",
) -> Floats:
    """Return the angle that a sampled pressure makes, from rest, exactly between the samples.

    Parameters
    ----------
    system
        The finger.
    time
        Increasing, s, shape (N,), N >= 2; the steps may differ.
    pressure
        Pa, shape (N,) or (runs, N).
    initial_pressure
        Pressure at which the finger rested before the first sample, Pa; the first sample if None.
    hold
        Pressure between samples: "linear" for a measured one, "zero" for a held command.

    Returns
    -------
    ndarray
        Angle, rad, of the shape of `pressure`.

    Raises
    ------
    InvalidInputError
        If the time does not increase, the shapes differ, or `hold` is unknown.

    Examples
    --------
    >>> response(SecondOrder(1.0, 1.0), [0, 1], [1, 1], initial_pressure=0).round(6).tolist()
    [0.0, 0.264241]
    """
    t, p = np.asarray(time, dtype=np.float64), np.asarray(pressure, dtype=np.float64)
    if hold not in get_args(Hold):
        raise InvalidInputError("hold", expected=f"one of {get_args(Hold)}", got=hold)
    if t.ndim != 1 or t.size < 2 or p.shape[-1:] != t.shape:
        raise InvalidInputError(
            "time, pressure", expected="shapes (N,) and (..., N), N >= 2", got=(t.shape, p.shape)
        )
    dt = np.diff(t)
    if not np.all(dt > 0):
        raise InvalidInputError("time", expected="increasing values", got=f"a step of {dt.min():g}")
    w, z = system.natural_frequency, system.damping_ratio
    q = system.gain * np.moveaxis(p, -1, 0)
    slope = np.diff(q, axis=0) / dt.reshape(-1, *([1] * (q.ndim - 1)))
    if hold == "zero":
        slope = np.zeros_like(slope)
    c, s = free_motion(dt, w, z)
    lag = 2 * z / w
    # A ramp has the exact solution q - lag * slope; what deviates from it moves freely.
    angle = np.empty_like(q)
    angle[0] = q[0] if initial_pressure is None else system.gain * initial_pressure
    y: Floats | float
    y, rate = (angle[0], 0 * q[0]) if q.ndim > 1 else (float(angle[0]), 0.0)
    # Floats, not numpy scalars, where there is one run: the loop is then ten times as fast.
    scalar = q.ndim == 1
    rows = (dt, c + z * w * s, s, -w * w * s, c - z * w * s)
    steps = zip(*(r.tolist() for r in rows), strict=True)
    starts, slopes = (q.tolist(), slope.tolist()) if scalar else (q, slope)
    for k, (h, yy, yr, ry, rr) in enumerate(steps):
        m = slopes[k]
        dy, dr = y - starts[k] + lag * m, rate - m
        y = starts[k] + m * h - lag * m + yy * dy + yr * dr
        rate = m + ry * dy + rr * dr
        angle[k + 1] = y
    return np.moveaxis(angle, 0, -1)
