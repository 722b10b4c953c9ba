"""The inverse problem: which values of the free parameters give the printed numbers.

Each free parameter is a standard normal variable, whose share of the normal distribution is its
share of the declared range: before any target is looked at all of the range is alike, and no value
leaves it.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from types import MappingProxyType

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from book.twin.misfit import chosen, misfit
from book.twin.recipes import FAST
from book.twin.space import Parameter, space
from book.twin.targets import Target
from softgrip.arrays import Flags, Floats
from softgrip.errors import InvalidInputError

MODEL_ERROR = 0.05
"""Of a print: by so much a simulator may be off that stands for a laboratory, as in the ledger's
*close*."""
FULL = 3.0
"""Errors up to which a miss counts in full; beyond, by its logarithm. A hundred tolerances mean
that an experiment failed, and are no measure of how far off the rig is."""
FURTHEST = 5.0
"""Largest size of a variable: beyond it is a three-millionth of a range."""


POINTS = 8
"""Rigs about which it is tried what moves what: at one, an experiment may fail and tell nothing."""

DECLARED = MappingProxyType({"kinds": "pad."})
"""Experiments of which it takes too long to try what moves them, and the group of the parameters
that they look at."""

SEEN = 1e-6
"""Tolerances: what moves a target by less is rounding, which hangs on the other rigs of a part."""


def sought() -> tuple[Parameter, ...]:
    """Return the free parameters of the space."""
    return tuple(one for one in space().values() if one.status == "free")


def values_at(parameters: Collection[Parameter], shares: Floats) -> Floats:
    """Return all values of rigs, of which some parameters stand at shares of their ranges.

    Args:
        parameters: Those; the others have the value of the file.
        shares: Shape (rigs, parameters).

    Returns:
        Floats: Shape (rigs, all parameters), in the order of `space`.
    """
    found = {name: np.full(len(shares), one.value) for name, one in space().items()}
    found |= {p.name: p.at(share) for p, share in zip(parameters, shares.T, strict=True)}
    return np.stack(list(found.values()), axis=1)


@cache
def moves(experiments: tuple[str, ...], jobs: int | None = None) -> Flags:
    """Return which free parameter moves which target, shape (sought, targets): by trying.

    Each is moved by itself, about some rigs that are spread over the space; but what is `DECLARED`.
    """
    free, wanted = sought(), chosen(experiments)
    groups = [DECLARED.get(one.experiment) for one in wanted]
    found = np.array([[g is not None and p.name.startswith(g) for g in groups] for p in free])
    if tried := tuple(name for name in experiments if name not in DECLARED):
        found[:, [group is None for group in groups]] = _tried(free, tried, jobs)
    return found


def _tried(free: Sequence[Parameter], experiments: tuple[str, ...], jobs: int | None) -> Flags:
    shares = qmc.Sobol(2 * len(free), rng=1).random(POINTS)
    about, other = shares[:, : len(free)], shares[:, len(free) :]
    one = np.eye(len(free), dtype=bool)[None]
    moved = np.where(one, other[:, None], about[:, None]).reshape(-1, len(free))
    rows = values_at(free, np.concatenate([about, moved]))
    off = misfit(rows, experiments=experiments, jobs=jobs)
    base, found = off[:POINTS], off[POINTS:].reshape(POINTS, len(free), -1)
    moved_some: Flags = np.any(np.abs(found - base[:, None]) > SEEN, axis=0)
    return moved_some


@dataclass(frozen=True, eq=False)
class Problem:
    """Free parameters, and targets that they are held against.

    Attributes:
        targets: Of `misfit`, in its order.
        observed: What is to be met, in tolerances from the print, shape (targets,): zeros for the
            print itself, other numbers for what a rig of known parameters gives.
        errors: Standard deviations, in tolerances, shape (targets,); infinite for a target that is
            not looked at, and so is predicted.
    """

    targets: tuple[Target, ...]
    observed: Floats
    errors: Floats

    @property
    def experiments(self) -> tuple[str, ...]:
        """Those of the targets."""
        return tuple(dict.fromkeys(one.experiment for one in self.targets))

    @cached_property
    def free(self) -> tuple[Parameter, ...]:
        """The parameters that are sought: free ones that move a target."""
        some = np.flatnonzero(moves(self.experiments).any(axis=1))
        return tuple(sought()[k] for k in some)

    @cached_property
    def touched(self) -> Flags:
        """Which target each free parameter moves, shape (free, targets)."""
        found, every = moves(self.experiments), chosen(self.experiments)
        return found[found.any(axis=1)][:, [every.index(one) for one in self.targets]]

    def rows(self, x: Floats) -> Floats:
        """Return the values of all parameters, as `values_at`, for variables (rigs, free)."""
        return values_at(self.free, ndtr(x))

    def variables(self, rows: Floats) -> Floats:
        """Return the variables of values, the inverse of `rows`."""
        columns = dict(zip(space(), np.atleast_2d(rows).T, strict=True))
        shares = [p.share(columns[p.name]) for p in self.free]
        return np.asarray(np.clip(ndtri(np.stack(shares, axis=1)), -FURTHEST, FURTHEST))

    def prior(self, rigs: int, seed: int) -> Floats:
        """Return variables that fill the ranges evenly, by Sobol's sequence, shape (rigs, free)."""
        shares = qmc.Sobol(len(self.free), rng=seed).random(rigs)
        return np.asarray(np.clip(ndtri(shares), -FURTHEST, FURTHEST))

    def off(self, x: Floats, *, jobs: int | None = None, progress: bool = False) -> Floats:
        """Return by how many tolerances rigs miss the print, shape (rigs, targets)."""
        off = misfit(self.rows(x), experiments=self.experiments, jobs=jobs, progress=progress)
        every = chosen(self.experiments)
        return off[:, [every.index(one) for one in self.targets]]

    def missed(self, off: Floats) -> Floats:
        """Return by how many errors what is observed is missed, those that are far compressed."""
        return compressed((off - self.observed) / self.errors)

    def part(self, which: Flags) -> "Problem":
        """Return the problem with some of its targets."""
        kept = tuple(t for t, own in zip(self.targets, which, strict=True) if own)
        return Problem(kept, self.observed[which], self.errors[which])

    def with_errors(self, errors: Floats) -> "Problem":
        """Return the problem with other errors."""
        return replace(self, errors=errors)


def compressed(errors: Floats) -> Floats:
    """Return misses as they count, in errors, any shape: beyond `FULL` by their logarithm.

    >>> compressed(np.array([-2.0, 3.0, 3.0 * np.e])).round(3).tolist()
    [-2.0, 3.0, 6.0]
    """
    size = np.abs(errors)
    far = FULL * (1 + np.log(np.maximum(size, FULL) / FULL))
    return np.asarray(np.where(size <= FULL, errors, np.sign(errors) * far))


def error_of(target: Target, share: float = MODEL_ERROR) -> float:
    """Return the error of a target in tolerances: that of the print and that of the model."""
    return float(np.hypot(1.0, share * target.value / target.tolerance))


def printed(experiments: Collection[str] = FAST) -> Problem:
    """Return the problem of the print.

    Raises:
        InvalidInputError: If no target is of these experiments.
    """
    wanted = chosen(experiments)
    if not wanted:
        raise InvalidInputError("experiments", expected=f"some of {[*FAST]}", got=[*experiments])
    return Problem(wanted, np.zeros(len(wanted)), np.array([error_of(one) for one in wanted]))
