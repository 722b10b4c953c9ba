"""A walk along the ensemble: some of its rigs in the order of their power, and what each misses."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from book.twin.fitted import ensemble
from book.twin.misfit import chosen, misfit
from book.twin.problem import error_of
from book.twin.space import space

PLACES = 9
"""On the walk, even in the number of rigs between them, both ends of the ensemble among them."""


@dataclass(frozen=True)
class Miss:
    """By how much a rig of the walk misses a target.

    Attributes:
        place: On the walk, from 0.
        id: Of the target.
        errors: By how many of its errors, those of print and model; above zero where the rig gives
            more than is printed.
    """

    place: int
    id: str
    errors: float


def places() -> list[int]:
    """Return which rigs of the ensemble are on the walk."""
    order = np.argsort(ensemble()[:, [*space()].index("rubber.power")], kind="stable")
    at = np.linspace(0, len(order) - 1, PLACES).round().astype(int)
    return [int(k) for k in order[at]]


def misses() -> Iterator[Miss]:
    """Run the rigs of the walk."""
    off = misfit(ensemble()[places()])
    for place, own in enumerate(off.tolist()):
        for target, miss in zip(chosen(), own, strict=True):
            yield Miss(place, target.id, miss / error_of(target))
