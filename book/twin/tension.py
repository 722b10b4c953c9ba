"""Which prints pull against which: the smallest set to drop so that the rest hold together.

About a rig the misses are taken as lines in its variables. How few targets must be given up for all
others to hold within their errors is then a mixed-integer linear program, which has a certain
answer (HiGHS, by SciPy). It is asked again about the rig that it names, until no fewer are given up
when that rig is really run.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

from book.twin.problem import FURTHEST, Problem
from book.twin.recovery import slopes
from softgrip.arrays import Flags, Floats

REACH = 0.5
"""How far a variable may go in one round, in deviations: so far its lines are trusted."""
HOLDS = 1.0
"""Errors within which a target holds."""
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
    largest = np.abs(missed) + reach * np.abs(slopes).sum(axis=1) + 1
    over = np.hstack([slopes, -np.diag(largest)])
    under = np.hstack([-slopes, -np.diag(largest)])
    limits = [
        LinearConstraint(over, ub=HOLDS - missed),
        LinearConstraint(under, ub=HOLDS + missed),
    ]
    low, high = np.maximum(-reach, -FURTHEST - x), np.minimum(reach, FURTHEST - x)
    found = milp(
        np.concatenate([np.zeros(free), np.ones(count)]),
        constraints=limits,
        bounds=Bounds(np.append(low, np.zeros(count)), np.append(high, np.ones(count))),
        integrality=np.append(np.zeros(free), np.ones(count)),
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
        given_up = np.sum(np.abs(off - problem.observed) > HOLDS * problem.errors, axis=1)
        k = int(np.argmin(given_up))
        if given_up[k] < best.dropped.sum():
            best = Dropped(tried[k], off[k], _misses(problem, off[k]))
        else:
            reach /= 2
    return best


def _dropped(problem: Problem, x: Floats, jobs: int | None) -> Dropped:
    off = problem.off(x[None], jobs=jobs)[0]
    return Dropped(x, off, _misses(problem, off))


def _misses(problem: Problem, off: Floats) -> Flags:
    return np.asarray(np.abs(off - problem.observed) > HOLDS * problem.errors)
