"""The problem in blocks that share no parameter: each is fitted by itself, with sizes of its own.

A contact of the pad is felt by no finger, and what is made of it takes seconds a rig.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from book.twin.problem import Problem, printed
from book.twin.recipes import FAST
from book.twin.smoother import RIGS, ROUNDS
from book.twin.space import space
from softgrip.arrays import Floats


@dataclass(frozen=True)
class Block:
    """Experiments that are fitted together, and how much is spent on them.

    Attributes:
        experiments: Names in `recipes.ALL`.
        rigs, rounds: Of the smoother.
        generations: Of the evolution strategy.
        brood: Rigs of a generation.
    """

    experiments: tuple[str, ...]
    rigs: int
    rounds: int
    generations: int
    brood: int

    def problem(self) -> Problem:
        """Return the problem of its prints."""
        return printed(self.experiments)


PAD = ("pad elements", "kinds")
BLOCKS: Mapping[str, Block] = MappingProxyType(
    {
        "rig": Block(tuple(name for name in FAST if name not in PAD), RIGS, ROUNDS, 10, 96),
        "pad": Block(PAD, 64, 3, 6, 12),
    }
)


def put_together(parts: Sequence[tuple[Problem, Floats]]) -> Floats:
    """Return rows of all parameters, each from the block whose problem it is free in.

    Args:
        parts: Problems, and rows of all parameters, of one shape (rigs, parameters).
    """
    names = [*space()]
    (_, first), *others = parts
    made = first.copy()
    for problem, rows in others:
        own = [names.index(one.name) for one in problem.free]
        made[:, own] = rows[:, own]
    return made


def drawn(rows: Floats, count: int, seed: int) -> Floats:
    """Return so many rows, each of the given ones as often as the others, in random order.

    >>> np.sort(drawn(np.array([[1.0], [2.0]]), 4, seed=0), axis=0).ravel().tolist()
    [1.0, 1.0, 2.0, 2.0]
    """
    order = np.random.default_rng(seed).permutation(len(rows))
    return np.asarray(rows[np.resize(order, count)])
