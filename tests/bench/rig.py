"""The simulated rig against real time, singly, in batches, and compiled."""

import numpy as np

from softgrip.arrays import chunks
from softgrip.simulator.compiled import drive_compiled
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.parts import in_parts
from softgrip.simulator.rig_batch import stacked, take
from softgrip.simulator.simulation import Simulation
from tests.bench.entry import Entry, entry, interleaved, spread, timed
from tests.simulator.rigs import design_1, differing

PERIOD = 0.025
WANTED_SINGLY, WANTED_IN_BATCHES = 50, 5000
WANTED_COMPILED, WANTED_ON_TWO_CORES, WANTED_BY_TWO = 3, 5, 1.7
ALLOWED = 1e-9
"""Largest difference of compiled and NumPy, rad."""
SPEED = 8.0
"""Of the motor, rad/s: 4 s in and 4 s out bend the finger and let it back, within the stroke."""
EFFECTS = (
    "All effects on: memory, ballooning, leak, friction, motor limits, lags, noise, converter,"
    " spread."
)
COMPARED = 128
BATCHES = 4
"""Of two processes, so that what handing out costs does not count: one takes 0.1 s."""
NUMBERS = 25
"""Kept of one run at one sample, with intermediate results: so a part fits into memory."""


def commands(seconds: float) -> np.ndarray:
    """Return motor speeds in and out, rad/s, one a period."""
    time = np.arange(round(seconds / PERIOD)) * PERIOD
    return np.where(time % 8 < 4, SPEED, -SPEED)


def singly(speeds: np.ndarray) -> float:
    """Run one rig as a controller does, a measurement each period; return its last angle, rad."""
    rig = Simulation(design_1(), seed=1, period=PERIOD)
    for speed in speeds:
        found = rig.advance(speed)
    return float(found.angle[0, 0])


def in_batches(speeds: np.ndarray, runs: int, *, memory: float = 64e6) -> int:
    """Run many rigs; return the number of runs."""
    done = 0
    for part in chunks(runs, NUMBERS * 8 * speeds.size, limit=memory):
        count = part.stop - part.start
        rig = Simulation(design_1(), runs=count, seed=1, first=part.start, period=PERIOD)
        done += rig.open_loop(speeds)[0].angle.shape[-1]
    return done


def compiled(
    speeds: np.ndarray, runs: int, rig: RigParameters | None = None, *, jobs: int = 1
) -> np.ndarray:
    """Run many rigs, one for all or all differing, compiled; return their last angles, rad."""
    parameters = design_1() if rig is None else rig

    def work(part: slice) -> np.ndarray:
        some = Simulation(
            take(parameters, part), runs=part.stop - part.start, seed=1, first=part.start,
            period=PERIOD,
        )  # fmt: skip
        return drive_compiled(some, speeds, duration=speeds.size * PERIOD).angle[:, 0, -1]

    # Each of two jobs gets several parts.
    return in_parts(work, runs, 1.0, memory=max(1, runs // 8), jobs=jobs)


def entries(
    *, seconds: float = 10.0, runs: int = 1000, experiment: float = 20.0, repetitions: int = 7
) -> list[Entry]:
    """Return the time of one run alone and of one in a batch, against real time, and compiled."""
    speeds = commands(seconds)
    times = interleaved(
        lambda: singly(speeds), lambda: in_batches(speeds, runs), repetitions=repetitions
    )
    times[:, 1] /= runs
    found = []
    for column, name, wanted in (
        (0, f"simulated rig, one run of {seconds:g} s", WANTED_SINGLY),
        (1, f"simulated rig, one of {runs:,} runs of {seconds:g} s", WANTED_IN_BATCHES),
    ):
        value = float(np.median(times[:, column]))
        found.append(
            entry(
                name, value, "s", seconds, f"ratio >= {wanted:,}", seconds / value >= wanted,
                f"{EFFECTS} Baseline: real time. Median of {repetitions}"
                f" ({spread(times[:, column])} a run).",
            )
        )  # fmt: skip
    return [*found, *_compiled_entries(commands(experiment), runs, (repetitions + 1) // 2)]


def _compiled_entries(speeds: np.ndarray, runs: int, repetitions: int) -> list[Entry]:
    """Return the time of a compiled run, of one rig and of differing ones, and of two processes."""
    first = timed(lambda: compiled(speeds[:1], 1))
    own = stacked(differing(design_1(), runs))
    many = take(own, np.tile(np.arange(runs), BATCHES))
    times = interleaved(
        # NumPy is fastest with all runs at a time.
        lambda: in_batches(speeds, runs, memory=1e9),
        lambda: compiled(speeds, runs),
        lambda: compiled(speeds, runs, own),
        lambda: compiled(speeds, BATCHES * runs, many, jobs=2),
        repetitions=repetitions,
    )
    counts = runs * np.array([1, 1, 1, BATCHES])
    times /= counts
    seconds = speeds.size * PERIOD
    batch, _, differ, _ = (float(value) for value in np.median(times, axis=0))
    on_numpy = "one rig for all on NumPy, all runs at a time"
    found = []
    for column, name, baseline, against, wanted in (
        (1, "compiled", batch, on_numpy, WANTED_COMPILED),
        (2, "compiled, all rigs differ", batch, on_numpy, WANTED_COMPILED),
        (3, "the same by two processes", batch, on_numpy, WANTED_ON_TWO_CORES),
        (3, "two processes against one", differ, "one process", WANTED_BY_TWO),
    ):
        value = float(np.median(times[:, column]))
        found.append(
            entry(
                f"simulated rig, one of {counts[column]:,} runs of {seconds:g} s, {name}",
                value, "s", baseline, f"ratio >= {wanted:g}", baseline / value >= wanted,
                f"{EFFECTS} Baseline: {against}, in turns. Median of {repetitions}"
                f" ({spread(times[:, column])} a run).",
            )
        )  # fmt: skip
    note = "Compiles, or loads what an earlier process has left on disk; not in the times above."
    found.append(entry("simulated rig, first compiled call", first, "s", None, "", None, note))
    return [*found, _agreement(speeds, take(own, slice(0, min(runs, COMPARED))))]


def _agreement(speeds: np.ndarray, rigs: RigParameters) -> Entry:
    """Return the largest difference of the true angles of differing rigs, all samples."""
    _, truth = Simulation(rigs, seed=1, period=PERIOD).open_loop(speeds)
    found = drive_compiled(
        Simulation(rigs, seed=1, period=PERIOD), speeds, duration=speeds.size * PERIOD,
        keep=("true_angle",),
    )  # fmt: skip
    error = float(np.abs(found.true_angle[..., 1:] - truth.angle.T).max())
    return entry(
        "simulated rig, largest difference of compiled and NumPy",
        error, "rad", None, f"< {ALLOWED:g}", error < ALLOWED,
        f"True angles, {truth.angle.shape[-1]} rigs that all differ, {speeds.size * PERIOD:g} s.",
    )  # fmt: skip
