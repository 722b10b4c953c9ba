"""What the bench says of one subject, and how it takes times."""

import json
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter

import numpy as np


@dataclass(frozen=True)
class Entry:
    """One line of the bench.

    Attributes:
        name: What was measured.
        value: What came out.
        unit: Of the value and the baseline.
        baseline: What the value is held against, measured in the same run or named in the note; or
            None.
        ratio: Baseline over value; None without a baseline.
        wanted: What is wanted, in words.
        met: Whether it is; None where nothing is wanted.
        note: How it was measured.
    """

    name: str
    value: float
    unit: str
    baseline: float | None
    ratio: float | None
    wanted: str
    met: bool | None
    note: str


def entry(
    name: str,
    value: float,
    unit: str,
    baseline: float | None,
    wanted: str,
    met: bool | None,
    note: str,
) -> Entry:
    """Return an entry with its ratio."""
    ratio = None if baseline is None else baseline / value
    return Entry(name, value, unit, baseline, ratio, wanted, met, note)


def peak_memory(function: Callable[[], object]) -> float:
    """Return the largest memory that one call takes at a time, MB, by tracemalloc."""
    tracemalloc.start()
    try:
        function()
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


def timed(function: Callable[[], object]) -> float:
    """Return the seconds that one call takes."""
    start = perf_counter()
    function()
    return perf_counter() - start


def interleaved(*functions: Callable[[], object], repetitions: int) -> np.ndarray:
    """Return the seconds of each call, shape (repetitions, functions).

    The functions take turns, so that a machine that slows down slows all of them. A first round
    is thrown away.
    """
    taken = [[timed(function) for function in functions] for _ in range(repetitions + 1)]
    return np.array(taken[1:])


def spread(times: np.ndarray) -> str:
    """Return the range of some seconds, in ms."""
    return f"{1e3 * times.min():.3g} to {1e3 * times.max():.3g} ms"


def write(entries: Sequence[Entry], path: Path) -> None:
    """Write the entries as JSON."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps([asdict(entry) for entry in entries], indent=2) + "\n")


def table(entries: Sequence[Entry]) -> str:
    """Return the entries as text."""
    rows = [("subject", "value", "unit", "baseline", "ratio", "wanted", "met")]
    for entry in entries:
        numbers = ["" if v is None else f"{v:.3g}" for v in (entry.baseline, entry.ratio)]
        met = {True: "yes", False: "NO", None: ""}[entry.met]
        rows.append((entry.name, f"{entry.value:.3g}", entry.unit, *numbers, entry.wanted, met))
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = ["  ".join(c.ljust(w) for c, w in zip(r, widths, strict=True)).rstrip() for r in rows]
    return "\n".join([*lines, "", *(f"{entry.name}: {entry.note}" for entry in entries)])
