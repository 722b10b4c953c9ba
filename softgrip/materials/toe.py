"""The beginning of a tensile curve: a level, then a power of the strain from where it takes load.

A power above 1 begins flat, as loose clamps do. They are told apart by how well each explains the
curve, as far along it as a power does so within its noise.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import minimize_scalar

from softgrip.arrays import Floats

SHARES = (1.0, 0.5, 0.2)
"""Of the largest stress: up to the first at which a power explains the curve, else to the last."""
FEWEST = 12
"""Rows that a toe has at least."""
GRID = np.geomspace(0.5, 6.0, 60)
"""Powers that are tried, before the best is sought between its neighbours."""
ADEQUATE = 1.2
"""Times the noise that what a power leaves may be."""
MISFIT = 5e-4
"""Share of the toe's stress by which any curve may differ from a power, root mean square."""
LIKELIER = 15.0
"""Twice the logarithm of a ratio of likelihoods above which it decides: chance alone brings that of
one parameter there once in some ten thousand tests."""


@dataclass(frozen=True, eq=False)
class Toe:
    """The beginning of a curve.

    Attributes:
        strain: As measured, shape (N,).
        stress: Over `scale`, shape (N,).
        scale: What the stress rises by within it, Pa.
        noise: Standard deviation of the stress, over `scale`.
    """

    strain: Floats
    stress: Floats
    scale: float
    noise: float

    def power(self, origin: float, *, level: bool = True) -> float:
        """Return the power that explains it best from an origin, with a level or from zero."""
        at = int(np.argmin(self._left(origin, GRID, level)))
        near = GRID[max(at - 1, 0)], GRID[min(at + 1, GRID.size - 1)]
        best = minimize_scalar(
            lambda n: float(self._left(origin, np.array([n]), level)[0]),
            bounds=near,
            method="bounded",
            options={"xatol": 1e-6},
        )
        return float(best.x)

    def misfit(self, origin: float, *, level: bool = True) -> float:
        """Return the mean square that is left by the best power from an origin."""
        best = np.array([self.power(origin, level=level)])
        return float(self._left(origin, best, level)[0]) + MISFIT**2

    def likelier(self, one: float, other: float) -> float:
        """Return twice the logarithm of the ratio of likelihoods of two misfits."""
        return float(self.strain.size * np.log(other / one))

    @cached_property
    def knee(self) -> float:
        """Return the origin that explains it best."""
        scan = np.linspace(self.strain[0], self.strain[-4], 30)
        best = int(np.argmin([self._left(one, GRID, True).min() for one in scan]))
        near = scan[max(best - 2, 0)], scan[min(best + 2, scan.size - 1)]
        found = minimize_scalar(lambda c: self.misfit(float(c)), bounds=near, method="bounded")
        return float(min(found.x, scan[0], key=self.misfit))

    @property
    def hidden(self) -> float:
        """Return the largest origin that explains it not much worse than zero does."""
        scan, zero = np.linspace(0, self.strain[-4], 30), self.misfit(0.0)
        like = [self.likelier(zero, self.misfit(float(one))) < LIKELIER for one in scan]
        return float(scan[int(np.argmin([*like, False])) - 1])

    @property
    def adequate(self) -> bool:
        """Whether a power from the best origin explains it."""
        return self.explains(self.misfit(self.knee))

    def explains(self, misfit: float) -> bool:
        """Tell whether a misfit is no more than noise."""
        return misfit <= (ADEQUATE * self.noise) ** 2 + 2 * MISFIT**2

    def level(self, origin: float) -> tuple[float, float]:
        """Return the stress before an origin, Pa, and its standard error."""
        n = self.power(origin)
        x = np.maximum(self.strain - origin, 1e-12)
        A = np.column_stack([np.ones_like(x), x**n, x**n * np.log(x)])
        # The power is as free as level and factor: about its best value it enters by its slope.
        left = (self.misfit(origin) - MISFIT**2) * x.size / max(x.size - 3, 1)
        level = np.linalg.lstsq(A[:, :2], self.stress, rcond=None)[0][0]
        error = np.sqrt(left * np.linalg.pinv(A.T @ A)[0, 0])
        return float(level) * self.scale, float(error) * self.scale

    def _left(self, origin: float, powers: Floats, level: bool) -> Floats:
        """Return the mean square that is left by each power, shape (k,)."""
        x = np.maximum(self.strain - origin, 0) ** powers[:, None]
        y = self.stress
        if level:
            x, y = x - x.mean(axis=1, keepdims=True), y - y.mean()
        factor = x @ y / np.maximum(np.sum(x**2, axis=1), 1e-300)
        return np.asarray(np.mean((y - factor[:, None] * x) ** 2, axis=1))


def toe(strain: Floats, stress: Floats) -> Toe:
    """Return the beginning of a curve of 12 rows or more, as much as a power explains."""
    rise = float(stress.max() - stress[0])
    for share in SHARES:
        over = stress >= stress[0] + share * rise
        last = max(FEWEST, int(np.argmax(over)) + 1)
        scale = float(np.ptp(stress[:last]))
        found = Toe(strain[:last], stress[:last] / scale, scale, noise(stress) / scale)
        if found.adequate:
            break
    return found


def noise(stress: Floats) -> float:
    """Return the noise of a smooth curve, a standard deviation, by its third differences."""
    return float(1.4826 * np.median(np.abs(np.diff(stress, 3))) / 20**0.5)
