"""A problem whose misses are lines in the variables, so that its answer is known."""

from dataclasses import dataclass, field

import numpy as np

from book.twin.problem import Problem
from book.twin.space import space


@dataclass(frozen=True, eq=False)
class Lines(Problem):
    """Misses ``slopes @ x``, in tolerances.

    Attributes:
        slopes: Shape (targets, free).
        calls: How many rigs were run.
    """

    slopes: np.ndarray = None
    calls: list = field(default_factory=list)

    @property
    def free(self):
        return tuple(p for p in space().values() if p.status == "free")[: self.slopes.shape[1]]

    @property
    def touched(self):
        return self.slopes.T != 0

    def off(self, x, *, jobs=None, progress=False):
        self.calls.append(len(x))
        return x @ self.slopes.T


def lines(slopes, observed, errors=None) -> Lines:
    slopes, observed = np.array(slopes, float), np.array(observed, float)
    errors = np.ones(len(slopes)) if errors is None else np.array(errors, float)
    return Lines((None,) * len(slopes), observed, errors, slopes)
