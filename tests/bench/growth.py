"""How time and memory of step responses grow with the number of runs."""

from collections.abc import Sequence
from inspect import signature

import numpy as np

from softgrip.dynamics.ludwick import step_responses
from tests.bench.entry import Entry, entry, interleaved, peak_memory
from tests.bench.fingers import batch, run

STEP = 0.025
"""What `fingers.choose_step` chooses for these fingers, s."""
LIMIT: float = signature(step_responses).parameters["limit"].default
"""Of the output that `step_responses` holds at a time, bytes."""


def exponent(runs: Sequence[int], seconds: np.ndarray) -> float:
    """Return p of ``seconds ~ runs**p``, by least squares of the logarithms."""
    return float(np.polyfit(np.log(runs), np.log(seconds), 1)[0])


def growth_entry(what: str, counts: Sequence[int], seconds: np.ndarray, note: str) -> Entry:
    """Return the exponent of the time of so many of what is counted."""
    power = exponent(counts, seconds)
    name = f"growth of time, {counts[0]:,} to {counts[-1]:,} {what}"
    return entry(name, power, "exponent", 1.0, "0.8 to 1.1", 0.8 <= power <= 1.1, note)


def listed(counts: Sequence[int], seconds: np.ndarray) -> str:
    """Return the times, in ms, by the number of what is counted."""
    return ", ".join(f"{n:,}: {1e3 * s:.0f} ms" for n, s in zip(counts, seconds, strict=True))


def entries(
    *, runs: Sequence[int] = (100, 316, 1000, 3162, 10_000), repetitions: int = 5
) -> list[Entry]:
    """Return the exponent of the time, over all and over the larger half, and the memory."""
    batches = [batch(count) for count in runs]
    works = [lambda given=given: run(given, STEP) for given in batches]
    seconds = np.median(interleaved(*works, repetitions=repetitions), axis=0)
    middle = len(runs) // 2
    note = (
        f"Log-log fit of medians of {repetitions} ({listed(runs, seconds)}). Below 1 means cheaper"
        " by the run: what a step costs beside its numbers is shared by more runs."
    )
    found = [growth_entry("runs", runs[k:], seconds[k:], note) for k in (0, middle)]
    largest = batches[-1]
    peak, half = (peak_memory(lambda b=b: run(b, STEP)) for b in (largest, batches[middle]))
    whole = 8e-6 * largest.times.size * largest.runs
    most = 1.5 * LIMIT / 1e6
    found.append(
        entry(
            f"peak memory, {runs[-1]:,} runs", peak, "MB", whole, f"<= {most:g} MB", peak <= most,
            "By tracemalloc, of all NumPy arrays. Baseline: what the output alone takes if kept."
            f" {runs[middle]:,} runs take {half:.3g} MB."
            f" The output is held {LIMIT / 1e6:g} MB at a time, at most.",
        )
    )  # fmt: skip
    return found
