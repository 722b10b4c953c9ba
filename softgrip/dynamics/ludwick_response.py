"""The angle that a sampled pressure makes on a finger after Ludwick's law, Eq. (5.16)."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.dynamics.integrate import rk4
from softgrip.dynamics.ludwick import LudwickFinger, derivative
from softgrip.errors import InvalidInputError

LARGEST_STEP = 0.025
"""Of the integration, s."""


def pressure_response(
    finger: LudwickFinger, time: ArrayLike, pressure: ArrayLike, *, force_per_pressure: float
) -> Floats:
    """Return the angle that a measured pressure makes, from rest at angle zero.

    Eq. (5.16) with ``F = force_per_pressure * P`` is integrated by the classical Runge-Kutta
    method. Between samples the pressure runs straight; steps end at the samples if these are even.

    Parameters
    ----------
    finger
        One finger, or several as arrays of shape (runs,).
    time
        Increasing, s, shape (N,), N >= 2.
    pressure
        Gauge, Pa, shape (N,), for all fingers.
    force_per_pressure
        F over P, N/Pa.

    Returns
    -------
    ndarray
        rad, shape (N,), or (runs, N) for several fingers.

    Raises
    ------
    InvalidInputError
        If time or pressure is not as said.

    Examples
    --------
    >>> t = np.linspace(0, 20, 801)
    >>> finger = LudwickFinger(0.1, 0.3, 0.2, 2.5)
    >>> angle = pressure_response(finger, t, 0 * t + 1e4, force_per_pressure=2e-5)
    >>> round(float(angle[-1]), 3)  # at rest K_n theta**n = F
    1.0
    """
    t, p = np.asarray(time, dtype=np.float64), np.asarray(pressure, dtype=np.float64)
    if t.ndim != 1 or t.size < 2 or p.shape != t.shape or not (np.diff(t) > 0).all():
        raise InvalidInputError(
            "time, pressure",
            expected="two arrays of one shape (N,), N >= 2, time rising",
            got=(t.shape, p.shape),
        )
    mass = np.asarray(finger.mass, dtype=np.float64)
    push = force_per_pressure / mass
    still = derivative(finger, 0.0)

    def law(now: float, state: Floats, slope: Floats) -> None:
        still(now, state, slope)
        slope[1] += push * np.interp(now, t, p)

    step = min(float(np.diff(t).min()), LARGEST_STEP)
    angle = rk4(law, np.zeros((2, max(mass.size, 1))), t, step, keep=(0,))[:, 0]
    return np.asarray(angle[:, 0] if mass.ndim == 0 else angle.T)
