"""One sample of the force layer without its drift: found pauses, filter, correction, force."""

from time import thread_time_ns

import numpy as np

from softgrip.board.protocol import TELEMETRY_PERIOD
from softgrip.tactile.drift_curve import Curve
from softgrip.tactile.drift_filter import DriftFilter
from softgrip.tactile.drift_law import Bridge
from softgrip.tactile.nadaraya_watson import NadarayaWatson
from softgrip.tactile.own_pad import PadReadings
from tests.bench.entry import Entry, entry

WANTED = 5.0
"""ms of the processor's time, that the slowest percent of samples may begin at."""
FORCES = np.linspace(0, 0.7, 69)
"""Known forces of a calibration, N; their number is that of Section 2.3."""


def _samples(count: int) -> np.ndarray:
    """Return what each part of each sample takes of the processor's time, ms, shape (count, 2)."""
    voltage = 0.5 + 4 * -np.expm1(-FORCES / 0.35)
    readings = PadReadings(("layer",), voltage[:, None], FORCES)
    model = NadarayaWatson(bandwidth=0.05).fit(voltage[:, None], FORCES)
    drift = DriftFilter(Curve.of(readings), law=Bridge(25.0, 0.05), noise=0.003)
    noise = np.random.default_rng(0).normal(0, 0.003, count)
    # Half a minute of load, half a minute of pause.
    loaded = (np.arange(count) * TELEMETRY_PERIOD) % 60 > 30
    seen = (0.5 + 2.0 * loaded + noise).tolist()
    taken = np.empty((count, 2))
    for k, sample in enumerate(seen):
        marks = [thread_time_ns()]
        fresh = drift.step(k * TELEMETRY_PERIOD, sample)
        marks.append(thread_time_ns())
        model.predict([[fresh]])
        marks.append(thread_time_ns())
        taken[k] = np.diff(marks) / 1e6
    assert count < 20_000 or len(drift.events) > 1
    return taken


def entries(*, count: int = 40_000, repetitions: int = 3) -> list[Entry]:
    """Return median and 99th percentile of a sample, and the slowest, against the period."""
    _samples(min(count, 500))
    parts = np.array([_samples(count) for _ in range(repetitions)])
    whole, period = parts.sum(axis=2), 1e3 * TELEMETRY_PERIOD
    listed = ", ".join(
        f"{part} {np.median(parts[..., k]):.3f}" for k, part in enumerate(("drift", "force"))
    )
    found = []
    for percent in (50, 99):
        each = np.percentile(whole, percent, axis=1)
        value = float(np.median(each))
        found.append(
            entry(
                f"drift, a sample, p{percent}", value, "ms", period,
                f"< {WANTED:g} ms", value < WANTED,
                f"{count:,} samples at {1 / TELEMETRY_PERIOD:g} Hz, pauses among them, to a force"
                f" without drift, one at a time, the processor's time; baseline: the board's"
                f" period. Median of {repetitions} turns ({each.min():.3f} to {each.max():.3f} ms)."
                f" Median of each part, ms: {listed}. Slowest sample, with an update of the filter,"
                f" {whole.max():.2f} ms.",
            )
        )  # fmt: skip
    return found
