"""How near to each single target a rig of the declared space can come.

A target that many rigs of a search meet is within reach; for each other one the space is searched
anew with the experiments of this one alone. What then is still missed is out of reach as far as was
searched; where more can be said, `book.twin.bounds` says it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cma
import numpy as np

from book.twin.problem import FURTHEST, Problem
from book.twin.smoother import Ensemble
from softgrip.arrays import Floats

GENERATIONS, RIGS = 30, 64
WIDTH = 1.0


@dataclass(frozen=True, eq=False)
class Nearest:
    """The rig that comes nearest to a target.

    Attributes:
        x: Its variables, of the free parameters of the whole problem, shape (free,).
        off: By how many tolerances it misses.
    """

    x: Floats
    off: float


def among(seen: Sequence[Ensemble]) -> list[Nearest]:
    """Return for each target the nearest of the rigs that were run already."""
    x = np.concatenate([one.x for one in seen])
    off = np.concatenate([one.off for one in seen])
    best = np.argmin(np.abs(off), axis=0)
    return [Nearest(x[k], float(off[k, i])) for i, k in enumerate(best)]


def sought(
    problem: Problem, target: int, start: Nearest, *, seed: int = 1, jobs: int | None = None
) -> Nearest:
    """Search the space for a rig that meets one target, with its experiment alone.

    From the nearest that is known, by CMA-ES over the parameters that this target hangs on.
    """
    only = problem.part(np.arange(len(problem.targets)) == target)
    names = [one.name for one in only.free]
    at = [k for k, one in enumerate(problem.free) if one.name in names]
    options = {"popsize": RIGS, "seed": seed, "verbose": -9, "bounds": [-FURTHEST, FURTHEST]}
    strategy = cma.CMAEvolutionStrategy(start.x[at], WIDTH, options)
    best = start
    for _ in range(GENERATIONS):
        drawn = np.array(strategy.ask())
        off = only.off(drawn, jobs=jobs)[:, 0]
        strategy.tell(list(drawn), np.abs(off).tolist())
        k = int(np.argmin(np.abs(off)))
        if abs(off[k]) < abs(best.off):
            x = start.x.copy()
            x[at] = drawn[k]
            best = Nearest(x, float(off[k]))
        if abs(best.off) <= 1:
            break
    return best
