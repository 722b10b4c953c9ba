"""An ensemble of rigs that agree with the targets, by an ensemble smoother with several rounds.

Emerick and Reynolds' ES-MDA (Computers & Geosciences 55, 2013) by the library
`iterative_ensemble_smoother`: the rigs of the prior are moved in rounds, each of which looks at the
targets with errors so inflated that all rounds together count them once. A target moves only the
parameters that its experiment looks at, so that chance along 500 rigs ties nothing else to it.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from iterative_ensemble_smoother import ESMDA

from book.twin.problem import FURTHEST, Problem
from softgrip.arrays import Floats

RIGS, ROUNDS = 512, 16
FIRST = 64.0
"""Inflation of the variance in the first round over that in the last: far from the targets a rig's
answer is the least linear."""


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Rigs and what they give.

    Attributes:
        x: Variables of a `Problem`, shape (rigs, free).
        off: Misses, tolerances, shape (rigs, targets).
    """

    x: Floats
    off: Floats


def inflations(rounds: int) -> Floats:
    """Return by what the variances are inflated in each round; the inverses add up to 1."""
    found = np.geomspace(FIRST, 1.0, rounds)
    return np.asarray(found * np.sum(1 / found))


def smoothed(
    problem: Problem,
    *,
    rigs: int = RIGS,
    rounds: int = ROUNDS,
    seed: int = 1,
    jobs: int | None = None,
    kept: Path | None = None,
    progress: bool = False,
) -> list[Ensemble]:
    """Move rigs of the prior to where they agree with the targets.

    Args:
        problem: What is asked.
        rigs: Of the ensemble, a power of two.
        rounds: See `ROUNDS`.
        seed: Of the prior and of the perturbed observations.
        jobs: As of `misfit`.
        kept: File that holds the rounds that are done, and from which a run that was cut goes on.
        progress: Whether to say which round is done.

    Returns:
        list: The prior, and the ensemble after each round.
    """
    done = _read(kept)
    x = problem.prior(rigs, seed)
    for number in range(len(done), rounds + 1):
        if number:
            x = _moved(problem, done[-1], inflations(rounds), number - 1, seed)
        done.append(Ensemble(x, problem.off(x, jobs=jobs)))
        if kept is not None:
            _write(kept, done)
        if progress:
            middle = np.median(np.sum(problem.missed(done[-1].off) ** 2, axis=1))
            print(f"round {number} of {rounds}: median of squares {middle:.0f}", flush=True)
    return done


def _moved(problem: Problem, now: Ensemble, alphas: Floats, number: int, seed: int) -> Floats:
    """Return the variables after one more round."""
    told = problem.missed(now.off).T
    noise = np.random.default_rng((seed, number)).normal(size=told.shape)
    moved = now.x.T.copy()
    groups, which = np.unique(problem.touched, axis=0, return_inverse=True)
    for k, targets in enumerate(groups):
        # The same noise for all groups: a rig is drawn to one set of perturbed observations.
        own = np.flatnonzero(targets & np.isfinite(problem.errors))
        if not own.size:
            continue
        smoother = ESMDA(np.ones(own.size), np.zeros(own.size), alpha=alphas)
        smoother.iteration = number - 1
        smoother.prepare_assimilation(
            Y=told[own], truncation=0.999, observation_perturbations=noise[own]
        )
        mine = np.flatnonzero(which == k)
        moved[mine] = smoother.assimilate_batch(X=moved[mine])
    return np.clip(moved.T, -FURTHEST, FURTHEST)


def _read(kept: Path | None) -> list[Ensemble]:
    if kept is None or not kept.exists():
        return []
    with np.load(kept) as file:
        return [Ensemble(x, off) for x, off in zip(file["x"], file["off"], strict=True)]


def _write(kept: Path, done: list[Ensemble]) -> None:
    partial = kept.with_suffix(".part.npz")
    np.savez(partial, x=[one.x for one in done], off=[one.off for one in done])
    partial.replace(kept)
