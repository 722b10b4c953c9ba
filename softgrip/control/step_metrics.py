"""What a step response is judged by: settling time, overshoot, rise time, steady-state error."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats
from softgrip.checks import takes_numbers
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class StepMetrics:
    """The measures of a step response, each a float array of shape () or (runs,).

    Attributes:
        settling_time: s; infinite where the response does not settle within the record.
        overshoot: Share of the change, >= 0.
        rise_time: From 10 to 90 % of the change, s; infinite where 90 % is not reached.
        steady_state_error: Target minus mean of the end of the record, rad.
    """

    settling_time: Floats
    overshoot: Floats
    rise_time: Floats
    steady_state_error: Floats


@takes_numbers
def step_metrics(
    time: ArrayLike,
    output: ArrayLike,
    *,
    target: ArrayLike,
    initial: ArrayLike = 0.0,
    band: float = 0.02,
    window: float = 0.5,
) -> StepMetrics:
    """Return all measures about the target; `band` is a share of the change."""
    return StepMetrics(
        settling_time(time, output, final=target, initial=initial, band=band),
        overshoot(output, target=target, initial=initial),
        rise_time(time, output, target=target, initial=initial),
        np.asarray(np.asarray(target) - final_value(time, output, window=window)),
    )


@takes_numbers
def settling_time(
    time: ArrayLike,
    output: ArrayLike,
    *,
    final: ArrayLike,
    initial: ArrayLike = 0.0,
    band: float = 0.02,
    absolute: bool = False,
) -> Floats:
    """Return the time after which the output stays within a band.

    Args:
        time: Time since the step, s, shape (N,), increasing.
        output: rad, shape (N,) or (runs, N).
        final: Middle of the band, rad, float or (runs,): the target, or, for a response that keeps
            an error, its own `final_value`. The two answer different questions.
        initial: Output before the step, rad, float or (runs,).
        band: Half width, > 0: a share of ``final - initial`` (0.02 and 0.05 are usual), or rad.
        absolute: True if the band is in rad.

    Returns:
        ndarray: s, shape () or (runs,), interpolated between samples; 0 if the output was never
            outside, infinite if the last sample is outside, NaN if a sample is NaN.

    Raises:
        InvalidInputError: If shapes do not fit, the time does not increase, or the band is not
            above zero.

    >>> t = np.arange(0, 8, 0.001)
    >>> settling_time(t, 1 - np.exp(-t), final=1.0).round(3).item()  # ln 50
    3.912
    """
    check_positive(band=band)
    t, y = _record(time, output)
    f, i = (array[..., None] for array in floats(final=final, initial=initial))
    if not all(values.size and not np.isinf(values).any() for values in (f, i)):
        raise InvalidInputError(
            "final, initial", expected="numbers that are not infinite", got=(final, initial)
        )
    excess = np.abs(y - f) - (band if absolute else band * np.abs(f - i))
    outside = excess > 0
    last = t.size - 1 - np.argmax(outside[..., ::-1], axis=-1)
    after = np.minimum(last + 1, t.size - 1)
    before_value = np.take_along_axis(excess, last[..., None], -1)[..., 0]
    after_value = np.take_along_axis(excess, after[..., None], -1)[..., 0]
    fall = np.where(before_value > after_value, before_value - after_value, 1.0)
    found = t[last] + (t[after] - t[last]) * before_value / fall
    found = np.where(outside.any(axis=-1), found, 0.0)
    found = np.where(outside[..., -1], np.inf, found)
    return np.where(np.isnan(excess).any(axis=-1), np.nan, found)


@takes_numbers
def overshoot(output: ArrayLike, *, target: ArrayLike, initial: ArrayLike = 0.0) -> Floats:
    """Return how far the output goes beyond the target, as a share of the change, >= 0.

    `output` has shape (N,) or (runs, N). With no change there is no share: the result is NaN.
    """
    progress = _progress(floats(output=output)[0], target, initial)
    return np.asarray(np.maximum(progress.max(axis=-1) - 1, 0.0))


@takes_numbers
def rise_time(
    time: ArrayLike,
    output: ArrayLike,
    *,
    target: ArrayLike,
    initial: ArrayLike = 0.0,
    start: float = 0.1,
    end: float = 0.9,
) -> Floats:
    """Return the time from the first crossing of one share of the change to that of another, s.

    Interpolated between samples; infinite where the second share is not reached, NaN without a
    change. Shapes as in `settling_time`.
    """
    if not 0 <= start < end:
        raise InvalidInputError("start, end", expected="0 <= start < end", got=(start, end))
    t, y = _record(time, output)
    progress = _progress(y, target, initial)
    early, late = _first_crossing(t, progress, start), _first_crossing(t, progress, end)
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(late), np.inf, late - early)


@takes_numbers
def final_value(time: ArrayLike, output: ArrayLike, *, window: float = 0.5) -> Floats:
    """Return the mean of the output over the last `window` seconds, rad, shape () or (runs,)."""
    check_positive(window=window)
    t, y = _record(time, output)
    return np.asarray(y[..., t >= t[-1] - window].mean(axis=-1))


def _first_crossing(t: Floats, progress: Floats, level: float) -> Floats:
    above = progress >= level
    at = np.argmax(above, axis=-1)
    before = np.maximum(at - 1, 0)
    high = np.take_along_axis(progress, at[..., None], -1)[..., 0]
    low = np.take_along_axis(progress, before[..., None], -1)[..., 0]
    share = np.where(high > low, (level - low) / np.where(high > low, high - low, 1.0), 1.0)
    found = np.where(above.any(axis=-1), t[before] + share * (t[at] - t[before]), np.inf)
    return np.where(np.isnan(progress).any(axis=-1), np.nan, found)


def _progress(y: Floats, target: ArrayLike, initial: ArrayLike) -> Floats:
    end, begin = (array[..., None] for array in floats(target=target, initial=initial))
    if not all(values.size and not np.isinf(values).any() for values in (y, end, begin)):
        raise InvalidInputError(
            "output, target, initial", expected="none that is infinite", got=(target, initial)
        )
    change = end - begin
    return np.asarray((y - begin) / np.where(change == 0, np.nan, change))


def _record(time: ArrayLike, output: ArrayLike) -> tuple[Floats, Floats]:
    t, y = floats(time=time, output=output)
    if t.ndim != 1 or t.size < 2 or y.shape[-1:] != t.shape:
        raise InvalidInputError(
            "time, output", expected="shapes (N,) and (..., N), N >= 2", got=(t.shape, y.shape)
        )
    if not np.all(np.diff(t) > 0):
        raise InvalidInputError("time", expected="increasing values", got="others")
    return t, y
