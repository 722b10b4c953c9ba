"""The fit of the twin to the print: ensemble, best rig, and the rig nearest to each target.

Each stage is kept as it goes: a fit that was cut goes on where it stopped.
"""

from pathlib import Path

import numpy as np

from book.twin import fitted
from book.twin.best_rig import evolved
from book.twin.outcomes import KEPT
from book.twin.problem import Problem, printed
from book.twin.reach import Nearest, among, sought
from book.twin.smoother import smoothed
from softgrip.arrays import Floats

GENERATIONS = 300
KEPT_RIGS = 256


def fit(folder: Path, *, jobs: int | None = None) -> None:
    """Fit the twin, and write what is kept to ``data/calibration/``.

    Args:
        folder: Of the stages; they belong to one state of targets, space and simulator.
        jobs: As of `misfit`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    problem = printed()
    rounds = smoothed(problem, jobs=jobs, kept=folder / "rounds.npz", progress=True)
    best = evolved(
        problem, rounds[-1], generations=GENERATIONS, jobs=jobs, kept=folder / "best.pkl",
        progress=True,
    )  # fmt: skip
    notes = (
        f"{len(rounds[0].x)} rigs in {len(rounds) - 1} rounds, then {GENERATIONS} generations; "
        "columns in the units of space.csv"
    )
    last = rounds[-1].x[:: len(rounds[-1].x) // KEPT_RIGS]
    fitted.keep(fitted.ENSEMBLE, fitted.rounded(problem.rows(last)), notes)
    fitted.keep(fitted.BEST, fitted.rounded(problem.rows(best.x[:1])), notes)
    seen = among([*rounds, best])
    near = [
        one if abs(one.off) <= 1 else _sought(problem, k, one, folder, jobs)
        for k, one in enumerate(seen)
    ]
    x = np.array([one.x for one in near])
    fitted.keep(
        fitted.NEAREST, fitted.rounded(problem.rows(x)), f"{notes}; in the order of targets"
    )
    print(KEPT.write())


def _sought(
    problem: Problem, target: int, start: Nearest, folder: Path, jobs: int | None
) -> Nearest:
    kept = folder / f"nearest-{problem.targets[target].id}.npy"
    if kept.exists():
        x: Floats = np.load(kept)
        return Nearest(x[:-1], float(x[-1]))
    found = sought(problem, target, start, jobs=jobs)
    print(
        f"{problem.targets[target].id}: from {start.off:.2f} to {found.off:.2f} tolerances",
        flush=True,
    )
    np.save(kept, np.append(found.x, found.off))
    return found
