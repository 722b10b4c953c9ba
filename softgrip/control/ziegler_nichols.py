"""Ziegler and Nichols' rule, and the delay and slope of a step response that it starts from."""

import warnings
from dataclasses import dataclass, replace
from typing import Literal, final, get_args

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, check_positive, floats
from softgrip.checks import check_finite, record, takes_numbers
from softgrip.control.pid import Gains
from softgrip.control.step_fit import best_step_fit
from softgrip.dynamics.scatter import leaves_more, scatter
from softgrip.errors import FitWarning, InvalidInputError

Kind = Literal["P", "PI", "PID"]

RULE: dict[Kind, tuple[float, float, float]] = {
    "P": (1.0, np.inf, 0.0),
    "PI": (0.9, 10 / 3, 0.0),
    "PID": (1.2, 2.0, 0.5),
}
"""By kind: kp R L, integral time by L, derivative time by L (Ziegler and Nichols, 1942)."""

FILTER_RATIO = 10.0
"""Derivative time by the time constant of its filter; the rule itself has no filter."""

WINDOWS, AGREE, SHORT = 40, 2.0, 64
"""Lengths that are tried, standard deviations by which two slopes may differ, and samples up to
which a window's sums are taken directly."""

NORMAL = 1.96
"""Standard deviations that are half of a 95 % interval."""

NOTABLE, MISSED = 1e-3, 0.02
"""Shares of the rise: noise from which on a record is taken for a measured one, and what a process
may miss of it."""

NO_DELAY = 0.01
"""Share of the time between samples that is no delay."""


@final
@dataclass(frozen=True)
class ReactionCurve:
    """A tangent to a step response.

    Attributes:
        delay: L, where the tangent meets the level before the step, s after the step, > 0.
        slope: R, slope of the tangent per unit of the step, rad/s per command unit, not 0.
        gain: Rise of the response per unit of the step; infinite for an integrating process.
        delay_interval, slope_interval: Their 95 % intervals, for noise that is independent from
            sample to sample; None for a tangent that was not measured.
        method: What the tangent was laid on.
        warning: Why it is not to be relied on; empty if nothing speaks against it.
    """

    delay: Number
    slope: Number
    gain: Number = np.inf
    delay_interval: tuple[float, float] | None = None
    slope_interval: tuple[float, float] | None = None
    method: str = ""
    warning: str = ""


