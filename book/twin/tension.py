"""Which prints pull against which: the smallest set to drop so that the rest hold together.

About a rig the misses are taken as lines in its variables. How few targets must be given up for all
others to hold within their errors is then a mixed-integer linear program, which has a certain
answer (HiGHS, by SciPy). It is asked again about the rig that it names, until no fewer are given up
when that rig is really run. What stands in the way of one that is given up, a linear program says
by its prices.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, linprog, milp

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
"""The same about a rig that is not left far: there the lines must be true."""
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
    """What stands against a target that was given up.

    Attributes:
        id: Of the target.
        left: By how many errors it must miss if all that hold are to go on holding, along the
            lines.
        really: By how many the rig at the end of these lines misses when it is run.
        against: Ids of the targets that stand in its way, the strongest first, separated by spaces.
        ranges: Names of the parameters that are at an end of their range, or of what the lines were
            trusted for.
    """

    id: str
    left: float
    really: float
    against: str
    ranges: str


STRONGEST = 4
"""Of those that stand in the way, as many are named."""


def against(problem: Problem, given: Dropped, *, jobs: int | None = None) -> list[Pull]:
    """Move each target that was given up as near to its print as those that hold allow.

    A linear program about the rig; what stands in the way has a price in it, other than zero.
    """
    J = slopes(problem, given.x, jobs)
    missed = (given.off - problem.observed) / problem.errors
    held = ~given.dropped
    free = J.shape[1]
    low = np.maximum(-NEAR, -FURTHEST - given.x)
    high = np.minimum(NEAR, FURTHEST - given.x)
    found = []
    for k in np.flatnonzero(given.dropped):
        A = np.hstack([np.vstack([J[held], -J[held]]), np.zeros((2 * held.sum(), 1))])
        own = np.array([[*J[k], -1.0], [*-J[k], -1.0]])
        ends = [HOLDS - missed[held], HOLDS + missed[held], missed[k] * np.array([-1.0, 1.0])]
        answer = linprog(
            np.append(np.zeros(free), 1.0),
            np.vstack([A, own]),
            np.concatenate(ends),
            bounds=[*zip(low, high, strict=True), (0, None)],
        )
        price = np.abs(answer.ineqlin.marginals[: 2 * held.sum()]).reshape(2, -1).sum(axis=0)
        order = [i for i in np.argsort(-price)[:STRONGEST] if price[i] > 1e-6]
        ids = [problem.targets[np.flatnonzero(held)[i]].id for i in order]
        moved = np.clip(given.x + answer.x[:free], -FURTHEST, FURTHEST)
        off = problem.off(moved[None], jobs=jobs)[0]
        ends_of = np.abs(answer.lower.marginals[:free]) + np.abs(answer.upper.marginals[:free])
        at = [problem.free[i].name for i in np.argsort(-ends_of)[:STRONGEST] if ends_of[i] > 1e-6]
        really = float(abs(off[k] - problem.observed[k]) / problem.errors[k])
        found.append(
            Pull(problem.targets[k].id, float(answer.fun), really, " ".join(ids), " ".join(at))
        )
    return found
