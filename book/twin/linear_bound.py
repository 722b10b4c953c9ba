"""The bound up to which "a linear model will do", settled after the fit.

It moves nothing but what is printed of the linear range, and takes steps of many sizes to hold
against: so it is no variable of the fit, but the one scalar that is chosen for each rig such that
these prints are missed the least. They are consequences of the fit, with one nuisance parameter.
"""

from dataclasses import dataclass

import numpy as np

from book.twin.misfit import PENALTY, chosen, laboratory
from book.twin.problem import error_of
from book.twin.space import space
from book.twin.step_tests import SLOW, linear_errors, reached
from book.twin.targets import Target
from softgrip.arrays import Floats

NAME = "choice.linear_bound"
TRIED = 121
"""Bounds over the range: a twentieth of a degree apart."""


@dataclass(frozen=True, eq=False)
class Ranges:
    """What each bound makes of the linear ranges of some rigs.

    Attributes:
        targets: Those printed of them.
        bounds: That were tried, deg, shape (bounds,).
        off: Misses, tolerances, shape (bounds, rigs, targets).
    """

    targets: tuple[Target, ...]
    bounds: Floats
    off: Floats

    def settled(self) -> Floats:
        """Return the bound of the least sum of squares of the misses in errors, shape (rigs,)."""
        errors = np.array([error_of(one) for one in self.targets])
        cost = np.sum((self.off / errors) ** 2, axis=2)
        return np.asarray(self.bounds[np.argmin(cost, axis=0)])

    def nearest(self, target: int) -> tuple[int, float]:
        """Return which rig, with which bound, comes nearest to a target."""
        bound, rig = np.unravel_index(np.argmin(np.abs(self.off[..., target])), self.off.shape[:2])
        return int(rig), float(self.bounds[bound])


def ranges(rows: Floats) -> Ranges:
    """Try the bounds on rigs, rows in the order of `space`, shape (rigs, parameters)."""
    bounds = space()[NAME].at(np.linspace(0, 1, TRIED))
    wanted = chosen(SLOW)
    with np.errstate(all="ignore"):  # a step that no finger reaches identifies nothing
        errors = linear_errors(laboratory(rows), np.full(len(rows), bounds[-1]))
    off = [
        one.off(np.stack([reached(errors[one.quantity], np.full(len(rows), b)) for b in bounds]))
        / one.tolerance
        for one in wanted
    ]
    return Ranges(wanted, bounds, np.clip(np.stack(off, axis=2), -PENALTY, PENALTY))


def with_bound(rows: Floats, bounds: float | Floats) -> Floats:
    """Return rows with other bounds, deg."""
    made = rows.copy()
    made[:, [*space()].index(NAME)] = bounds
    return made
