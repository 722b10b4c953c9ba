"""More fingers on one pump: what is out of reach, and how far apart they get on the way.

``python -m book.chapter_6.finger_count`` writes ``data/gripper/finger_count.csv``.
"""

from collections.abc import Iterator
from dataclasses import astuple, dataclass

import numpy as np

from softgrip.errors import InvalidInputError
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper
from softgrip.gripper.reach import project
from softgrip.kept import Kept
from softgrip.units import DEG

COUNTS = (2, 3, 4, 5)
SPREADS = (0.0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2)
TARGET = 45 * DEG
"""Angle of every finger (Section 6.4, experiment), rad."""
SETTLING, LIMIT = 1.5, 5.0
"""By when the fingers are in their band, s, and the limit of the command, in its unit."""


@dataclass(frozen=True)
class CountPoint:
    """Some fingers with some spread between them.

    Attributes:
        fingers: How many.
        spread: Bound of the deviation of K_n, as a share of nominal.
        outside: Share of equal angles that is out of reach, as of `reach.Projection`.
        worst_residual: Largest error that a finger keeps at rest, deg.
        worst_sync: Least largest difference on the way, as of `OptimalFeedforward`.
    """

    fingers: int
    spread: float
    outside: float
    worst_residual: float
    worst_sync: float


def spread_gripper(fingers: int, spread: float) -> Gripper:
    """Return fingers that stand for so many draws within a spread of K_n.

    Their deviations are the means of n sorted uniform draws, ``spread (2 i / (n + 1) - 1)``: more
    fingers reach farther out, as more draws do. All else is of the mean of Eq. (6.26).

    Args:
        fingers: n, >= 2.
        spread: Bound of the deviation as a share of nominal, 0 <= spread < 1.

    >>> [round(f.stiffness, 3) for f in spread_gripper(3, 0.1).fingers]
    [3.168, 3.335, 3.502]
    """
    if not 0 <= spread < 1:
        raise InvalidInputError("spread", expected="0 <= spread < 1", got=spread)
    mean, rank = PRINTED.mean, np.arange(1, fingers + 1) / (fingers + 1)
    stiffness = mean.stiffness * (1 + spread * (2 * rank - 1))
    return Gripper(tuple(FingerDynamics(mean.damping, float(k), mean.gain) for k in stiffness))


def count_point(fingers: int, spread: float) -> CountPoint:
    """Return what is out of reach of such fingers, and their least difference."""
    gripper = spread_gripper(fingers, spread)
    found = project(gripper, [TARGET] * fingers)
    program = FeedforwardProgram(gripper, tuple(found.reached.tolist()), limit=LIMIT)
    best = program.settled_by(SETTLING)
    worst = float(np.abs(found.residual).max()) / DEG
    return CountPoint(fingers, spread, found.share, worst, max(best.worst_sync, 0.0))


def points() -> Iterator[CountPoint]:
    """Compute all points; what is below 1e-9 is the optimiser's zero."""
    for count in COUNTS:
        for spread in SPREADS:
            yield CountPoint(*(round(x, 9) for x in astuple(count_point(count, spread))))


KEPT = Kept(
    "gripper/finger_count.csv",
    CountPoint,
    points,
    "python -m book.chapter_6.finger_count",
    notes="worst_residual in deg",
    number=".4g",
)

if __name__ == "__main__":
    KEPT.main()
