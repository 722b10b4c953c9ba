"""Many rigs through the twin's experiments: the time of each, and the memory of a process."""

import re
from collections.abc import Collection
from pathlib import Path

import numpy as np
from joblib import Parallel, delayed

from book.twin.misfit import RIGS, misfit
from book.twin.recipes import FAST
from book.twin.space import space
from tests.bench.entry import Entry, entry, timed

PROCESSES = 2
MANY, WANTED = 100_000, 20 * 60.0
"""Rigs of an inference, and the seconds that they may take."""
WANTED_MEMORY = 1000.0
"""MB, of a process."""


def rows(rigs: int) -> np.ndarray:
    """Return rigs from all over the space, shape (rigs, parameters)."""
    chance = np.random.default_rng(1)
    return np.transpose([one.at(chance.random(rigs)) for one in space().values()])


def peak_resident() -> float:
    """Return the largest memory that this process has taken, MB, as Linux tells it."""
    told = re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text())
    return float(told[1]) * 1024e-6 if told else np.nan


def entries(*, rigs_at_a_time: int = RIGS, experiments: Collection[str] = FAST) -> list[Entry]:
    """Return the time of many rigs by two processes, from two parts, and the memory of one."""
    given = rows(PROCESSES * rigs_at_a_time)

    def run(some: np.ndarray, at_a_time: int) -> float:
        return timed(
            lambda: misfit(some, experiments=experiments, rigs_at_a_time=at_a_time, jobs=PROCESSES)
        )

    # Each process imports and compiles.
    first = run(given[:PROCESSES], 1)
    whole = run(given, rigs_at_a_time) * MANY / len(given)
    # Either process has worked on a part.
    peak = Parallel(n_jobs=PROCESSES)([delayed(peak_resident)()])[0]
    return [
        entry(
            f"twin, {MANY:,} rigs through all fast experiments, {PROCESSES} processes",
            whole, "s", WANTED, "ratio >= 1", whole <= WANTED,
            f"{len(given)} rigs from all over the space, {rigs_at_a_time} at a time, timed and"
            f" scaled. Baseline: {WANTED / 60:g} minutes. To start both processes, once, took"
            f" {first:.0f} s.",
        ),
        entry(
            f"twin, memory of a process, {rigs_at_a_time} rigs at a time",
            peak, "MB", WANTED_MEMORY, "ratio >= 1", peak <= WANTED_MEMORY,
            "Resident at its peak, with all that is imported. Baseline: 1 GB.",
        ),
    ]  # fmt: skip
