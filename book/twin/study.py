"""What follows from the fit, and how far it can be trusted: tables below ``data/calibration/``."""

from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from book.twin.bounds import Tried, tried
from book.twin.fitted import best_rig
from book.twin.prediction import CHAPTERS, Held, Prediction, held, predictions
from book.twin.problem import Problem, printed
from book.twin.recovery import Recovered, recovered
from book.twin.tension import Pull, against, fewest
from book.twin.walk import Miss, misses
from softgrip.kept import Kept

STAGES = Path("book/_build/twin")
"""Folder of what is done."""
TRUTHS, RIGS, ROUNDS, GENERATIONS = 3, 256, 12, 60
"""Known rigs that both ways are tried on; the smoother's rigs and rounds and the strategy's
generations there: smaller than those of the fit, as it is asked nine times."""
PROGRAMS = 12


def _done(problem: Problem) -> Path:
    """Return the folder of what is done of a study, from which a run that was cut goes on.

    Another state of space, targets, simulator or sizes has another.
    """
    state = repr((problem.free, problem.targets, RIGS, ROUNDS)).encode()
    numbers = [problem.errors, problem.off(np.zeros((1, len(problem.free)))).round(6)]
    state += b"".join(one.tobytes() for one in numbers)
    folder = STAGES / sha256(state).hexdigest()[:12]
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _recovered() -> Iterator[Recovered]:
    problem = printed()
    for number in range(TRUTHS):
        yield from recovered(
            problem, number, rigs=RIGS, rounds=ROUNDS, generations=GENERATIONS, kept=_done(problem)
        )


def _predicted() -> Iterator[Prediction]:
    problem = printed()
    for name in CHAPTERS:
        yield from predictions(problem, name, kept=_done(problem))


def _held() -> Iterator[Held]:
    problem = printed()
    for number in range(TRUTHS):
        for name in CHAPTERS:
            yield from held(problem, name, number, rigs=RIGS, rounds=ROUNDS, kept=_done(problem))


def _pulls() -> Iterator[Pull]:
    problem = printed()
    x = problem.variables(best_rig()[None])[0]
    yield from against(problem, fewest(problem, x, rounds=PROGRAMS))


def _kept(name: str, row: type, make: Callable[[], Iterator[Any]]) -> Kept[Any]:
    return Kept(f"calibration/{name}.csv", row, make, source=f"python -m book.twin {name}")


TABLES = {
    "recovery": _kept("recovery", Recovered, _recovered),
    "predictions": _kept("predictions", Prediction, _predicted),
    "held": _kept("held", Held, _held),
    "tension": _kept("tension", Pull, _pulls),
    "bounds": _kept("bounds", Tried, tried),
    "walk": _kept("walk", Miss, misses),
}
"""By command."""
