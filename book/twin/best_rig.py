"""The one rig that comes nearest to as many targets as can be: an evolution strategy.

CMA-ES (Hansen, arXiv:1604.00772) by the library `cma`, from where the smoother or an earlier
search ended. The loss is robust: what cannot be met at all counts by a bound, and does not draw the
rest along.
"""

import pickle
from pathlib import Path

import cma
import numpy as np

from book.twin.problem import FURTHEST, Problem
from book.twin.smoother import Ensemble
from softgrip.arrays import Floats

BOUND = 2.0
"""Errors: a target that is missed by many counts as one that is missed by two, squared."""
RIGS = 96
"""Of a generation: some 4 + 3 ln(free) are the least (Hansen), more are surer and use the batch."""
WIDTH = 0.5
"""Largest deviation of a variable at the start."""
REFINED = 0.2
"""Of the deviations, about a rig that is known: at the full ones all that are drawn are worse."""


def loss(problem: Problem, off: Floats) -> Floats:
    """Return the sum over targets of ``r^2 / (1 + r^2 / BOUND^2)``, shape (rigs,).

    Geman and McClure's, with ``r`` the misses in errors.
    """
    squares = ((off - problem.observed) / problem.errors) ** 2
    return np.asarray(np.sum(squares / (1 + squares / BOUND**2), axis=1))


def evolved(
    problem: Problem,
    start: Ensemble,
    *,
    generations: int,
    rigs: int = RIGS,
    known: Floats | None = None,
    seed: int = 1,
    jobs: int | None = None,
    kept: Path | None = None,
    progress: bool = False,
) -> Ensemble:
    """Return the best rig of the start and of each generation, the best of all first.

    Args:
        problem: What is asked.
        start: Its best rig and its deviations begin.
        generations: How many.
        rigs: Of a generation.
        known: Variables of a rig that an earlier search found, shape (free,): where it is better
            than all of the start the strategy begins there.
        seed: Of its draws, > 0.
        jobs: As of `misfit`.
        kept: File that holds the state after each generation, and from which a run goes on.
        progress: Whether to say every tenth generation how far it is.
    """
    if kept is not None and kept.exists():
        strategy, best = pickle.loads(kept.read_bytes())
    else:
        x, off, width = start.x, start.off, 1.0
        if known is not None:
            x, off = np.vstack([x, known]), np.vstack([off, problem.off(known[None], jobs=jobs)])
        losses = loss(problem, off)
        k = int(np.argmin(losses))
        if k == len(start.x):
            width = REFINED
        best = [(losses[k], x[k], off[k])]
        options = {
            "popsize": rigs, "seed": seed, "verbose": -9, "bounds": [-FURTHEST, FURTHEST],
            "CMA_stds": np.minimum(start.x.std(axis=0), WIDTH),
        }  # fmt: skip
        strategy = cma.CMAEvolutionStrategy(x[k], width, options)
    while len(best) <= generations:
        x = np.array(strategy.ask())
        off = problem.off(x, jobs=jobs)
        losses = loss(problem, off)
        strategy.tell(list(x), losses.tolist())
        k = int(np.argmin(losses))
        best.append((losses[k], x[k], off[k]))
        if kept is not None:
            kept.with_suffix(".part").write_bytes(pickle.dumps((strategy, best)))
            kept.with_suffix(".part").replace(kept)
        if progress and len(best) % 10 == 1:
            least = min(one[0] for one in best)
            print(f"generation {len(best) - 1} of {generations}: {least:.1f}", flush=True)
    best.sort(key=lambda one: float(one[0]))
    return Ensemble(np.array([one[1] for one in best]), np.array([one[2] for one in best]))
