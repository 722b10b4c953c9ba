"""How well the parameters of a known rig are recovered from what it would print.

A rig is drawn from the declared space; what it gives, each target with the chance of its error,
takes the place of the print. Two ways are asked for the parameters: the ensemble smoother, whose
rigs are the answer, and the evolution strategy with a normal law about its best rig, from the
slopes there. An honest 90 % interval holds the truth nine times in ten.
"""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from book.twin.best_rig import BOUND, evolved
from book.twin.interval import CENTRAL, NORMAL, Interval, intervals
from book.twin.problem import Problem
from book.twin.smoother import smoothed
from softgrip.arrays import Floats

STEP = 0.05
"""Of the slopes, in deviations of the prior: small against a range, large against the jumps of a
settling time."""
TOLD = 0.5
"""A parameter counts as told where its interval is less than this of the prior's."""

Way = Literal["smoother", "strategy"]
Kind = Literal["parameter", "target"]


@dataclass(frozen=True)
class Recovered:
    """What a way says of a parameter or a target of a known rig.

    Attributes:
        truth: Number of the rig.
        way: See `Way`.
        kind: See `Kind`.
        name: Of the parameter, or the target's id.
        interval: Of the parameter's variable, a standard normal one before any target was looked
            at; or of what the rig gives, without the chance of its error, in tolerances.
    """

    truth: int
    way: str
    kind: str
    name: str
    interval: Interval

    @property
    def told(self) -> bool:
        """Whether the targets say much of the parameter: see `TOLD`."""
        width = self.interval.high - self.interval.low
        return self.kind == "parameter" and width < TOLD * 2 * NORMAL


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


def normal_law(missed: Floats, slopes: Floats, x: Floats) -> tuple[Floats, Floats]:
    """Return the normal law of the variables by the strategy's loss and the prior about a rig.

    Gauss and Newton's: a target counts by what `best_rig.loss` makes of it there, so that one that
    is missed by far says nothing.

    Args:
        missed: At the rig, in errors, shape (targets,).
        slopes: By its variables, shape (targets, free).
        x: Its variables, shape (free,).

    Returns:
        tuple: Mean, shape (free,), and covariance, shape (free, free).
    """
    weighed = slopes.T / (1 + (missed / BOUND) ** 2) ** 2
    covariance = np.linalg.inv(weighed @ slopes + np.eye(x.size))
    return x - covariance @ (weighed @ missed + x), np.asarray(covariance)


def _percentiles(mean: Floats, variance: Floats) -> Floats:
    """Return those of `interval.CENTRAL` of normal laws, shape (3, numbers)."""
    half = NORMAL * np.sqrt(variance)
    return np.stack([mean - half, mean, mean + half])


def recovered(
    problem: Problem,
    number: int,
    *,
    rigs: int,
    rounds: int,
    generations: int,
    jobs: int | None = None,
    kept: Path | None = None,
) -> list[Recovered]:
    """Ask both ways for a known rig.

    Args:
        problem: Whose targets the rig is asked by.
        number: Of the rig.
        rigs, rounds: Of the smoother.
        generations: Of the strategy, which begins where the smoother ended.
        jobs: As of `misfit`.
        kept: Folder of what is done, from which a run that was cut goes on.
    """
    asked, truth, gives = known(problem, number, jobs)

    def rows(way: Way, kind: Kind, said: Floats, actual: Floats) -> list[Recovered]:
        free, targets = [p.name for p in asked.free], [t.id for t in asked.targets]
        names = free if kind == "parameter" else targets
        pairs = zip(names, intervals(said, actual), strict=True)
        return [Recovered(number, way, kind, name, own) for name, own in pairs]

    last = smoothed(
        asked, rigs=rigs, rounds=rounds, seed=number + 1, jobs=jobs, progress=True,
        kept=kept and kept / f"recovery-{number}.npz",
    )[-1]  # fmt: skip
    best = evolved(
        asked, last, generations=generations, seed=number + 1, jobs=jobs, progress=True,
        kept=kept and kept / f"strategy-{number}.pkl",
    )  # fmt: skip
    x, J = best.x[0], slopes(asked, best.x[0], jobs)
    mean, law = normal_law((best.off[0] - asked.observed) / asked.errors, J, x)
    off = best.off[0] + asked.errors * (J @ (mean - x))
    spread = np.einsum("tf,fg,tg->t", J, law, J) * asked.errors**2
    return [
        *rows("smoother", "parameter", np.percentile(last.x, CENTRAL, axis=0), truth),
        *rows("smoother", "target", np.percentile(last.off, CENTRAL, axis=0), gives),
        *rows("strategy", "parameter", _percentiles(mean, np.diag(law)), truth),
        *rows("strategy", "target", _percentiles(off, spread), gives),
    ]
