"""How time and memory of step responses grow with the number of runs."""

import tracemalloc
from collections.abc import Sequence
from inspect import signature

import numpy as np

from softgrip.dynamics.ludwick import step_responses
from tests.bench.entry import Entry, interleaved
from tests.bench.fingers import Batch, batch, run

STEP = 0.025
"""What `fingers.choose_step` chooses for these fingers, s."""
LIMIT: float = signature(step_responses).parameters["limit"].default
"""Of the output that `step_responses` holds at a time, bytes."""


def peak_memory(given: Batch) -> float:
    """Return the largest memory that the responses take at a time, MB."""
    tracemalloc.start()
    try:
        run(given, STEP)
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


def exponent(runs: Sequence[int], seconds: np.ndarray) -> float:
    """Return p of ``seconds ~ runs**p``, by least squares of the logarithms."""
    return float(np.polyfit(np.log(runs), np.log(seconds), 1)[0])


def entries(
    *, runs: Sequence[int] = (100, 316, 1000, 3162, 10_000), repetitions: int = 5
) -> list[Entry]:
    """Return the exponent of the time, over all and over the larger half, and the memory."""
    batches = [batch(count) for count in runs]
    works = [lambda given=given: run(given, STEP) for given in batches]
    seconds = np.median(interleaved(*works, repetitions=repetitions), axis=0)
    listed = ", ".join(f"{n:,}: {1e3 * s:.0f} ms" for n, s in zip(runs, seconds, strict=True))
    middle = len(runs) // 2
    found = []
    for first in (0, middle):
        power = exponent(runs[first:], seconds[first:])
        found.append(
            Entry(
                f"growth of time, {runs[first]:,} to {runs[-1]:,} runs",
                power,
                "exponent",
                1.0,
                1 / power,
                "0.8 to 1.1",
                0.8 <= power <= 1.1,
                f"Log-log fit of medians of {repetitions} ({listed}). Below 1 means cheaper by"
                " the run: what a step costs beside its numbers is shared by more runs.",
            )
        )
    largest = batches[-1]
    peak = peak_memory(largest)
    whole = 8e-6 * largest.times.size * largest.runs
    most = 1.5 * LIMIT / 1e6
    found.append(
        Entry(
            f"peak memory, {runs[-1]:,} runs",
            peak,
            "MB",
            whole,
            whole / peak,
            f"<= {most:g} MB",
            peak <= most,
            "By tracemalloc, of all NumPy arrays. Baseline: what the output alone takes if kept."
            f" {runs[middle]:,} runs take {peak_memory(batches[middle]):.3g} MB."
            f" The output is held {LIMIT / 1e6:g} MB at a time, at most.",
        )
    )
    return found
