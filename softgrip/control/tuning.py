"""Fine tuning of a PID as an optimisation, in place of trial and error."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from softgrip.arrays import Floats, read_only
from softgrip.control.loop import LoopResult
from softgrip.control.pid import Gains
from softgrip.control.step_metrics import overshoot
from softgrip.errors import InvalidInputError, NotFiniteError

Simulate = Callable[[Gains], LoopResult]
Objective = Callable[[LoopResult], float]

LOST = 1e6
"""Objective of a loop that runs away: large, so that any that does not is better."""

LEAST_GAIN = 0.01
"""A restart that gains a smaller share of the objective is the last."""


@dataclass(frozen=True)
class Tuned:
    """The result of a tuning.

    Attributes:
        gains: The best gains.
        start: Those that it began with.
        history: Best objective after each loop that was run, shape (loops,): it never rises.
        converged: Whether the search ended by itself and not by the number of evaluations.
    """

    gains: Gains
    start: Gains
    history: Floats
    converged: bool


@dataclass(frozen=True)
class Itae:
    """Integral of time times absolute error of a step, with overshoot and effort weighed in.

    The error counts as a share of the step, so that one weight serves all steps; a batch of runs
    counts by its mean.

    Attributes:
        overshoot_weight: s**2 for an overshoot of 100 %, >= 0.
        effort_weight: s**2 for a command that goes up and down by the whole `command_scale` in each
            sample, >= 0.
        command_scale: Command unit, > 0: the limit, where there is one.
    """

    overshoot_weight: float = 1.0
    effort_weight: float = 0.0
    command_scale: float = 1.0

    def __call__(self, result: LoopResult) -> float:
        """Return the objective of a loop whose reference is one step away from the start, s**2."""
        t, target = result.time, result.reference[..., -1]
        start = result.measured[..., 0]
        if not np.all(target != start):
            raise InvalidInputError("reference", expected="a step", got="no change")
        share = np.abs(result.reference - result.measured) / np.abs(target - start)[..., None]
        itae = np.trapezoid(t * share, t, axis=-1)
        beyond = overshoot(result.measured, target=target, initial=start)
        effort = np.mean(np.abs(np.diff(result.command, axis=-1)), axis=-1) / self.command_scale
        total = itae + self.overshoot_weight * beyond + self.effort_weight * effort
        return float(np.mean(total))


def tune(
    simulate: Simulate, start: Gains, objective: Objective | None = None, *, evaluations: int = 300
) -> Tuned:
    """Look for gains with a smaller objective, from given ones, by Nelder and Mead's simplex.

    It searches the logarithms of the gains, so that signs stay and a gain of zero stays zero; the
    derivative's filter is kept. The simplex starts anew until that gains less than `LEAST_GAIN`.
    It is deterministic where `simulate` is, and finds a local minimum.

    Args:
        simulate: Runs a loop with given gains: on a model or on a rig.
        start: Gains to start with, at least one other than zero.
        objective: What to make small; `Itae()` if None. One that is not finite counts as `LOST`.
        evaluations: Most loops to run, >= 1.

    Raises:
        InvalidInputError: If all gains are zero.
    """
    judge = Itae() if objective is None else objective
    names = [name for name in ("kp", "ki", "kd") if getattr(start, name) != 0]
    if not names:
        raise InvalidInputError("start", expected="a gain other than zero", got=start)
    origin = np.array([getattr(start, name) for name in names])
    values: list[float] = []

    def at(point: Floats) -> Gains:
        return replace(start, **dict(zip(names, (origin * np.exp(point)).tolist(), strict=True)))

    def cost(point: Floats) -> float:
        # Unstable gains are visited on purpose, and their numbers may overflow.
        with np.errstate(over="ignore", invalid="ignore"):
            try:
                value = judge(simulate(at(point)))
            except NotFiniteError:
                value = np.inf
        values.append(min(value, LOST) if np.isfinite(value) else LOST)
        return values[-1]

    best, left, converged = np.zeros(len(names)), evaluations, False
    # A simplex that collapsed may have done so short of the minimum: begin anew from its best.
    while left > 0 and not converged:
        before = min(values, default=np.inf)
        found = _search(cost, best, left)
        best, left = found.x, evaluations - len(values)
        converged = bool(found.success) and min(values) > (1 - LEAST_GAIN) * before
    history = read_only(np.minimum.accumulate(values))
    return Tuned(at(best), start, history, converged)


def _search(cost: Callable[[Floats], float], start: Floats, evaluations: int) -> OptimizeResult:
    # A step of 0.5 in the logarithm is a factor of 1.65: as coarse as trial by hand begins.
    simplex = np.vstack([start, start + 0.5 * np.eye(start.size)])
    options = {"initial_simplex": simplex, "maxfev": evaluations, "xatol": 3e-3, "fatol": 1e-4}
    return minimize(cost, start, method="Nelder-Mead", options=options)
