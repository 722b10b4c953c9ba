"""Which prints pull against which: the smallest set to drop so that the rest hold together.

About a rig the misses are taken as lines in its variables. How few targets must be given up for all
others to hold within their errors is then a mixed-integer linear program, which has a certain
answer (HiGHS, by SciPy). It is asked again about the rig that it names, until no fewer are given up
when that rig is really run. What a single target costs the others is seen when it alone is left
out of a robust least-squares fit along the same lines; the rigs of these fits are really run too.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, least_squares, milp

from book.twin.problem import FURTHEST, Problem
from book.twin.recovery import slopes
from softgrip.arrays import Flags, Floats

REACH = 2.0
"""How far a variable may go in the first round, in deviations. The lines are not true so far; but
the rigs on the way are really run, and a round that finds none better halves it."""
HOLDS = 1.0
"""Errors within which a target holds."""
PRICE, LOST = 1e-3, 5.0
"""Of an error that a target is beyond what holds, beside one that is given up: it shows the way
on where no step gives up fewer. What is missed by more than so many errors is lost, and priced at
nothing."""
NEAR = 0.5
"""The same about a fit in which one target is left out: there the lines must be true."""
SECONDS = 60.0
"""Most that a program may take."""


@dataclass(frozen=True, eq=False)
class Dropped:
    """A rig, and what was given up for it.

    Attributes:
        x: Its variables, shape (free,).
        off: Its misses, tolerances, shape (targets,).
        dropped: Which targets do not hold, shape (targets,).
    """

    x: Floats
    off: Floats
    dropped: Flags


def program(missed: Floats, slopes: Floats, x: Floats, reach: float = REACH) -> Floats:
    """Return the step for which the fewest targets miss by more than `HOLDS`, shape (free,).

    Args:
        missed: At the rig, in errors, shape (targets,).
        slopes: By its variables, shape (targets, free).
        x: Its variables.
        reach: Largest step of each.
    """
    count, free = slopes.shape
    # Unknown: the step, for each target whether it is given up, and how far it is beyond.
    largest = np.diag(np.abs(missed) + reach * np.abs(slopes).sum(axis=1) + 1)
    none, one = np.zeros((count, count)), np.eye(count)
    sides = [np.hstack([side * slopes, own]) for side in (1, -1) for own in (
        np.hstack([-largest, none]), np.hstack([none, -one]),
    )]  # fmt: skip
    ends = np.concatenate([HOLDS - missed] * 2 + [HOLDS + missed] * 2)
    low, high = np.maximum(-reach, -FURTHEST - x), np.minimum(reach, FURTHEST - x)
    price = np.where(np.abs(missed) < LOST, PRICE, 0.0)
    found = milp(
        np.concatenate([np.zeros(free), np.ones(count), price]),
        constraints=LinearConstraint(np.vstack(sides), ub=ends),
        bounds=Bounds(
            np.append(low, np.zeros(2 * count)),
            np.concatenate([high, np.ones(count), np.full(count, np.inf)]),
        ),
        integrality=np.concatenate([np.zeros(free), np.ones(count), np.zeros(count)]),
        options={"time_limit": SECONDS},
    )
    return np.zeros(free) if found.x is None else np.asarray(found.x[:free])


def fewest(problem: Problem, x: Floats, *, rounds: int, jobs: int | None = None) -> Dropped:
    """Return the rig with the fewest targets to drop that rounds of programs come to."""
    best = _dropped(problem, x, jobs)
    reach = REACH
    for _ in range(rounds):
        missed = (best.off - problem.observed) / problem.errors
        step = program(missed, slopes(problem, best.x, jobs), best.x, reach)
        # Of the steps on the way there, as lines bend.
        tried = best.x + np.linspace(0.1, 1.0, 10)[:, None] * step
        off = problem.off(tried, jobs=jobs)
        cost = costs(problem, off)
        k = int(np.argmin(cost))
        if cost[k] < costs(problem, best.off[None])[0]:
            best = Dropped(tried[k], off[k], _misses(problem, off[k]))
        else:
            reach /= 2
    return best


def costs(problem: Problem, off: Floats) -> Floats:
    """Return the number of targets that do not hold, and the price of what they are beyond."""
    missed = np.abs(off - problem.observed) / problem.errors
    beyond = np.clip(missed - HOLDS, 0, LOST)
    return np.asarray(np.sum((beyond > 0) + PRICE * beyond, axis=1))


def _dropped(problem: Problem, x: Floats, jobs: int | None) -> Dropped:
    off = problem.off(x[None], jobs=jobs)[0]
    return Dropped(x, off, _misses(problem, off))


def _misses(problem: Problem, off: Floats) -> Flags:
    return np.asarray(np.abs(off - problem.observed) > HOLDS * problem.errors)


@dataclass(frozen=True)
class Pull:
    """What one target costs the others.

    Attributes:
        left_out: Id of the target that had no say.
        costs: By how much the squares of the others, none of them above `LOST` squared, fell.
        freed: Ids of those that hold then and did not before, separated by spaces.
    """

    left_out: str
    costs: float
    freed: str


def pulls(problem: Problem, x: Floats, *, jobs: int | None = None) -> list[Pull]:
    """Leave out each target in turn, and run the rig that the others then ask for.

    Args:
        problem: What is asked.
        x: Variables of a rig that is fitted to all, shape (free,).
        jobs: As of `misfit`.
    """
    J = slopes(problem, x, jobs)
    base = (problem.off(x[None], jobs=jobs)[0] - problem.observed) / problem.errors
    count = len(base)

    def asked(without: int | None) -> Floats:
        kept = np.arange(count) != without
        found = least_squares(
            lambda step: np.append((base + J @ step)[kept], x + step),
            np.zeros(x.size),
            lambda _: np.vstack([J[kept], np.eye(x.size)]),
            bounds=(np.full(x.size, -NEAR), np.full(x.size, NEAR)),
            loss="cauchy",
        )
        return np.asarray(np.clip(x + found.x, -FURTHEST, FURTHEST))

    rigs = np.array([asked(None), *(asked(k) for k in range(count))])
    missed = np.abs((problem.off(rigs, jobs=jobs) - problem.observed) / problem.errors)
    squares = np.minimum(missed, LOST) ** 2
    found = []
    for k, own in enumerate(missed[1:]):
        others = np.arange(count) != k
        fell = float(np.sum((squares[0] - squares[1 + k])[others]))
        free = np.flatnonzero(others & (own <= HOLDS) & (missed[0] > HOLDS))
        names = " ".join(problem.targets[i].id for i in free)
        found.append(Pull(problem.targets[k].id, fell, names))
    return found