@takes_numbers
def reaction_curve(
    time: ArrayLike,
    output: ArrayLike,
    *,
    step: float = 1.0,
    step_time: float | None = None,
    window: int | None = None,
) -> ReactionCurve:
    """Lay the tangent at the inflexion of a response that comes to rest.

    Without a window the record says how. A process of one lag or of two, with a dead time, is
    fitted to it (`step_fit`), and the tangent is that process's: it uses all samples, where one
    over a window would take the noise for slope, or a bend for a line. Only where there is next to
    no noise, and no such process fits, it is laid over a window: the longest one whose slope
    differs from those of the shorter ones within it by no more than the noise makes them.

    Args:
        time: s, shape (N,), increasing, even or not.
        output: Response, rad, shape (N,), that comes to rest. What is before the step is its level;
            if nothing is, the first sample, unless a process fits, which finds it.
        step: Height of the step, command unit, not 0.
        step_time: When the step came, on the clock of `time`, s; None for its first sample.
        window: Samples over which a slope is taken, >= 2, for a record without noise, as a model's
            is; it gives no intervals.

    Raises:
        InvalidInputError: If the arrays do not fit each other, the response has not come to rest
            (its mean slope over the last tenth is above 5 % of the steepest), or the tangent gives
            no delay.

    Warns:
        FitWarning: If no process fits a noisy record, or the delay cannot be told from none.

    >>> t = np.arange(0, 30, 0.01)
    >>> model = reaction_curve(t, 1 - np.exp(-t) * (1 + t + t**2 / 2), window=2)
    >>> round(model.delay, 3), round(model.delay * model.slope, 3)
    (0.805, 0.218)
    >>> noise = np.random.default_rng(0).normal(0, 0.02, t.size)
    >>> lag = reaction_curve(t, 1 - np.exp(-np.maximum(t - 6.0, 0) / 3.0) + noise, step_time=5.0)
    >>> round(lag.delay, 2), round(lag.slope, 2)
    (1.0, 0.33)
    """
    t, y, level, noise = _record(time, output, step, step_time, max(window or 2, 10))
    if window is not None and window < 2:
        raise InvalidInputError("window", expected="an integer >= 2, or None", got=window)
    tail = slice(-max(t.size // 10, 2), None)
    end = _line(t[tail], y[tail])
    if window is not None:
        after = t >= 0
        found = _tangent(t[after], y[after], level, window, float(y[-1]), None)
    else:
        found = _judged(t, y, level, noise, end[1] + end[2] * float(t[-1] - end[0]))
    if not abs(end[2]) <= 0.05 * abs(found.slope):
        raise InvalidInputError(
            "output",
            expected="a response that comes to rest; for one that goes on rising use "
            "integrating_reaction_curve, for a short record go on measuring",
            got=f"a slope at the end of {end[2]:.3g} rad/s",
        )
    return _curve(found, step)


def _judged(t: Floats, y: Floats, level: float, noise: float, rest: float) -> ReactionCurve:
    """Return the tangent of a process, or of a window where there is next to no noise."""
    fit, rise = best_step_fit(t, y), abs(rest - level)
    if noise < NOTABLE * rise and leaves_more(fit.residual, noise, fit.parameters):
        after = t >= 0
        window = _window(t[after], y[after], noise, rest - level)
        return _tangent(t[after], y[after], level, window, rest, noise)
    delay, slope, gain = fit.tangent.tolist()
    half = fit.margin * fit.errors
    missed = max(float(np.mean(fit.residual**2)) - noise**2, 0.0) ** 0.5
    warning = (
        f"no process of one lag or two with a dead time fits: it misses the response by "
        f"{missed / rise:.1%} of its rise, beyond the noise of {noise / rise:.1%}"
        if missed > MISSED * rise
        else ""
    )
    if delay < NO_DELAY * float(np.median(np.diff(t))):
        delay = 0.0
    about = _about(delay, half[0]), _about(slope, half[1])
    return ReactionCurve(delay, slope, gain, *about, f"{fit.name} with dead time", warning)


def _window(t: Floats, y: Floats, noise: float, rise: float) -> int:
    """Return the longest window whose steepest slope the shorter ones in its middle agree with.

    O. V. Lepskii, "On a problem of adaptive estimation in Gaussian white noise", Theory of
    Probability and its Applications 35 (1990) 454-466.
    """
    sizes = np.unique(np.geomspace(2, max(t.size // 3, 2), WINDOWS).astype(int))
    lines = [_lines(t, y, int(size)) for size in sizes]
    for k in range(len(sizes) - 1, 0, -1):
        middle, _, slopes, spread = lines[k]
        at = int(np.argmax(slopes * np.sign(rise)))
        agree = True
        for shorter, _, others, errors in lines[:k]:
            near = int(np.argmin(np.abs(shorter - middle[at])))
            allowed = AGREE * noise * np.hypot(errors[near], spread[at])
            agree &= bool(abs(others[near] - slopes[at]) <= allowed)
        if agree:
            return int(sizes[k])
    return 2


def _tangent(
    t: Floats, y: Floats, level: float, window: int, rest: float, noise: float | None
) -> ReactionCurve:
    middle, mean, slopes, spread = _lines(t, y, window)
    at = int(np.argmax(slopes * np.sign(rest - level)))
    slope, up = float(slopes[at]), float(mean[at] - level)
    delay = float(middle[at]) - up / slope
    method = f"tangent over {window} samples"
    if noise is None:
        return ReactionCurve(delay, slope, rest - level, method=method)
    error = noise * float(spread[at])
    late = float(np.hypot(noise / window**0.5 / slope, up / slope**2 * error))
    # What a longer window takes for the slope may be off by what it was allowed to differ by.
    half = NORMAL + AGREE
    about = _about(delay, half * late), _about(slope, half * error)
    return ReactionCurve(delay, slope, rest - level, *about, method)


@takes_numbers
def integrating_reaction_curve(
    time: ArrayLike,
    output: ArrayLike,
    *,
    step: float = 1.0,
    step_time: float | None = None,
    tail: float = 0.25,
) -> ReactionCurve:
    """Lay the asymptote on the step response of a process that integrates, as pump and finger do.

    Such a response has no level to come to: it ends in a ramp, whose slope is R and whose meeting
    with the level before the step is L. For Eq. (4.15) L is ``2 zeta / omega_n``.

    Args:
        time, output, step, step_time: As for `reaction_curve`; the level is the mean of what is
            before the step, or the first sample.
        tail: Share of the record after the step, at its end, that is taken as the ramp, 0 to 1.

    Raises:
        InvalidInputError: If the arrays do not fit, the slopes of the two halves of the end differ
            by more than 5 %, or the asymptote gives no delay.

    Warns:
        FitWarning: If the delay cannot be told from none.

    >>> t = np.arange(0, 5, 0.01)
    >>> curve = integrating_reaction_curve(t, 3.0 * np.maximum(t - 0.4, 0), step=2.0)
    >>> round(curve.delay, 6), round(curve.slope, 6)
    (0.4, 1.5)
    """
    t, y, level, noise = _record(time, output, step, step_time, 10)
    before = max(int(np.count_nonzero(t < 0)), 1)
    last = t >= t[-1] * (1 - tail)
    if not 0 < tail <= 1 or np.count_nonzero(last) < 6:
        raise InvalidInputError(
            "tail", expected="a share in (0, 1] with at least 6 samples", got=tail
        )
    t, y = t[last], y[last]
    middle, mean, slope, spread = _line(t, y)
    half = t.size // 2
    halves = _line(t[:half], y[:half])[2], _line(t[half:], y[half:])[2]
    if not abs(halves[0] - halves[1]) <= 0.05 * abs(slope):
        raise InvalidInputError(
            "output",
            expected="a response that ends in a straight ramp",
            got=f"slopes of {halves[0]:.3g} and {halves[1]:.3g} rad/s in the halves of its end",
        )
    up, error = mean - level, noise * spread
    late = np.hypot(noise * (1 / t.size + 1 / before) ** 0.5 / slope, up / slope**2 * error)
    delay = middle - up / slope
    about = _about(delay, NORMAL * late), _about(slope, NORMAL * error)
    return _curve(ReactionCurve(delay, slope, np.inf, *about, "asymptote"), step)


def _about(value: float, half: float) -> tuple[float, float]:
    return float(value - half), float(value + half)


def _curve(found: ReactionCurve, step: float) -> ReactionCurve:
    """Return a tangent to a response as that per unit of the step, if it has a delay."""
    if not found.delay > 0:
        raise InvalidInputError(
            "output",
            expected="a tangent that meets the first level after the step: one lag without a dead "
            "time has none, and Ziegler and Nichols' rule no gains for it",
            got=f"a delay of {found.delay:.3g} s",
        )
    warning, delays = found.warning, found.delay_interval
    if delays is not None and delays[0] <= 0 and not warning:
        warning = (
            f"the delay, {found.delay:.3g} s (95 %: {delays[0]:.3g} to {delays[1]:.3g} s), cannot "
            "be told from none, and the gains of Ziegler and Nichols' rule rest on it"
        )
    if warning:
        warnings.warn(warning, FitWarning, stacklevel=4)
    slopes = found.slope_interval
    if slopes is not None:
        low, high = sorted(slope / step for slope in slopes)
        slopes = (low, high)
    return replace(
        found,
        slope=found.slope / step,
        gain=found.gain / step if np.isfinite(found.gain) else np.inf,
        slope_interval=slopes,
        warning=warning,
    )


def _lines(t: Floats, y: Floats, window: int) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the lines through each window: mean time, mean output, slope, error of the slope.

    The error is for noise of 1. Sums over windows would lose digits in differences of running sums
    where a window is short; where it is long, blocks of windows would not fit into memory.
    """
    if window <= SHORT:
        tt, yy = sliding_window_view(t, window), sliding_window_view(y, window)
        middle, level = tt.mean(axis=-1), yy.mean(axis=-1)
        dt, dy = tt - middle[:, None], yy - level[:, None]
        square = np.sum(dt * dt, axis=-1)
        return middle, level, np.sum(dt * dy, axis=-1) / square, square**-0.5
    sums = [np.concatenate([[0.0], np.cumsum(x)]) for x in (t, y, t * t, t * y)]
    middle, level, tt, ty = ((s[window:] - s[:-window]) / window for s in sums)
    square = tt - middle**2
    return middle, level, (ty - middle * level) / square, (window * square) ** -0.5


def _line(t: Floats, y: Floats) -> tuple[float, float, float, float]:
    middle, level = float(t.mean()), float(y.mean())
    square = float(np.sum((t - middle) ** 2))
    slope = float(np.sum((t - middle) * (y - level))) / square
    return middle, level, slope, square**-0.5


def _record(
    time: ArrayLike, output: ArrayLike, step: float, step_time: float | None, least: int
) -> tuple[Floats, Floats, float, float]:
    """Return time since the step, output, its level before the step, and its scatter."""
    t, y = record(at_least=least, time=time, output=output)
    if not (np.all(np.diff(t) > 0) and np.ptp(y) > 0):
        raise InvalidInputError(
            "time, output", expected="increasing times, a response", got=(time, output)
        )
    if not np.isfinite(step) or step == 0:
        raise InvalidInputError("step", expected="a finite number other than 0", got=step)
    begin = float(t[0]) if step_time is None else float(step_time)
    if not t[0] <= begin < t[-1] or np.count_nonzero(t >= begin) < least:
        raise InvalidInputError(
            "step_time",
            expected=f"a time in the record, {t[0]:g} to {t[-1]:g} s, with {least} samples after",
            got=step_time,
        )
    rest = y[t < begin]
    return t - begin, y, float(rest.mean()) if rest.size else float(y[0]), scatter(t, y)


@takes_numbers
def ziegler_nichols(
    curve: ReactionCurve, kind: Kind = "PID", *, filter_ratio: float = FILTER_RATIO
) -> Gains:
    """Return the gains of Ziegler and Nichols for a reaction curve.

    Args:
        curve: Delay and slope; the rule uses no other.
        kind: "P", "PI" or "PID".
        filter_ratio: Derivative time by filter time constant, > 0.

    Raises:
        InvalidInputError: If the kind is unknown.

    >>> ziegler_nichols(ReactionCurve(delay=0.5, slope=2.0), filter_ratio=10)
    Gains(kp=1.2, ki=1.2, kd=0.3, derivative_filter=0.025)
    """
    if kind not in get_args(Kind):
        raise InvalidInputError("kind", expected=f"one of {get_args(Kind)}", got=kind)
    check_positive(delay=curve.delay, filter_ratio=filter_ratio)
    check_finite(slope=curve.slope)
    factor, integral, derivative = RULE[kind]
    L, R = (
        array.tolist() if array.ndim == 0 else array
        for array in floats(delay=curve.delay, slope=curve.slope)
    )
    kp = factor / (R * L)
    # A filter is asked for even where no derivative uses it.
    tau = (derivative or RULE["PID"][2]) * L / filter_ratio
    return Gains(kp, kp / (integral * L), kp * derivative * L, tau)
