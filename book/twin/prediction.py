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

from book.twin.problem import Problem
from book.twin.recovery import CENTRAL, known
from book.twin.smoother import Ensemble, smoothed
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
        low, middle, high: 5, 50 and 95 %, in its unit, for what would be printed.
        printed: What is printed, or would be of a known rig.
        share: Width of the interval over that before any target was looked at.
    """

    predicted: str
    id: str
    low: float
    middle: float
    high: float
    printed: float
    share: float

    @property
    def holds(self) -> bool:
        """Whether the print lies within the interval."""
        return self.low <= self.printed <= self.high


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
    return np.asarray(np.percentile(rigs.off + noise, [CENTRAL[0], 50, CENTRAL[1]], axis=0))


def predictions(
    problem: Problem, name: str, *, jobs: int | None = None, kept: Path | None = None
) -> list[Prediction]:
    """Fit to all chapters but those of a name, and predict these."""
    which = hidden(problem.targets, CHAPTERS[name])
    rounds = smoothed(without(problem, which), jobs=jobs, kept=kept, progress=True)
    before, after = (spans(problem, one, seed=0) for one in (rounds[0], rounds[-1]))
    found = []
    for k in np.flatnonzero(which):
        one = problem.targets[k]
        off = np.append(after[:, k], problem.observed[k])
        low, middle, high, printed = (one.value + one.tolerance * off).tolist()
        share = float(np.ptp(after[:, k]) / np.ptp(before[:, k]))
        found.append(Prediction(name, one.id, low, middle, high, printed, share))
    return found


def held(problem: Problem, name: str, number: int, *, jobs: int | None = None) -> float:
    """Return the share of what a known rig gives that its prediction's intervals hold."""
    asked, _, _ = known(problem, number, jobs)
    which = hidden(problem.targets, CHAPTERS[name])
    last = smoothed(without(asked, which), seed=number + 1, jobs=jobs)[-1]
    low, _, high = spans(asked, last, seed=number)
    return float(np.mean((low <= asked.observed)[which] & (asked.observed <= high)[which]))
