"""The inverse problem: which values of the free parameters give the printed numbers.

Each free parameter is a standard normal variable, whose share of the normal distribution is its
share of the declared range: before any target is looked at all of the range is alike, and no value
leaves it.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import ndtr, ndtri
from scipy.stats import qmc

from book.twin.laboratory import Laboratory
from book.twin.misfit import chosen, deviations, misfit
from book.twin.recipes import FAST
from book.twin.space import Parameter, space, values
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


class _Noted(Mapping[str, Floats]):
    """Values, and the names that were asked for."""

    def __init__(self, values: Mapping[str, Floats]) -> None:
        self._values, self.names = values, set[str]()

    def __getitem__(self, name: str) -> Floats:
        self.names.add(name)
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)


def asked(experiment: str, wanted: Collection[Target]) -> frozenset[str]:
    """Return the names of the parameters that an experiment looks at, found by running it."""
    noted = _Noted(values())
    lab = Laboratory(noted, loops=1, steps=2)
    assert lab.count == 1  # which looks at any of them
    noted.names.clear()
    deviations(lab, [one for one in wanted if one.experiment == experiment])
    return frozenset(noted.names)


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
        """The parameters that are sought: free ones that an experiment looks at."""
        looked = frozenset().union(*self._looked.values())
        return tuple(p for p in space().values() if p.status == "free" and p.name in looked)

    @cached_property
    def _looked(self) -> dict[str, frozenset[str]]:
        return {name: asked(name, self.targets) for name in self.experiments}

    @cached_property
    def touched(self) -> Flags:
        """Which target each free parameter can move, shape (free, targets)."""
        looked = [self._looked[one.experiment] for one in self.targets]
        return np.array([[p.name in names for names in looked] for p in self.free])

    def rows(self, x: Floats) -> Floats:
        """Return the values of all parameters for variables, shape (rigs, free).

        Those that are not sought have the value of the file.

        Returns:
            Floats: Shape (rigs, parameters), in the order of `space`.
        """
        found = {name: np.full(len(x), one.value) for name, one in space().items()}
        found |= {p.name: p.at(share) for p, share in zip(self.free, ndtr(x).T, strict=True)}
        return np.stack(list(found.values()), axis=1)

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
        return misfit(self.rows(x), experiments=self.experiments, jobs=jobs, progress=progress)

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
