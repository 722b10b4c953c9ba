"""What follows from the fit, and how far it can be trusted: tables below ``data/calibration/``."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from book.twin.fitted import best_rig
from book.twin.prediction import CHAPTERS, Prediction, held, predictions
from book.twin.problem import printed
from book.twin.recovery import Recovered, recovered
from book.twin.tension import Pull, against, fewest
from softgrip.kept import Kept

TRUTHS, GENERATIONS = 6, 120
"""Known rigs that both ways are tried on, and the strategy's generations there."""
PROGRAMS = 12


@dataclass(frozen=True)
class Held:
    """How often a prediction's interval holds, on a known rig.

    Attributes:
        predicted: Key of `prediction.CHAPTERS`.
        truth: Number of the rig.
        share: Of the hidden numbers.
    """

    predicted: str
    truth: int
    share: float


def _recovered() -> Iterator[Recovered]:
    problem = printed()
    for number in range(TRUTHS):
        yield from recovered(problem, number, generations=GENERATIONS)


def _predicted() -> Iterator[Prediction]:
    for name in CHAPTERS:
        yield from predictions(printed(), name)


def _held() -> Iterator[Held]:
    problem = printed()
    for name in CHAPTERS:
        for number in range(TRUTHS):
            yield Held(name, number, held(problem, name, number))


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
}
"""By command."""
