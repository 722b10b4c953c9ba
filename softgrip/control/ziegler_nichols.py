"""Ziegler and Nichols' rule, and the delay and slope of a step response that it starts from."""

from dataclasses import dataclass
from typing import Literal, final, get_args

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, check_positive
from softgrip.checks import record
from softgrip.control.pid import Gains
from softgrip.errors import InvalidInputError

Kind = Literal["P", "PI", "PID"]

RULE: dict[Kind, tuple[float, float, float]] = {
    "P": (1.0, np.inf, 0.0),
    "PI": (0.9, 10 / 3, 0.0),
    "PID": (1.2, 2.0, 0.5),
}
"""By kind: kp R L, integral time by L, derivative time by L (Ziegler and Nichols, 1942)."""

FILTER_RATIO = 10.0
"""Derivative time by the time constant of its filter; the rule itself has no filter."""


@final
@dataclass(frozen=True)
class ReactionCurve:
    """A tangent to a step response.

    Attributes:
        delay: L, where the tangent meets the level before the step, s after the step, > 0.
        slope: R, slope of the tangent per unit of the step, rad/s per command unit, not 0.
        gain: Rise of the response per unit of the step; infinite for an integrating process.
    """

    delay: Number
    slope: Number
    gain: Number = np.inf


def reaction_curve(
    time: ArrayLike, output: ArrayLike, *, step: float = 1.0, window: int = 2
) -> ReactionCurve:
    """Lay the tangent at the inflexion of a response that comes to rest.

    Args:
        time: Time since the step, s, shape (N,), increasing.
        output: Response, rad, shape (N,); the first sample is the level before the step, the last
            the one that it comes to.
        step: Height of the step, command unit, not 0.
        window: Samples over which a slope is taken, >= 2: more for a noisy record.

    Raises:
        InvalidInputError: If the arrays do not fit each other, the response has not come to rest
            (its mean slope over the last tenth is above 5 % of the steepest), or the tangent gives
            no delay.

    >>> t = np.arange(0, 30, 0.01)
    >>> curve = reaction_curve(t, 1 - np.exp(-t) * (1 + t + t**2 / 2))
    >>> round(curve.delay, 3), round(curve.delay * curve.slope, 3)
    (0.805, 0.218)
    """
    t, y = _record(time, output, step, max(window, 10))
    if window < 2:
        raise InvalidInputError("window", expected="an integer >= 2", got=window)
    middle, level, slopes = _lines(t, y, window)
    at = int(np.argmax(slopes * np.sign(y[-1])))
    tail = slice(-max(t.size // 10, 2), None)
    end = _line(t[tail], y[tail])[2]
    if not abs(end) <= 0.05 * abs(slopes[at]):
        raise InvalidInputError(
            "output",
            expected="a response that comes to rest; for one that goes on rising use "
            "integrating_reaction_curve, for a short record go on measuring",
            got=f"a slope at the end of {end:.3g} rad/s",
        )
    delay, slope = float(middle[at] - level[at] / slopes[at]), float(slopes[at] / step)
    return _curve(delay, slope, float(y[-1] / step))


def integrating_reaction_curve(
    time: ArrayLike, output: ArrayLike, *, step: float = 1.0, tail: float = 0.25
) -> ReactionCurve:
    """Lay the asymptote on the step response of a process that integrates, as pump and finger do.

    Such a response has no level to come to: it ends in a ramp, whose slope is R and whose meeting
    with the level before the step is L. For Eq. (4.15) L is ``2 zeta / omega_n``.

    Args:
        time, output, step: As for `reaction_curve`.
        tail: Share of the record, at its end, that is taken as the ramp, 0 to 1.

    Raises:
        InvalidInputError: If the arrays do not fit, the slopes of the two halves of the end differ
            by more than 5 %, or the asymptote gives no delay.

    >>> t = np.arange(0, 5, 0.01)
    >>> curve = integrating_reaction_curve(t, 3.0 * np.maximum(t - 0.4, 0), step=2.0)
    >>> round(curve.delay, 6), round(curve.slope, 6)
    (0.4, 1.5)
    """
    t, y = _record(time, output, step, 10)
    last = t >= t[-1] - tail * (t[-1] - t[0])
    if not 0 < tail <= 1 or np.count_nonzero(last) < 6:
        raise InvalidInputError(
            "tail", expected="a share in (0, 1] with at least 6 samples", got=tail
        )
    t, y = t[last], y[last]
    middle, level, slope = _line(t, y)
    half = t.size // 2
    halves = _line(t[:half], y[:half])[2], _line(t[half:], y[half:])[2]
    if not abs(halves[0] - halves[1]) <= 0.05 * abs(slope):
        raise InvalidInputError(
            "output",
            expected="a response that ends in a straight ramp",
            got=f"slopes of {halves[0]:.3g} and {halves[1]:.3g} rad/s in the halves of its end",
        )
    return _curve(middle - level / slope, slope / step, np.inf)


def _curve(delay: float, slope: float, gain: float) -> ReactionCurve:
    if not delay > 0:
        raise InvalidInputError(
            "output",
            expected="a tangent that meets the first level after the step",
            got=f"a delay of {delay:.3g} s",
        )
    return ReactionCurve(delay, slope, gain)


def _lines(t: Floats, y: Floats, window: int) -> tuple[Floats, Floats, Floats]:
    """Return mean time, mean output and slope of the lines through each window."""
    tt, yy = sliding_window_view(t, window), sliding_window_view(y, window)
    middle, level = tt.mean(axis=-1), yy.mean(axis=-1)
    dt, dy = tt - middle[:, None], yy - level[:, None]
    return middle, level, np.sum(dt * dy, axis=-1) / np.sum(dt * dt, axis=-1)


def _line(t: Floats, y: Floats) -> tuple[float, float, float]:
    middle, level, slope = _lines(t, y, t.size)
    return float(middle[0]), float(level[0]), float(slope[0])


def _record(time: ArrayLike, output: ArrayLike, step: float, least: int) -> tuple[Floats, Floats]:
    t, y = record(at_least=least, time=time, output=output)
    if not (np.all(np.diff(t) > 0) and np.ptp(y) > 0):
        raise InvalidInputError(
            "time, output", expected="increasing times, a response", got=(time, output)
        )
    if not np.isfinite(step) or step == 0:
        raise InvalidInputError("step", expected="a finite number other than 0", got=step)
    return t - t[0], y - y[0]


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
    factor, integral, derivative = RULE[kind]
    kp = factor / (curve.slope * curve.delay)
    # A filter is asked for even where no derivative uses it.
    tau = (derivative or RULE["PID"][2]) * curve.delay / filter_ratio
    return Gains(kp, kp / (integral * curve.delay), kp * derivative * curve.delay, tau)
