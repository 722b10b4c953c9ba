"""One step of the controller, capacity filter and PID, as the loop of 25 ms would run it."""

import gc
from time import thread_time_ns

import numpy as np

from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.pump import elastance
from tests.bench.entry import Entry, entry

PARTS = ("transition", "predict", "update", "PID")
WANTED = 0.01
"""Part of the loop's period that a step may take, of the processor's time."""
SPREAD = 10.0
"""How many medians of the same run the slowest percent may begin at: shared caches spread the
processor's time by a few, a step that does other work than the rest by more."""

MODEL = elastance.ElastanceModel(
    PERIOD,
    elastance.NoiseLevels(pressure_step=10.0, elastance_step=1e7, sensor=500.0),
    elastance.Prior(pressure=0.0, pressure_std=1e3, elastance=1e9, elastance_std=2e8),
    angle_gain=1e7,
)


def steps(count: int) -> np.ndarray:
    """Return what each part of each step took, ms, shape (count, parts).

    By the processor's time of this thread: what else the machine does is not the controller's.
    """
    rng = np.random.default_rng(0)
    pressure = rng.normal(5e4, 500.0, count).tolist()
    angle = np.cumsum(rng.normal(0, 1e-3, count)).tolist()
    kalman = elastance.elastance_filter(MODEL)
    pid = PID(Gains(kp=1.0, ki=2.0, kd=0.1), limits=(-31.4, 31.4))
    taken, last, command = np.empty((count, len(PARTS))), 0.0, 0.0
    for k in range(count):
        marks = [thread_time_ns()]
        F = elastance.transitions([command * 8e-7], PERIOD)[0]
        marks.append(thread_time_ns())
        kalman.predict(u=np.array([[angle[k] - last]]), F=F)
        marks.append(thread_time_ns())
        kalman.update(pressure[k])
        marks.append(thread_time_ns())
        command, last = float(pid.update(1.0, angle[k])), angle[k]
        marks.append(thread_time_ns())
        taken[k] = np.diff(marks) / 1e6
    return taken


def without_collector(count: int) -> np.ndarray:
    """Return `steps` with Python's garbage collector off."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        return steps(count)
    finally:
        if was_on:
            gc.enable()


def entries(*, count: int = 20_000, repetitions: int = 3) -> list[Entry]:
    """Return the median of a step against the loop's period, the 99th percentile against it."""
    steps(min(count, 500))
    # The two take turns: what differs is then the collector, not the machine's mood.
    turns = [(steps(count), without_collector(count)) for _ in range(repetitions)]
    taken = np.array([on for on, _ in turns])
    whole, quiet = taken.sum(axis=2), np.array([off.sum(axis=1) for _, off in turns])
    slow = whole >= np.percentile(whole, 99, axis=1, keepdims=True)
    listed = ", ".join(
        f"{part} {np.median(taken[..., k]):.3f} ({taken[slow, k].mean():.3f})"
        for k, part in enumerate(PARTS)
    )
    period, middle = 1e3 * PERIOD, float(np.median(np.median(whole, axis=1)))
    found = []
    for percent, baseline, wanted in ((50, period, WANTED * period), (99, middle, SPREAD * middle)):
        each = np.percentile(whole, percent, axis=1)
        value = float(np.median(each))
        off = float(np.median(np.percentile(quiet, percent, axis=1)))
        found.append(
            entry(
                f"controller step, p{percent}", value, "ms", baseline,
                f"< {wanted:.3g} ms", value < wanted,
                f"{count:,} steps of capacity filter and PID, the processor's time; baseline: the"
                f" {'period of the loop' if percent == 50 else 'median of the same run'}."
                f" Median of {repetitions} turns ({each.min():.3f} to {each.max():.3f} ms);"
                f" with the garbage collector off {off:.3f} ms."
                f" Median of each part, ms, and its mean in the slowest 1 %: {listed}."
                f" Slowest step {whole.max():.2f} ms.",
            )
        )  # fmt: skip
    return found
