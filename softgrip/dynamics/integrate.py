"""Fixed-step integration of many runs at once: a run is a column, a state is a row.

A law here fills an array of slopes that it is handed, so that the inner loop makes no arrays of its
own. The step is one for all runs; `step_for` chooses it by measurement, because the order of a
method says little where the law is not smooth (a fractional power at zero).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

Derivative = Callable[[float, Floats, Floats], None]
"""``derivative(time, state, slope)`` writes the slope; both arrays have shape (states, runs)."""

_WEIGHTS = np.array([1.0, 2.0, 2.0, 1.0]) / 6


class RungeKutta:
    """The classical fourth-order method, with its work arrays, for one shape of state.

    Args:
        derivative: The law.
        shape: (states, runs).
    """

    def __init__(self, derivative: Derivative, shape: tuple[int, int]) -> None:
        self.derivative = derivative
        self.slopes = np.empty((4, *shape))
        self._flat = self.slopes.reshape(4, -1)
        self._trial = np.empty(shape)

    def start(self, time: float, state: Floats) -> None:
        """Evaluate the slope at `state`, with which the next `step` begins."""
        self.derivative(time, state, self.slopes[0])

    def step(self, time: float, state: Floats, step: float) -> None:
        """Move `state`, in place, from `time` by `step`; ``slopes[0]`` must hold its slope.

        The slope at the new state is not evaluated: a caller whose input jumps there needs another.
        """
        trial, slopes = self._trial, self.slopes
        for stage, part in ((1, step / 2), (2, step / 2), (3, step)):
            np.multiply(slopes[stage - 1], part, out=trial)
            trial += state
            self.derivative(time + part, trial, slopes[stage])
        np.dot(_WEIGHTS, self._flat, out=trial.reshape(-1))
        trial *= step
        state += trial

    def advance(self, time: float, state: Floats, step: float, count: int) -> None:
        """Move `state`, in place, from `time` by `count` steps of `step`, without output."""
        for index in range(count):
            now = time + index * step
            self.start(now, state)
            self.step(now, state, step)


def hermite_weights(fraction: Floats) -> Floats:
    """Return what the two ends of a step weigh in the cubic Hermite interpolant.

    Args:
        fraction: Place inside the step, 0 to 1, shape (N,).

    Returns:
        ndarray: Shape (N, 4): the weights of start value, step times start slope, end value, step
            times end slope.

    >>> hermite_weights(np.array([0.5])).tolist()
    [[0.5, 0.125, 0.5, -0.125]]
    """
    s = np.asarray(fraction, dtype=np.float64)
    rest = 1 - s
    return np.stack([(1 + 2 * s) * rest**2, s * rest**2, s**2 * (3 - 2 * s), s**2 * -rest], axis=-1)


def rk4(
    derivative: Derivative,
    state: ArrayLike,
    times: ArrayLike,
    step: float,
    *,
    keep: Sequence[int] | None = None,
    out: Floats | None = None,
) -> Floats:
    """Integrate a batch of runs and give it at any times, by cubic Hermite interpolation.

    Args:
        derivative: The law; called at `times[0]` and later only.
        state: State at `times[0]`, shape (states, runs); not changed.
        times: Output times, s, shape (N,), N >= 2, rising. They need not fall on steps.
        step: Largest step, s, > 0; the one taken divides the whole time evenly.
        keep: Rows of the state to give; None for all.
        out: Array for the result, so that a loop need not make one each time.

    Returns:
        ndarray: Shape (N, kept rows, runs), in C order.

    Raises:
        InvalidInputError: If a shape or a value is not as said.

    >>> def decay(time, state, slope):
    ...     np.negative(state, out=slope)
    >>> found = rk4(decay, [[1.0, 2.0]], np.linspace(0, 1, 101), 0.05)
    >>> found.shape, bool(abs(found[-1] - np.exp(-1.0) * np.array([1, 2])).max() < 1e-6)
    ((101, 1, 2), True)
    """
    y = np.array(state, dtype=np.float64, order="C")
    t = np.asarray(times, dtype=np.float64)
    if y.ndim != 2 or y.size == 0:
        raise InvalidInputError("state", expected="shape (states, runs)", got=y.shape)
    if t.ndim != 1 or t.size < 2 or not (np.diff(t) > 0).all():
        raise InvalidInputError("times", expected="at least two rising times", got=t.shape)
    if not (np.isfinite(step) and step > 0):
        raise InvalidInputError("step", expected="a finite number > 0", got=step)
    rows = list(range(y.shape[0]) if keep is None else keep)
    shape = (t.size, len(rows), y.shape[1])
    result = np.empty(shape) if out is None else out
    if result.shape != shape or not result.flags.c_contiguous:
        raise InvalidInputError("out", expected=f"a C-ordered array {shape}", got=result.shape)

    count = ceil((t[-1] - t[0]) / step - 1e-9)
    h = float(t[-1] - t[0]) / count
    place = (t - t[0]) / h
    index = np.clip(np.ceil(place - 1e-9).astype(int) - 1, 0, count - 1)
    weights = hermite_weights(place - index)
    first = np.searchsorted(index, np.arange(count + 1))

    method = RungeKutta(derivative, (y.shape[0], y.shape[1]))
    ends = np.empty((4, *shape[1:]))
    ends_flat, result_flat = ends.reshape(4, -1), result.reshape(t.size, -1)
    now = float(t[0])
    method.start(now, y)
    ends[2], ends[3] = y[rows], method.slopes[0, rows] * h
    for k in range(count):
        ends[:2] = ends[2:]
        method.step(now, y, h)
        now = float(t[0]) + (k + 1) * h
        method.start(now, y)
        a, b = first[k], first[k + 1]
        for j, row in enumerate(rows):
            ends[2, j] = y[row]
            np.multiply(method.slopes[0, row], h, out=ends[3, j])
        if a < b:
            np.dot(weights[a:b], ends_flat, out=result_flat[a:b])
    return result


@dataclass(frozen=True)
class StepChoice:
    """A step, and what halving it changed.

    Attributes:
        step: s.
        error: Largest measured error of the output at this step, in the unit of the output.
    """

    step: float
    error: float


def step_for(
    error: float, solve: Callable[[float], Floats], *, first: float, smallest: float = 1e-5
) -> StepChoice:
    """Choose the step by halving it until halving it further changes too little to matter.

    A step is judged against its half and its quarter, and the error taken as twice the larger
    change, which holds for any order from 1 up. One halving alone can mislead: where a run crosses
    a kink, the error depends on where in a step it crosses, and two steps may be off by the same.
    It stays an estimate.

    Args:
        error: Allowed error of the output, in its unit, > 0.
        solve: Gives the output for a step; a few runs that stand for the batch are enough.
        first: Longest step to try, s.
        smallest: Where to give up, s.

    Raises:
        InvalidInputError: If no step down to `smallest` is good enough.
    """
    step, seen = first, np.inf
    coarse, fine = solve(step), solve(step / 2)
    while step > smallest:
        finest = solve(step / 4)
        changes = (np.max(np.abs(other - coarse)) for other in (fine, finest))
        seen = 2 * float(max(changes))
        if seen <= error:
            return StepChoice(step, seen)
        step, coarse, fine = step / 2, fine, finest
    raise InvalidInputError(
        "error",
        expected=f"one that a step >= {smallest:g} s reaches (at best {seen:.2g})",
        got=error,
    )
