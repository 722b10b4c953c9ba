"""What the fitted rigs give for each target: reached together, alone, or not at all."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from book.twin.fitted import best_rig, ensemble, nearest
from book.twin.misfit import chosen, misfit
from book.twin.problem import error_of
from book.twin.recipes import ALL
from book.twin.space import space
from book.twin.targets import Target
from softgrip.arrays import Floats
from softgrip.kept import Kept

Word = Literal["together", "alone", "out of reach"]
MOST = 0.5
"""Share of the ensemble that must meet a target for *together*, or the best rig must."""


@dataclass(frozen=True)
class Outcome:
    """A target beside what was found.

    Attributes:
        id: Of its claim.
        before: Of the rig that the space begins with, in the target's unit.
        best: Of the best rig.
        low, middle, high: 5, 50 and 95 % of the ensemble.
        met: Share of the ensemble within the error of the target.
        nearest: What the rig gives that comes nearest, of all that were run or sought.
        distance: By how many errors that misses.
        word: See `judged`.
    """

    id: str
    before: float
    best: float
    low: float
    middle: float
    high: float
    met: float
    nearest: float
    distance: float
    word: str


def judged(target: Target, before: float, best: float, several: Floats, nearest: float) -> Outcome:
    """Judge a target by misses in tolerances, of the rigs of `Outcome`.

    *Together*: the best rig meets it, or half of the ensemble does; *alone*: some rig does; *out of
    reach*: none that was found. To meet is to be within the error of print and model,
    `problem.error_of`.
    """
    error = error_of(target)
    met = float(np.mean(np.abs(several) <= error))
    distance = abs(nearest) / error
    word: Word = "out of reach"
    if abs(best) <= error or met >= MOST:
        word = "together"
    elif distance <= 1:
        word = "alone"
    low, middle, high = np.percentile(target.given(several), [5, 50, 95]).tolist()
    was, found, near = target.given(np.array([before, best, nearest])).tolist()
    return Outcome(target.id, was, found, low, middle, high, met, near, distance, word)


def outcomes(jobs: int | None = None) -> list[Outcome]:
    """Run the kept rigs and judge each target."""
    before = np.array([one.value for one in space().values()])
    rigs = np.concatenate([before[None], best_rig()[None], ensemble()])
    wanted = chosen(ALL)
    off, near = misfit(rigs, experiments=ALL, jobs=jobs), np.empty(len(wanted))
    for name in ALL:
        # The rig nearest to a target need do no other experiment.
        own = [k for k, target in enumerate(wanted) if target.experiment == name]
        near[own] = np.diag(misfit(nearest()[own], experiments=[name], jobs=jobs))
    was, best, several = off[0], off[1], off[2:]
    return [
        judged(target, float(was[k]), float(best[k]), several[:, k], float(near[k]))
        for k, target in enumerate(wanted)
    ]


KEPT = Kept(
    "calibration/outcomes.csv",
    Outcome,
    outcomes,
    source="python -m book.twin outcomes",
    notes="values in the unit of the target; where a bound holds, the bound itself",
)
