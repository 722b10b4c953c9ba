"""Second-order system identification: natural frequency, damping ratio and gain from a record."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares
from scipy.stats import t as student

from softgrip.arrays import Floats
from softgrip.dynamics.second_order import Hold, SecondOrder, response
from softgrip.errors import InvalidInputError

LEAST_SAMPLES = 8
START_DAMPING = (0.2, 0.7, 2.0)
LEAST_TURN = 1.0
"""Natural frequency times duration below which nothing is told: a record that short is much like
t^2 whatever the system, and the search ends, up to 0.6, where its error is small and its intervals
are, but half or twice the frequency."""
CONFIDENCE = 0.95
"""Of the interval of an `Estimate`."""


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
        fitted: Output of the fitted system at the samples, rad, shape (N,).
        rms: Root mean square of the residual, rad.
        fit_percent: ``100 (1 - |residual| / |output - mean|)``: 100 is perfect, 0 no better than
            the mean.
    """

    natural_frequency: Estimate
    damping_ratio: Estimate
    gain: Estimate
    offset: Estimate
    fitted: Floats
    rms: float
    fit_percent: float

    @property
    def system(self) -> SecondOrder:
        """The fitted system."""
        return SecondOrder(self.natural_frequency.value, self.damping_ratio.value, self.gain.value)


def identify(
    time: ArrayLike,
    input: ArrayLike,
    output: ArrayLike,
    *,
    initial_input: float | None = None,
    hold: Hold = "linear",
) -> Identified:
    """Fit a second-order system to a measured input and output by least squares.

    The system is simulated with the input as it was sampled, so it need not be a step. It must
    rest before the record starts. Intervals come from the Jacobian and suppose that the errors of
    the output are independent: a drift, or counts coarser than the noise, makes them too narrow.

    Args:
        time: Increasing, s, shape (N,), N >= 8; the steps may differ. Where samples are missing,
            the input goes on as `hold` says: if it did not, no interval tells. Logs are read by
            `softgrip.logs.repeated_steps`, which refuses gaps.
        input: Pressure, Pa, shape (N,), not constant (or other than `initial_input`).
        output: Angle, rad, shape (N,), not constant.
        initial_input: Input before the first sample, Pa; the first sample if None.
        hold: Input between samples: "linear" for a measured one, "zero" for a held command.

    Raises:
        InvalidInputError: If the record does not hold what is asked for above, or does not
            determine the parameters: too short, sampled too slowly, or drowned in noise.

    >>> t = np.arange(0, 5, 0.025)
    >>> angle = response(SecondOrder(2.86, 0.7, 2.4e-5), t, 0 * t + 1e5, initial_pressure=0.0)
    >>> found = identify(t, 0 * t + 1e5, angle + 1e-3 * np.sin(40 * t), initial_input=0.0)
    >>> round(found.natural_frequency.value, 2), round(found.damping_ratio.value, 2)
    (2.86, 0.7)
    """
    t, u, y = _record(time, input, output, initial_input)
    rest = float(u[0]) if initial_input is None else initial_input
    # Dimensionless: an angle in rad by a pressure in Pa would leave columns of 1e5 beside 1.
    u_scale, y_scale = float(np.max(np.abs(u - rest))), float(np.ptp(y))
    u, y, duration = (u - rest) / u_scale, y / y_scale, float(t[-1] - t[0])

    def unit(frequency: float, damping: float) -> Floats:
        system = SecondOrder(frequency, damping)
        return response(system, t, u, initial_pressure=0.0, hold=hold)

    def residual(p: Floats) -> Floats:
        return np.asarray(p[2] * unit(p[0], p[1]) + p[3] - y)

    band = (0.1 / duration, np.pi / float(np.median(np.diff(t))))
    starts = []
    for frequency in np.geomspace(*band, 12):
        for damping in START_DAMPING:
            columns = np.column_stack([unit(frequency, damping), np.ones_like(t)])
            line = np.linalg.lstsq(columns, y, rcond=None)[0]
            start = np.array([frequency, damping, *line])
            starts.append((float(np.sum(residual(start) ** 2)), start))
    best = min(starts, key=lambda found: found[0])[1]
    fit = least_squares(
        residual,
        np.clip(best, [band[0], 0, -np.inf, -np.inf], [band[1], np.inf, np.inf, np.inf]),
        bounds=([band[0], 0, -np.inf, -np.inf], [band[1], np.inf, np.inf, np.inf]),
        x_scale="jac",
        jac="3-point",
        xtol=1e-10,
        ftol=1e-12,
        gtol=1e-12,
    )
    error = _standard_errors(fit.jac, fit.fun)
    frequency, damping, gain = np.abs(fit.x[:3])
    unsure = error[:3] > [frequency, max(damping, 1.0), gain]
    if np.any(unsure) or not LEAST_TURN / duration < frequency < band[1] / 1.01:
        raise InvalidInputError(
            "time, input, output",
            expected="a record that determines the parameters: long against 1 / omega_n, sampled "
            "faster than it, the response above the noise",
            got=f"omega_n = {frequency:.3g} +- {error[0]:.2g} rad/s, zeta = {damping:.3g} +- "
            f"{error[1]:.2g} from {t.size} samples over {duration:.3g} s",
        )
    scale = np.array([1.0, 1.0, y_scale / u_scale, y_scale])
    margin = student.ppf((1 + CONFIDENCE) / 2, t.size - 4) * error * scale
    values = fit.x * scale
    w, z, k, offset = (
        Estimate(float(v), float(e), float(v - m), float(v + m))
        for v, e, m in zip(values, error * scale, margin, strict=True)
    )
    rms = float(np.sqrt(np.mean(fit.fun**2)))
    fit_percent = 100 * (1 - rms / float(np.std(y)))
    return Identified(w, z, k, offset, (y + fit.fun) * y_scale, rms * y_scale, fit_percent)


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
    t, u, y = (np.asarray(values, dtype=np.float64) for values in (time, input, output))
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
