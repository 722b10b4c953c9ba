"""Identification of Eq. (5.16): mass and damping, and where asked stiffness and power."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares
from scipy.special import stdtrit

from softgrip.arrays import Floats, check_positive, floats
from softgrip.checks import takes_numbers
from softgrip.dynamics.identify import CONFIDENCE, LEAST_SAMPLES, Estimate
from softgrip.dynamics.ludwick import LudwickFinger, pressure_response
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class FittedFinger:
    """A finger after Ludwick's law, or with n = 1 after Hooke's, fitted to a record.

    Attributes:
        mass, damping, stiffness, fractional_power: As in `LudwickFinger`, with 95 % intervals;
            those of a given number have no width.
        force_per_pressure: F over P that was supposed, N/Pa. Mass, damping and stiffness are
            proportional to it: a record of pressure and angle tells their ratios alone.
        fitted: Angle of the fitted finger at the samples, rad, shape (N,).
        rms: Root mean square of the residual, rad.
        fit_percent: ``100 (1 - |residual| / |angle - mean|)``, the fit of MATLAB's ``compare``.
    """

    mass: Estimate
    damping: Estimate
    stiffness: Estimate
    fractional_power: Estimate
    force_per_pressure: float
    fitted: Floats
    rms: float
    fit_percent: float

    @property
    def finger(self) -> LudwickFinger:
        """The fitted finger."""
        return LudwickFinger(
            self.mass.value, self.damping.value, self.stiffness.value, self.fractional_power.value
        )

    def response(self, time: ArrayLike, pressure: ArrayLike) -> Floats:
        """Return the angle, rad, that another pressure (Pa) makes; see `pressure_response`."""
        return pressure_response(
            self.finger, time, pressure, force_per_pressure=self.force_per_pressure
        )


LEAST = np.array([0.0, 0.0, 0.0, 1.0])
"""Least mass, damping, stiffness and power; what is fitted is the logarithm of what is above."""


@takes_numbers
def fit_finger(
    time: ArrayLike,
    pressure: ArrayLike,
    angle: ArrayLike,
    *,
    force_per_pressure: float,
    fractional_power: float | None,
    stiffness: float | None = None,
) -> FittedFinger:
    """Fit a finger to a record, or to the mean of several, by least squares of the angle.

    The finger rests at angle zero before the record. Intervals come from the Jacobian and suppose
    independent errors of the angle: where the model itself is wrong they are too narrow.

    Args:
        time: Increasing, s, shape (N,), N >= 8, with no gap in which the pressure changes.
        pressure: Gauge, Pa, shape (N,), not zero at the end; a straight line between samples.
        angle: rad, shape (N,), above zero at the end.
        force_per_pressure: F over P, N/Pa, > 0.
        fractional_power: n, >= 1, to hold (1 for the linear model of Eq. (5.17)); None to fit it.
        stiffness: K_n, N, > 0, to hold; None to fit it.

    Raises:
        InvalidInputError: If the record is not as said, or does not determine the parameters.

    >>> t = np.arange(0, 6, 0.05)
    >>> p = 1e4 * np.minimum(1, 2 * t)
    >>> true = LudwickFinger(0.1, 0.3, 0.2, 2.5)
    >>> y = pressure_response(true, t, p, force_per_pressure=2e-5) + 1e-3 * np.sin(40 * t)
    >>> found = fit_finger(t, p, y, force_per_pressure=2e-5, fractional_power=2.5)
    >>> round(found.mass.value, 3), round(found.damping.value, 3), round(found.stiffness.value, 3)
    (0.1, 0.3, 0.2)
    """
    t, p, y = _record(time, pressure, angle)
    check_positive(force_per_pressure=force_per_pressure)
    given = np.array(
        [np.nan, np.nan, *(np.nan if v is None else v for v in (stiffness, fractional_power))]
    )
    free = np.isnan(given)
    # Dimensionless: force by the largest one, angle by its range.
    scale = np.array([force_per_pressure] * 3 + [1.0])

    def values(x: Floats) -> Floats:
        """Return all parameters, shape (4, runs), for the free ones' logarithms (free, runs)."""
        held = (given / scale)[:, None]
        found = np.repeat(held, x.shape[1], axis=1)
        found[free] = LEAST[free, None] + np.exp(x)
        return found

    def angles(x: Floats) -> Floats:
        """Return the angles at the samples, shape (runs, N)."""
        with np.errstate(all="ignore"):
            made = pressure_response(LudwickFinger(*values(x)), t, p, force_per_pressure=1.0)
        # A finger too stiff for the step runs away: any large number says that it is a bad guess.
        return np.nan_to_num(np.clip(made, -1e3, 1e3), nan=1e3)

    @lru_cache(maxsize=1)
    def around(*x: float) -> tuple[Floats, Floats]:
        """Return the angles at the samples, and their slopes: side by side they take as long."""
        step, none = 1e-5, np.zeros((len(x), 1))
        shifts = np.concatenate([none, np.eye(len(x)), -np.eye(len(x))], axis=1) * step
        made, more, less = np.split(angles(np.array(x)[:, None] + shifts), [1, 1 + len(x)])
        return made[0], (more - less).T / (2 * step)

    starts = _starts(t, p, y, given / scale)[free]
    tried = ((angles(np.log(starts - LEAST[free, None])) - y) ** 2).sum(axis=1)
    best = np.log(starts[:, int(np.argmin(tried))] - LEAST[free])
    fit = least_squares(
        lambda x: around(*x)[0] - y,
        best,
        jac=lambda x: around(*x)[1],
        xtol=1e-9,
        ftol=1e-12,
        gtol=1e-12,
    )
    variance = float(fit.fun @ fit.fun) / (t.size - fit.x.size)
    norm = np.linalg.norm(fit.jac, axis=0)
    if not norm.all() or np.linalg.cond(fit.jac / norm) > 1e8:
        error = np.full(fit.x.size, np.inf)
    else:
        error = np.sqrt(variance * np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
    if (error > 1).any():
        raise InvalidInputError(
            "time, pressure, angle",
            expected="a record that determines the parameters",
            got=f"relative errors of {error.round(2).tolist()} from {t.size} samples",
        )
    relative = np.zeros(4)
    relative[free] = error
    margin = np.exp(stdtrit(t.size - fit.x.size, (1 + CONFIDENCE) / 2) * relative)
    above = values(fit.x[:, None])[:, 0] - LEAST
    columns = (LEAST + above, above * relative, LEAST + above / margin, LEAST + above * margin)
    mass, damping, spring, power = (
        Estimate(*(float(v) for v in row)) for row in np.transpose(columns) * scale[:, None]
    )
    rms = float(np.sqrt(np.mean(fit.fun**2)))
    return FittedFinger(
        mass,
        damping,
        spring,
        power,
        force_per_pressure,
        fitted=y + fit.fun,
        rms=rms,
        fit_percent=100 * (1 - rms / float(np.std(y))),
    )


def _starts(t: Floats, p: Floats, y: Floats, given: Floats) -> Floats:
    """Return guesses, shape (4, guesses), for a unit force by pressure.

    The stiffness is that which holds the end of the record; mass and damping follow from
    frequencies and damping ratios of small motions there.
    """
    tail = slice(-max(1, t.size // 10), None)
    end, push = float(y[tail].mean()), float(p[tail].mean())
    n = 1.5 if np.isnan(given[3]) else given[3]
    k = push / end**n if np.isnan(given[2]) else given[2]
    duration, period = t[-1] - t[0], float(np.median(np.diff(t)))
    frequency, ratio = np.meshgrid(
        np.geomspace(1 / duration, 0.3 / period, 10), (0.2, 0.7, 2.0), indexing="ij"
    )
    mass = n * k * end ** (n - 1) / frequency.ravel() ** 2
    damping = 2 * ratio.ravel() * frequency.ravel() * mass
    return np.stack([mass, damping, np.full_like(mass, k), np.full_like(mass, n)])


def _record(
    time: ArrayLike, pressure: ArrayLike, angle: ArrayLike
) -> tuple[Floats, Floats, Floats]:
    t, p, y = floats(time=time, pressure=pressure, angle=angle)
    good = t.ndim == 1 and t.shape == p.shape == y.shape and t.size >= LEAST_SAMPLES
    if not (good and np.isfinite([t, p, y]).all() and (np.diff(t) > 0).all()):
        raise InvalidInputError(
            "time, pressure, angle",
            expected=f"three finite arrays (N,), N >= {LEAST_SAMPLES}, time rising",
            got=(t.shape, p.shape, y.shape),
        )
    tail = slice(-max(1, t.size // 10), None)
    if not (p[tail].mean() > 0 and y[tail].mean() > 0 and np.ptp(y) > 0):
        raise InvalidInputError(
            "pressure, angle",
            expected="means above zero over the last tenth, and an angle that moves",
            got=(float(p[tail].mean()), float(y[tail].mean())),
        )
    return t, p, y
