"""What rigs that are fitted to some chapters say of the numbers of another.

The targets of the other chapter have no say in the fit. What is predicted of a print is where the
ensemble lies, with the error that the print itself has; on rigs that are known it is counted how
often such an interval holds.
"""

import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from book.twin.interval import CENTRAL, Interval, intervals
from book.twin.problem import Problem
from book.twin.recovery import known
from book.twin.smoother import RIGS, ROUNDS, Ensemble, smoothed
from book.twin.targets import Target
from softgrip.arrays import Flags, Floats

CHAPTERS = {"gripper": (6,), "fingers": (3, 4, 5)}
"""What is predicted, by name: from all other chapters of the fingers."""


@dataclass(frozen=True)
class Prediction:
    """A print that had no say, beside what is predicted of it.

    Attributes:
        predicted: Key of `CHAPTERS`.
        id: Of the target.
        interval: For what would be printed, in its unit, beside what is printed.
        share: Width of the interval over that before any target was looked at.
    """

    predicted: str
    id: str
    interval: Interval
    share: float


@dataclass(frozen=True)
class Held:
    """What is predicted of a number that a known rig would print.

    Attributes:
        truth: Number of the rig.
        predicted: Key of `CHAPTERS`.
        id: Of the target.
        interval: For what would be printed, in tolerances from the print.
    """

    truth: int
    predicted: str
    id: str
    interval: Interval


def chapter(target: Target) -> int:
    """Return the chapter in which a target is printed."""
    found = re.search(r"\d", target.section)
    assert found is not None
    return int(found.group())


def hidden(targets: Collection[Target], chapters: Collection[int]) -> Flags:
    """Return which targets are of some chapters, shape (targets,)."""
    return np.array([chapter(one) in chapters for one in targets])


def without(problem: Problem, which: Flags) -> Problem:
    """Return the problem in which some targets are not looked at."""
    return problem.with_errors(np.where(which, np.inf, problem.errors))


def spans(problem: Problem, rigs: Ensemble, seed: int) -> Floats:
    """Return the 5, 50 and 95 % of what would be observed, in tolerances, shape (3, targets)."""
    noise = np.random.default_rng(seed).normal(size=rigs.off.shape) * problem.errors
    return np.asarray(np.percentile(rigs.off + noise, CENTRAL, axis=0))


def predictions(
    problem: Problem,
    name: str,
    *,
    rigs: int = RIGS,
    rounds: int = ROUNDS,
    jobs: int | None = None,
    kept: Path | None = None,
) -> list[Prediction]:
    """Fit to all chapters but those of a name, and predict these.

    Args:
        problem: Of the print.
        name: Key of `CHAPTERS`.
        rigs, rounds: Of the smoother.
        jobs: As of `misfit`.
        kept: Folder of what is done, from which a run that was cut goes on.
    """
    which = hidden(problem.targets, CHAPTERS[name])
    done = smoothed(
        without(problem, which), rigs=rigs, rounds=rounds, jobs=jobs, progress=True,
        kept=kept and kept / f"predictions-{name}.npz",
    )  # fmt: skip
    before, after = (spans(problem, one, seed=0) for one in (done[0], done[-1]))
    found = []
    for k in np.flatnonzero(which):
        one = problem.targets[k]
        # Beyond a lower bound, the largest miss is the least value.
        *ends, actual = one.given(np.append(after[:, k], problem.observed[k])).tolist()
        low, middle, high = sorted(ends)
        share = float(np.ptp(after[:, k]) / np.ptp(before[:, k]))
        found.append(Prediction(name, one.id, Interval(low, middle, high, actual), share))
    return found


def held(
    problem: Problem,
    name: str,
    number: int,
    *,
    rigs: int,
    rounds: int,
    jobs: int | None = None,
    kept: Path | None = None,
) -> list[Held]:
    """Predict the numbers of a known rig as those of the print; arguments as of `predictions`."""
    asked, _, _ = known(problem, number, jobs)
    which = hidden(problem.targets, CHAPTERS[name])
    last = smoothed(
        without(asked, which), rigs=rigs, rounds=rounds, seed=number + 1, jobs=jobs, progress=True,
        kept=kept and kept / f"held-{name}-{number}.npz",
    )[-1]  # fmt: skip
    said = intervals(spans(asked, last, seed=number)[:, which], asked.observed[which])
    ids = [one.id for one, own in zip(problem.targets, which, strict=True) if own]
    return [Held(number, name, *pair) for pair in zip(ids, said, strict=True)]
