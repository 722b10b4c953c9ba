"""A measured step response as that of one lag, or of two, after a dead time."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from softgrip.arrays import Floats
from softgrip.checks import record, takes_numbers
from softgrip.dynamics.scatter import dependence
from softgrip.dynamics.second_order import step_response
from softgrip.errors import InvalidInputError, UnknownNameError

CONFIDENCE = 0.95
LEAST = 8
"""Samples that a fit of six numbers needs."""
STARTS = 12
"""Dead times, and time constants, from which a fit starts, each."""
DAMPING = (0.4, 0.8, 1.5)
LEAST_DAMPING, MOST_DAMPING = 0.05, 5.0
"""At the largest one lag is a hundredth of the other: no record tells it from none."""
THINNED, EVALUATIONS = 500, 60
"""Samples that starts are compared by, and steps of a fit at most."""

Shape = Callable[[Floats, Floats], Floats]
"""From time since the end of the dead time and parameters to a response from 0 to 1."""


@dataclass(frozen=True)
class StepFit:
    """A process fitted to a step response.

    Attributes:
        name: Of the process.
        tangent: Delay, s, slope, per s, and rise of the response, of the tangent at its inflexion.
        errors: Their standard errors, with what the residual depends from sample to sample.
        margin: By which a standard error becomes the half of a 95 % interval.
        residual: Fitted less measured, shape (N,).
        parameters: That were fitted.
    """

    name: str
    tangent: Floats
    errors: Floats
    margin: float
    residual: Floats
    parameters: int

    @property
    def criterion(self) -> float:
        """Schwarz's: the process that has less of it is the better one."""
        N = self.residual.size
        least = np.finfo(float).tiny
        return float(
            N * np.log(max(np.mean(self.residual**2), least)) + self.parameters * np.log(N)
        )


def first_order(since: Floats, p: Floats) -> Floats:
    """Return the response of one lag of time constant ``p[0]``, s."""
    return np.asarray(-np.expm1(-since / p[0]))


def second_order(since: Floats, p: Floats) -> Floats:
    """Return the response for a natural period by 2 pi, ``p[0]``, s, and a damping ratio."""
    return step_response(since, 1 / p[0], p[1])


def first_order_tangent(p: Floats) -> tuple[float, float]:
    """Return where the steepest tangent begins, s, and its slope, 1/s, for a rise of 1."""
    return 0.0, float(1 / p[0])


def second_order_tangent(p: Floats) -> tuple[float, float]:
    """Return the same for two lags; they are steepest where the free motion turns."""
    w, z = 1 / p[0], p[1]
    d = np.sqrt(complex(1 - z * z))
    # arccos(z) / sqrt(1 - z^2) is real beyond z = 1 too, and 1 at it.
    at = float(abs(np.arccos(complex(z)) / d)) / w if abs(d) > 1e-6 else 1 / w
    slope = float(w * np.exp(-z * w * at))
    return at - float(step_response(at, w, z)) / slope, slope


PROCESSES: dict[str, tuple[Shape, Callable[[Floats], tuple[float, float]], tuple[float, ...]]] = {
    "first order": (first_order, first_order_tangent, ()),
    "second order": (second_order, second_order_tangent, DAMPING),
}


@takes_numbers
def fit_step(time: Floats, output: Floats, name: str) -> StepFit:
    """Fit a process of `PROCESSES` by least squares.

    Args:
        time: s, 0 at the step, shape (N,), increasing; what is before the step is rest.
        output: Shape (N,).
        name: Of the process.

    Raises:
        InvalidInputError: If the record is not as said, or has fewer samples than `LEAST`.
        UnknownNameError: If there is no such process.
    """
    time, output = record(at_least=LEAST, time=time, output=output)
    if not (np.all(np.diff(time) > 0) and time[-1] > 0 and np.ptp(output) > 0):
        raise InvalidInputError(
            "time, output", expected="times that increase to after the step, a response", got=output
        )
    if name not in PROCESSES:
        raise UnknownNameError("process", name, list(PROCESSES))
    shape, tangent, dampings = PROCESSES[name]
    end, scale = float(time[-1]), float(np.ptp(output))
    y = output / scale

    def unit(p: Floats, t: Floats) -> Floats:
        return shape(np.maximum(t - p[0], 0.0), p[1:])

    @lru_cache(maxsize=4)  # the search moves level and rise alone, too, which need no other
    def whole(*p: float) -> Floats:
        return unit(np.array(p), time)

    def residual(x: Floats) -> Floats:
        return np.asarray(x[-2] + x[-1] * whole(*x[:-2]) - y)

    some = slice(None, None, -(-y.size // THINNED))
    grid = [np.geomspace(1e-3, 1.0, STARTS) * end, *([np.array(dampings)] if dampings else [])]
    dead = np.concatenate([[0.0], np.geomspace(1e-3, 0.5, STARTS) * end])
    tried = np.stack(np.meshgrid(dead, *grid, indexing="ij"), axis=-1).reshape(-1, 1 + len(grid))
    # Level and rise are a line, which explains the square of the correlation.
    moves = np.array([unit(p, time[some]) for p in tried])
    moves -= moves.mean(axis=1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):  # a response that is over at once
        alike = (moves @ (y[some] - y[some].mean())) ** 2 / np.sum(moves**2, axis=1)
    p = tried[int(np.nanargmax(alike))]
    rise, level = np.polyfit(unit(p, time), y, 1)
    best = [*p, level, rise]
    free = [np.inf, np.inf]
    low = [0.0, 1e-5 * end, *([LEAST_DAMPING] if dampings else []), *(-v for v in free)]
    high = [end, 100 * end, *([MOST_DAMPING] if dampings else []), *free]
    fit = scipy.optimize.least_squares(
        residual,
        np.clip(best, low, high),
        bounds=(low, high),
        x_scale="jac",
        xtol=1e-10,
        ftol=1e-10,
        max_nfev=EVALUATIONS,
    )

    def numbers(x: Floats) -> Floats:
        begin, slope = tangent(x[1:-2])
        return np.array([x[0] + begin, x[-1] * slope * scale, x[-1] * scale])

    left = max(y.size - len(best), 1)
    variance = float(fit.fun @ fit.fun) / left * dependence(fit.fun, len(best))
    spread = np.linalg.pinv(fit.jac.T @ fit.jac) * variance
    steps = 1e-6 * np.maximum(np.abs(fit.x), 1e-6)
    slopes = np.column_stack(
        [(numbers(fit.x + h) - numbers(fit.x - h)) / (2 * h.sum()) for h in np.diag(steps)]
    )
    errors = np.sqrt(np.maximum(np.diag(slopes @ spread @ slopes.T), 0.0))
    return StepFit(
        name,
        numbers(fit.x),
        errors,
        float(scipy.special.stdtrit(left, (1 + CONFIDENCE) / 2)),
        np.asarray(fit.fun * scale),
        len(best),
    )


@takes_numbers
def best_step_fit(time: Floats, output: Floats) -> StepFit:
    """Return the process of `PROCESSES` with the least `StepFit.criterion`.

    >>> t = np.arange(-1, 20, 0.05)
    >>> found = best_step_fit(t, 0.3 + 2.0 * first_order(np.maximum(t - 0.5, 0), np.array([3.0])))
    >>> found.name, found.tangent.round(4).tolist()
    ('first order', [0.5, 0.6667, 2.0])
    """
    fits = [fit_step(time, output, name) for name in PROCESSES]
    return min(fits, key=lambda fit: fit.criterion)
