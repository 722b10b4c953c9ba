"""How well the parameters of a known rig are recovered from what it would print.

A rig is drawn from the declared space; what it gives, each target with the chance of its error,
takes the place of the print. Two ways are asked for the parameters: the ensemble smoother, whose
rigs are the answer, and the evolution strategy with a normal law about its best rig, from the
slopes there. An honest 90 % interval holds the truth nine times in ten.
"""

from dataclasses import dataclass, replace

import numpy as np

from book.twin.best_rig import evolved
from book.twin.problem import Problem
from book.twin.smoother import smoothed
from softgrip.arrays import Floats

CENTRAL = (5.0, 95.0)
"""Percentiles of an interval that holds nine of ten."""
STEP = 0.05
"""Of the slopes, in deviations of the prior: small against a range, large against the jumps of a
settling time."""
TOLD = 0.5
"""A parameter counts as told where its interval is less than this of the prior's."""
PRIOR = 2 * 1.6449
"""Width of the prior's interval."""


@dataclass(frozen=True)
class Recovered:
    """What a way says of a known rig.

    Attributes:
        truth: Number of the rig.
        way: "smoother" or "strategy".
        parameters: Share of the parameters whose interval holds the truth.
        told: How many parameters have an interval of less than half the prior's.
        told_hold: Share of these whose interval holds the truth.
        targets: Share of the targets of which the interval of the ensemble, with the error of the
            observation, holds what the true rig gives.
        width: Median width of the intervals over that of the prior.
    """

    truth: int
    way: str
    parameters: float
    told: int
    told_hold: float
    targets: float
    width: float


def known(problem: Problem, truth: int, jobs: int | None = None) -> tuple[Problem, Floats, Floats]:
    """Return the problem of a rig that is drawn by its number, its variables and what it gives.

    Of some rigs that are drawn the one with the most experiments that tell something.
    """
    rng = np.random.default_rng((2024, truth))
    drawn = np.clip(rng.normal(size=(64, len(problem.free))), -2, 2)
    off = problem.off(drawn, jobs=jobs)
    k = int(np.argmin(np.sum(np.abs(off - problem.observed) >= SAID, axis=1)))
    noise = rng.normal(size=off.shape[1]) * problem.errors
    return replace(problem, observed=off[k] + noise), drawn[k], off[k]


SAID = 99.0
"""Tolerances, from which on a miss may stand for an experiment that told nothing."""


def slopes(problem: Problem, x: Floats, jobs: int | None = None) -> Floats:
    """Return the slopes of the misses by the variables at a point, shape (targets, free)."""
    moved = x + STEP * np.concatenate([np.eye(x.size), -np.eye(x.size)])
    off = problem.off(moved, jobs=jobs) / problem.errors
    return np.asarray((off[: x.size] - off[x.size :]).T / (2 * STEP))


def normal_law(problem: Problem, x: Floats, jobs: int | None = None) -> Floats:
    """Return the covariance of the variables about the best rig, with that of the prior, I."""
    J = slopes(problem, x, jobs)
    return np.asarray(np.linalg.inv(J.T @ J + np.eye(x.size)))


def _judged(
    number: int, way: str, x: Floats, low: Floats, high: Floats, targets: float
) -> Recovered:
    holds, width = (low <= x) & (x <= high), (high - low) / PRIOR
    told = width < TOLD
    return Recovered(
        number, way, float(holds.mean()), int(told.sum()),
        float(holds[told].mean()) if told.any() else float("nan"), targets, float(np.median(width)),
    )  # fmt: skip


def recovered(
    problem: Problem, number: int, *, generations: int, jobs: int | None = None
) -> list[Recovered]:
    """Ask both ways for a known rig."""
    asked, truth, gives = known(problem, number, jobs)
    rounds = smoothed(asked, seed=number + 1, jobs=jobs)
    last = rounds[-1]
    low, high = np.percentile(last.x, CENTRAL, axis=0)
    rng = np.random.default_rng(number)
    seen = last.off + rng.normal(size=last.off.shape) * asked.errors
    inside = np.percentile(seen, CENTRAL, axis=0)
    targets = float(np.mean((inside[0] <= asked.observed) & (asked.observed <= inside[1])))
    found = [_judged(number, "smoother", truth, low, high, targets)]
    if generations:
        best = evolved(asked, last, generations=generations, seed=number + 1, jobs=jobs)
        half = PRIOR / 2 * np.sqrt(np.diag(normal_law(asked, best.x[0], jobs)))
        off = np.abs(best.off[0] - gives) / asked.errors
        found.append(
            _judged(number, "strategy", truth, best.x[0] - half, best.x[0] + half,
                    float(np.mean(off <= PRIOR / 2)))
        )  # fmt: skip
    return found
