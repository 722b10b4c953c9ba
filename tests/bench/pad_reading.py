"""One reading of the pad, from eight responses and one voltage to kind, place and force."""

from collections.abc import Callable
from time import thread_time_ns

import numpy as np

from softgrip.logs.contacts import read_contacts
from softgrip.provenance import data_file
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.tactile.contact_pose import place
from softgrip.tactile.fast_kind import FastKind
from softgrip.tactile.nadaraya_watson import NadarayaWatson
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from tests.bench.entry import Entry, entry

PARTS = ("kind", "place", "force")
WANTED = 10.0
"""How many times less of the processor's time than with scikit-learn's own bagging, in one run:
the ratio is the code's, milliseconds are the machine's and of what else it does."""
WEIGHTS = 69
"""Points that the force is read from, as in Section 2.3."""


def _times(parts: tuple[Callable[[int], object], ...], count: int) -> np.ndarray:
    """Return what each part of each reading takes of the processor's time, ms."""
    taken = np.empty((count, len(parts)))
    for k in range(count):
        marks = [thread_time_ns()]
        for part in parts:
            part(k)
            marks.append(thread_time_ns())
        taken[k] = np.diff(marks)
    taken /= 1e6
    return taken


def entries(*, count: int = 5000, plain: int = 200, repetitions: int = 3) -> list[Entry]:
    """Return median and 99th percentile of a reading, beside scikit-learn's own bagging."""
    training, new = (
        read_contacts(data_file(f"simulated/pad-{name}.csv").path)
        for name in ("training", "objects")
    )
    model = bagged_neighbours().fit(training.responses, training.kinds)
    fast = FastKind.from_fitted(model)
    rng = np.random.default_rng(0)
    voltage = rng.random((WEIGHTS, 1))
    force = NadarayaWatson(bandwidth=0.05).fit(voltage, 0.7 * voltage[:, 0] ** 2)
    readings = new.responses[rng.integers(0, len(new), count)]
    same = all(
        (fast.predict_proba(r) == model.predict_proba(r[None])[0]).all() for r in readings[:50]
    )

    def reading(kind: Callable[[np.ndarray], object]) -> tuple[Callable[[int], object], ...]:
        return (
            lambda k: kind(readings[k]),
            lambda k: place(readings[k], THREE_TWO_THREE),
            lambda k: force.predict(voltage[k % WEIGHTS, None]),
        )

    ours = reading(fast.predict)
    theirs = reading(lambda response: model.predict(response[None]))
    _times(ours, min(count, 200))
    turns = [(_times(ours, count), _times(theirs, plain)) for _ in range(repetitions)]
    parts = np.array([turn[0] for turn in turns])
    whole = parts.sum(axis=2)
    baseline = np.array([turn[1].sum(axis=1) for turn in turns])
    listed = ", ".join(f"{part} {np.median(parts[..., k]):.3f}" for k, part in enumerate(PARTS))
    found = []
    for percent in (50, 99):
        each = np.percentile(whole, percent, axis=1)
        value = float(np.median(each))
        other = float(np.median(np.percentile(baseline, percent, axis=1)))
        found.append(
            entry(
                f"pad reading, p{percent}", value, "ms", other,
                f"ratio >= {WANTED:g}", other / value >= WANTED,
                f"{count:,} readings of the simulated pad to kind, place and force, one at a time,"
                f" the processor's time; baseline: the same with scikit-learn's own bagging"
                f" ({plain} readings), whose shares of votes are"
                f" {'the same' if same else 'NOT the same'} to the bit."
                f" Median of {repetitions} turns ({each.min():.3f} to {each.max():.3f} ms)."
                f" Median of each part, ms: {listed}. Slowest reading {whole.max():.2f} ms.",
            )
        )  # fmt: skip
    return found
