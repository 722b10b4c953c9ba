"""Second-order system identification: natural frequency, damping ratio and gain from a record."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, floats
from softgrip.checks import takes_numbers
from softgrip.dynamics.scatter import scatter
from softgrip.dynamics.second_order import Hold, SecondOrder, response
from softgrip.errors import FitWarning, InvalidInputError

LEAST_SAMPLES = 8
START_DAMPING = (0.2, 0.7, 2.0)
LEAST_TURN = 1.0
"""Natural frequency times duration below which nothing is told: a record that short is much like
t^2 whatever the system, and the search ends, up to 0.6, where its error is small and its intervals
are, but half or twice the frequency."""
CONFIDENCE = 0.95
"""Of the interval of an `Estimate`."""
DEAD_TIMES, LATEST = 24, 0.5
"""Dead times that are tried, and the share of the record that is the largest."""
NEEDED = 15.0
"""By what a dead time must lower N times the logarithm of the mean square: a chance of 1 in 10 000,
by the chi-square distribution with 1 degree of freedom."""
EXACT = 1e-7
"""Root mean square, as a share of the range, below which nothing is left for a dead time."""
MISSED = 0.02
"""Share of the range that a fit may miss beyond the scatter of the samples."""


@dataclass(frozen=True)
class Estimate:
    """A fitted number with its standard error and 95 % interval, all in one unit."""

    value: float
    standard_error: float
    low: float
    high: float


@dataclass(frozen=True)
class Identified:
    """A second-order system fitted to a record.

    Attributes:
        natural_frequency: omega_n of Eq. (4.13), rad/s.
        damping_ratio: zeta of Eq. (4.13), dimensionless.
        gain: Static gain, rad/Pa (output unit by input unit, when they are others).
        offset: Output at rest before the record, rad.
        dead_time: By which the output comes late, s; 0, with no error, where the record asks for
            none.
        fitted: Output of the fitted system at the samples, rad, shape (N,).
        rms: Root mean square of the residual, rad.
        fit_percent: ``100 (1 - |residual| / |output - mean|)``: 100 is perfect, 0 no better than
            the mean.
        warning: Why it is not to be relied on; empty if nothing speaks against it.
    """

    natural_frequency: Estimate
    damping_ratio: Estimate
    gain: Estimate
    offset: Estimate
    dead_time: Estimate
    fitted: Floats
    rms: float
    fit_percent: float
    warning: str = ""

    @property
    def system(self) -> SecondOrder:
        """The fitted system."""
        return SecondOrder(self.natural_frequency.value, self.damping_ratio.value, self.gain.value)


@takes_numbers
def identify(
    time: ArrayLike,
    input: ArrayLike,
    output: ArrayLike,
    *,
    initial_input: float | None = None,
    hold: Hold = "linear",
    dead_time: float | None = None,
) -> Identified:
    """Fit a second-order system to a measured input and output by least squares.

    The system is simulated with the input as it was sampled, so it need not be a step. It must
    rest before the record starts. A dead time is fitted with it where the record asks for one: left
    out it would make the finger slower than it is. Intervals come from the Jacobian and suppose
    that the errors of the output are independent: a drift, or counts coarser than the noise, makes
    them too narrow.

    Args:
        time: Increasing, s, shape (N,), N >= 8; the steps may differ. Where samples are missing,
            the input goes on as `hold` says: if it did not, no interval tells. Logs are read by
            `softgrip.logs.repeated_steps`, which refuses gaps.
        input: Pressure, Pa, shape (N,), not constant (or other than `initial_input`).
        output: Angle, rad, shape (N,), not constant.
        initial_input: Input before the first sample, Pa; the first sample if None.
        hold: Input between samples: "linear" for a measured one, "zero" for a held command.
        dead_time: s, >= 0, if it is known, as 0 is for Eq. (4.13); None to have it found.

    Raises:
        InvalidInputError: If the record does not hold what is asked for above, or does not
            determine the parameters: too short, sampled too slowly, or drowned in noise.

    Warns:
        FitWarning: If the system misses the output by more than `MISSED` of its range beyond the
            scatter of the samples, or one lag would do as well. It is not given where the dead time
            is: that is a model which was chosen, and `Identified.warning` says it all the same.

    >>> t = np.arange(0, 5, 0.025)
    >>> angle = response(SecondOrder(2.86, 0.7, 2.4e-5), t, 0 * t + 1e5, initial_pressure=0.0)
    >>> found = identify(t, 0 * t + 1e5, angle + 1e-3 * np.sin(40 * t), initial_input=0.0)
    >>> round(found.natural_frequency.value, 2), round(found.damping_ratio.value, 2)
    (2.86, 0.7)
    """
    t, u, y = _record(time, input, output, initial_input)
    if dead_time is not None and not 0 <= dead_time < t[-1] - t[0]:
        raise InvalidInputError(
            "dead_time", expected=f"None, or 0 to {t[-1] - t[0]:g} s", got=dead_time
        )
    rest = float(u[0]) if initial_input is None else initial_input
    # Dimensionless: an angle in rad by a pressure in Pa would leave columns of 1e5 beside 1.
    u_scale, y_scale = float(np.max(np.abs(u - rest))), float(np.ptp(y))
    u, y, duration = (u - rest) / u_scale, y / y_scale, float(t[-1] - t[0])

    @lru_cache(maxsize=8)  # the search moves gain and offset alone, too, which need no other
    def unit(frequency: float, damping: float, late: float = 0.0) -> Floats:
        return _late_response(SecondOrder(frequency, damping), t, u, late, hold)

    known = 0.0 if dead_time is None else dead_time
    band = (0.1 / duration, np.pi / float(np.median(np.diff(t))))
    bounds = np.array([[band[0], 0, -np.inf, -np.inf, 0], [*[np.inf] * 4, LATEST * duration]])
    bounds[1, 0] = band[1]
    plain = _fit(lambda p: p[2] * unit(p[0], p[1], known) + p[3] - y, bounds[:, :4], _start(
        t, y, lambda w, z: unit(w, z, known), band, np.zeros(1)))  # fmt: skip
    fit = plain
    if dead_time is None and np.mean(plain.fun**2) > EXACT**2:
        step = float(np.median(np.diff(t)))
        lates = np.concatenate([[0.0], np.geomspace(step / 2, LATEST * duration, DEAD_TIMES)])
        late = _fit(
            lambda p: p[2] * unit(p[0], p[1], p[4]) + p[3] - y,
            bounds,
            _start(t, y, unit, band, lates),
        )
        if t.size * np.log(np.sum(plain.fun**2) / np.sum(late.fun**2)) > NEEDED:
            fit = late
    count = fit.x.size
    error = _standard_errors(fit.jac, fit.fun)
    frequency, damping, gain = np.abs(fit.x[:3])
    unsure = error[:3] > [frequency, max(damping, 1.0), gain]
    one_lag = f"a first-order process of time constant {2 * damping / frequency:.3g} s fits as well"
    if np.any(unsure) or not LEAST_TURN / duration < frequency < band[1] / 1.01:
        raise InvalidInputError(
            "time, input, output",
            expected="a record that determines the parameters: long against 1 / omega_n, sampled "
            "faster than it, the response above the noise",
            got=f"omega_n = {frequency:.3g} +- {error[0]:.2g} rad/s, zeta = {damping:.3g} +- "
            f"{error[1]:.2g} from {t.size} samples over {duration:.3g} s"
            + (f"; {one_lag}" if damping > 1 else ""),
        )
    scale = np.array([1.0, 1.0, y_scale / u_scale, y_scale, 1.0])[:count]
    margin = scipy.special.stdtrit(t.size - count, (1 + CONFIDENCE) / 2) * error * scale
    values = fit.x * scale
    w, z, k, offset, *found = (
        Estimate(float(v), float(e), float(v - m), float(v + m))
        for v, e, m in zip(values, error * scale, margin, strict=True)
    )
    rms = float(np.sqrt(np.mean(fit.fun**2)))
    missed = max(rms**2 - scatter(t, y) ** 2, 0.0) ** 0.5
    warning = ""
    if missed > MISSED:
        warning = f"the system misses the output by {missed:.1%} of its range, beyond the noise"
    elif damping > 1 and w.low <= 0:
        warning = f"omega_n and zeta cannot be told apart: {one_lag}"
    if warning and dead_time is None:
        warnings.warn(warning, FitWarning, stacklevel=3)
    return Identified(
        w,
        z,
        k,
        offset,
        found[0] if found else Estimate(known, 0.0, known, known),
        (y + fit.fun) * y_scale,
        rms * y_scale,
        100 * (1 - rms / float(np.std(y))),
        warning,
    )


def _late_response(
    system: SecondOrder, time: Floats, input: Floats, late: float, hold: Hold
) -> Floats:
    """Return the response at each time to an input that comes late: that of so much earlier."""
    if late == 0:
        return response(system, time, input, initial_pressure=0.0, hold=hold)
    earlier = np.maximum(time - late, time[0])
    every, at = np.unique(np.concatenate([time, earlier]), return_inverse=True)
    before = np.searchsorted(time, every, side="right") - 1
    held = input[before] if hold == "zero" else np.interp(every, time, input)
    found = response(system, every, held, initial_pressure=0.0, hold=hold)[at[time.size :]]
    # At the first sample itself an input that jumps there has not moved the output yet.
    return np.where(time - late <= time[0], 0.0, found)


def _start(
    t: Floats,
    y: Floats,
    unit: Callable[[float, float], Floats],
    band: tuple[float, float],
    lates: Floats,
) -> Floats:
    """Return the best of a grid of systems and dead times, with their gain and offset."""
    tried, off = [], y - y.mean()
    for frequency in np.geomspace(*band, 12):
        for damping in START_DAMPING:
            moved = unit(frequency, damping)
            for late in lates:
                # Between samples a line does for a start.
                shape = moved if late == 0 else np.interp(t - late, t, moved, left=0.0)
                moves = shape - shape.mean()
                with np.errstate(divide="ignore", invalid="ignore"):  # nothing moves in time
                    alike = (moves @ off) ** 2 / (moves @ moves)
                tried.append((np.nan_to_num(alike), shape, (frequency, damping), late))
    _, shape, system, late = max(tried, key=lambda found: found[0])
    line = np.polyfit(shape, y, 1)
    return np.array([*system, *line, *([late] if lates.size > 1 else [])])


def _fit(residual: Callable[[Floats], Floats], bounds: Floats, start: Floats) -> Any:
    return scipy.optimize.least_squares(
        residual,
        np.clip(start, *bounds),
        bounds=tuple(bounds),
        x_scale="jac",
        jac="3-point",
        xtol=1e-10,
        ftol=1e-12,
        gtol=1e-12,
    )


def _standard_errors(jacobian: Floats, residual: Floats) -> Floats:
    """Return the standard errors of the parameters; infinite where the record tells nothing."""
    variance = np.sum(residual**2) / (residual.size - jacobian.shape[1])
    norm = np.linalg.norm(jacobian, axis=0)
    if not np.all(norm > 0) or np.linalg.cond(jacobian / norm) > 1e8:
        return np.full(jacobian.shape[1], np.inf)
    columns = jacobian / norm
    spread = np.sqrt(variance * np.diag(np.linalg.inv(columns.T @ columns)))
    return np.asarray(spread / norm)


def _record(
    time: ArrayLike, input: ArrayLike, output: ArrayLike, initial_input: float | None
) -> tuple[Floats, Floats, Floats]:
    t, u, y = floats(time=time, input=input, output=output)
    if t.ndim != 1 or t.shape != u.shape or t.shape != y.shape or t.size < LEAST_SAMPLES:
        raise InvalidInputError(
            "time, input, output",
            expected=f"three arrays of one shape (N,) with N >= {LEAST_SAMPLES}",
            got=(t.shape, u.shape, y.shape),
        )
    if not (np.isfinite(t).all() and np.isfinite(u).all() and np.isfinite(y).all()):
        raise InvalidInputError(
            "time, input, output", expected="finite numbers", got="NaN or infinity"
        )
    if not np.all(np.diff(t) > 0):
        raise InvalidInputError(
            "time", expected="increasing values", got=f"a step of {np.diff(t).min():g} s"
        )
    if np.all(u == (u[0] if initial_input is None else initial_input)):
        raise InvalidInputError(
            "input",
            expected="a change: give initial_input if it came before the record",
            got=f"{u[0]:g} throughout",
        )
    if np.ptp(y) == 0:
        raise InvalidInputError("output", expected="a response", got=f"{y[0]:g} throughout")
    return t, u, y
