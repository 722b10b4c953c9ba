"""A loop of equal steps: run on numbers, recorded on symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, is_symbol

# An array times a symbol is a column of symbols. In the newer mode, which CasADi recommends in a
# warning, it is a row if the array comes first, and a column if the symbol does.
ca.GlobalOptions.setNumpyMode(-1)

Numbers = Sequence[Number]
Step = Callable[[Numbers, Numbers, Numbers], tuple[Numbers, Numbers]]
"""From state, a row of the table, and what is given, to the next state and what comes out."""


@dataclass(frozen=True)
class Scan:
    """A recorded loop.

    Attributes:
        before: From all that was known before to the first state and what is given.
        step: From state, row and what is given to the next state and what comes out.
        rows: shape (N, columns).
    """

    before: ca.Function
    step: ca.Function
    rows: Floats


@dataclass
class Recorder:
    """What a law does with symbols: the loops it runs, and what is known after each.

    Attributes:
        known: The parameters, then what came out of each loop, shape (N, outputs).
        scans: The loops, in order.
    """

    known: list[ca.SX]
    scans: list[Scan] = field(default_factory=list)

    def scan(self, step: Step, start: Numbers, rows: Floats, given: Numbers) -> list[ca.SX]:
        """Record a loop, and return the symbols that stand for what comes out of it."""
        state, row, told = (
            ca.SX.sym(name, count)
            for name, count in (("x", len(start)), ("u", rows.shape[1]), ("g", len(given)))
        )
        after, out = step(*(ca.vertsplit(v) if v.numel() else [] for v in (state, row, told)))
        self.scans.append(
            Scan(
                ca.Function("before", self.known, [column(start), column(given)]),
                ca.Function("step", [state, row, told], [column(after), column(out)]),
                rows,
            )
        )
        found = ca.SX.sym(f"loop{len(self.scans)}", len(rows), len(out))
        self.known.append(found)
        return [found[:, j] for j in range(len(out))]


_RECORDER: ContextVar[Recorder | None] = ContextVar("recorder", default=None)


def column(values: Any) -> ca.SX:
    """Return a number, numbers or symbols as a dense column of symbols."""
    if isinstance(values, list | tuple):
        values = ca.vertcat(*values)
    elif not is_symbol(values):
        values = np.ravel(values).astype(float)
    return ca.densify(ca.SX(values))


@contextmanager
def recording(parameters: ca.SX) -> Iterator[Recorder]:
    """Record the loops of a law that is called with symbols."""
    recorder = Recorder([parameters])
    token = _RECORDER.set(recorder)
    try:
        yield recorder
    finally:
        _RECORDER.reset(token)


def scan(step: Step, start: Numbers, rows: ArrayLike, given: Numbers = ()) -> list[Any]:
    """Return what comes out of each step of a loop, one array of shape (N,) an output.

    Args:
        step: A pure function; what it needs beside state and row comes in as `given`.
        start: The first state.
        rows: Numbers for each step, shape (N,) or (N, columns).
        given: Numbers that stay the same.

    >>> total, = scan(lambda x, u, g: ([x[0] + g[0] * u[0]], [x[0]]), [0.0], [1, 2, 3], [10.0])
    >>> total.tolist()
    [0.0, 10.0, 30.0]
    """
    table = np.asarray(rows, dtype=np.float64)
    table = table.reshape(len(table), -1)
    if any(map(is_symbol, [*start, *given])):
        recorder = _RECORDER.get()
        if recorder is None:
            raise RuntimeError("symbols are scanned while a law is recorded")
        return recorder.scan(step, start, table, given)
    state: Numbers = list(start)
    found = []
    for row in table:
        state, out = step(state, row.tolist(), given)
        found.append(out)
    return [np.array(values) for values in zip(*found, strict=True)]


def total(values: Any) -> Number:
    """Return the sum of numbers or symbols, shape (N,)."""
    return ca.sum1(values) if is_symbol(values) else np.sum(values, axis=0)
