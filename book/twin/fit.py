"""The fit of the twin to the print: ensemble, best rig, and the rig nearest to each target.

Block by block, and what is kept is put together from them. Each stage is kept as it goes: a fit
that was cut goes on where it stopped.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from book.twin import fitted
from book.twin.best_rig import evolved
from book.twin.blocks import BLOCKS, Block, drawn, put_together
from book.twin.linear_bound import Ranges, ranges, with_bound
from book.twin.misfit import chosen
from book.twin.outcomes import KEPT
from book.twin.problem import Problem
from book.twin.reach import Nearest, among, sought
from book.twin.recipes import ALL, FAST
from book.twin.smoother import smoothed
from softgrip.arrays import Floats

KEPT_RIGS = 256


@dataclass(frozen=True, eq=False)
class Found:
    """What was found of a block, rows of all parameters.

    Attributes:
        problem: Of the block.
        last: Rigs of the last round of its smoother.
        best: The best of all, a row.
        near: The rig nearest to each of its targets.
    """

    problem: Problem
    last: Floats
    best: Floats
    near: Floats


def fit(folder: Path, *, jobs: int | None = None) -> None:
    """Fit the twin, and write what is kept to ``data/calibration/``.

    The best rig that is kept there is one of those that the strategy may begin at: a fit goes on
    from the one before, and ends no worse.

    Args:
        folder: Of the stages; they belong to one state of targets, space and simulator.
        jobs: As of `misfit`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    found = [_fitted(name, block, folder, jobs) for name, block in BLOCKS.items()]
    best = put_together([(one.problem, one.best) for one in found])
    several = put_together(
        [(one.problem, drawn(one.last, KEPT_RIGS, seed=k)) for k, one in enumerate(found)]
    )
    rigs = np.concatenate([best, several])
    tried = ranges(rigs)
    rigs = fitted.rounded(with_bound(rigs, tried.settled()))
    notes = "; ".join(
        f"{name}: {b.rigs} rigs in {b.rounds} rounds, then {b.generations} generations of {b.brood}"
        for name, b in BLOCKS.items()
    )
    notes += "\nthe generations begin at the best rig of the fit before, where that is better"
    notes += "\ncolumns in the units of space.csv"
    fitted.keep(fitted.BEST, rigs[:1], notes)
    fitted.keep(fitted.ENSEMBLE, rigs[1:], notes)
    near = fitted.rounded(_nearest(found, tried, rigs))
    fitted.keep(fitted.NEAREST, near, f"{notes}; in the order of targets")
    print(KEPT.write())


def _fitted(name: str, block: Block, folder: Path, jobs: int | None) -> Found:
    """Fit a block; its stages are files of its name."""
    print(name, flush=True)
    problem = block.problem()
    rounds = smoothed(
        problem, rigs=block.rigs, rounds=block.rounds, jobs=jobs,
        kept=folder / f"{name}-rounds.npz", progress=True,
    )  # fmt: skip
    best = evolved(
        problem, rounds[-1], generations=block.generations, rigs=block.brood,
        known=problem.variables(fitted.rigs(fitted.BEST))[0], jobs=jobs,
        kept=folder / f"{name}-best.pkl", progress=True,
    )  # fmt: skip
    near = [_sought(problem, k, one, folder, jobs) for k, one in enumerate(among([*rounds, best]))]
    rows = (rounds[-1].x, best.x[:1], np.array([one.x for one in near]))
    return Found(problem, *map(problem.rows, rows))


def _nearest(found: list[Found], tried: Ranges, rigs: Floats) -> Floats:
    """Return the rig nearest to each target, shape (targets, parameters).

    To a linear range: of the kept rigs, each with the bound that suits this one.
    """
    rows = {
        target.id: row
        for one in found
        for target, row in zip(one.problem.targets, one.near, strict=True)
    }
    for k, target in enumerate(tried.targets):
        rig, bound = tried.nearest(k)
        rows[target.id] = with_bound(rigs[rig][None], bound)[0]
    return np.array([rows[one.id] for one in chosen(ALL)])


def _sought(
    problem: Problem, target: int, start: Nearest, folder: Path, jobs: int | None
) -> Nearest:
    """Search for what was missed by all that were run, where a search is quick."""
    wanted = problem.targets[target]
    if abs(start.off) <= 1 or wanted.experiment not in FAST:
        return start
    kept = folder / f"nearest-{wanted.id}.npy"
    if kept.exists():
        x: Floats = np.load(kept)
        return Nearest(x[:-1], float(x[-1]))
    found = sought(problem, target, start, jobs=jobs)
    print(f"{wanted.id}: from {start.off:.2f} to {found.off:.2f} tolerances", flush=True)
    np.save(kept, np.append(found.x, found.off))
    return found
