"""The simulated rig against real time, singly and in batches."""

import numpy as np

from softgrip.arrays import chunks
from softgrip.simulator.calibration import design_1
from softgrip.simulator.simulation import Simulation
from tests.bench.entry import Entry, entry, interleaved, spread

PERIOD = 0.025
WANTED_SINGLY, WANTED_IN_BATCHES = 50, 5000
SPEED = 8.0
"""Of the motor, rad/s: 4 s in and 4 s out bend the finger and let it back, within the stroke."""
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


def in_batches(speeds: np.ndarray, runs: int) -> int:
    """Run many rigs; return the number of runs."""
    done = 0
    for part in chunks(runs, NUMBERS * 8 * speeds.size):
        count = part.stop - part.start
        rig = Simulation(design_1(), runs=count, seed=1, first=part.start, period=PERIOD)
        done += rig.open_loop(speeds)[0].angle.shape[-1]
    return done


def entries(*, seconds: float = 10.0, runs: int = 1000, repetitions: int = 7) -> list[Entry]:
    """Return the time of one run alone and of one in a batch, against real time."""
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
                "All effects on: memory, ballooning, leak, friction, motor limits, lags, noise,"
                f" converter, spread. Baseline: real time. Median of {repetitions}"
                f" ({spread(times[:, column])} a run).",
            )
        )  # fmt: skip
    return found
