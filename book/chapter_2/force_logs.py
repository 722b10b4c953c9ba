"""Logs of the simulated force-measurement layer: ``python -m book.chapter_2.force_logs``.

What is done with the layer (weights, objects, cycles, long runs), and the logs of it: one row a
reading, with the true weight as the command; what lies on the layer is in the event.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from softgrip.errors import UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance, data_file, data_folder
from softgrip.simulator.chance import SEED, streams
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import ForceLayer, felt_force
from softgrip.simulator.force_tests import (
    PERIOD,
    REPETITIONS,
    UNLOADED,
    Reading,
    put_down,
    reading,
    weight_forces,
)
from softgrip.tactile.drift import DRIFT_WEIGHTS
from softgrip.tactile.force import table_2_2
from softgrip.units import GRAM_FORCE

CYCLE_FORCES = (0.2, 0.5, 0.7)
"""Of Figure 2.8 (b), N."""

RAMP, HOLD, REST = 2.0, 3.0, 3.0
"""s, of a cycle: up and down, at the force, and at zero. Assumed; the text gives none."""

BETWEEN = 172.0
"""s between two weights of a long run: twenty of them take an hour. Assumed."""

LONG_WEIGHTS = (10.0, 25.0, 40.0, 60.0)
"""Weights of a long run, gram-force, in turn; between those that the drift is fitted to."""


def load_and_unload(*, seed: int, run: int, layer: ForceLayer | None = None) -> Reading:
    """Return the cycles of Figure 2.8 (b): each force three times, sampled throughout."""
    layer = layer or fitted_layer()
    corners = np.cumsum([0.0, RAMP, HOLD, RAMP, REST])
    shape = np.interp(np.arange(0, corners[-1], PERIOD), corners, [0, 1, 1, 0, 0])
    force = np.concatenate([peak * np.tile(shape, REPETITIONS) for peak in CYCLE_FORCES])
    time = PERIOD * np.arange(len(force), dtype=np.float64)
    noise = streams(seed, run)[1].standard_normal(len(force))
    return reading(time, force, felt_force(force, PERIOD, layer), 0.0, noise, layer)


def long_run(age: float, *, seed: int, run: int, layer: ForceLayer | None = None) -> Reading:
    """Return an hour: the weights for the drift, twenty others, those for the drift again.

    Args:
        age: h, since the calibration.
        seed, run, layer: As of `put_down`.
    """
    forces = [*DRIFT_WEIGHTS, *LONG_WEIGHTS * 5, *DRIFT_WEIGHTS]
    ends = len(DRIFT_WEIGHTS)
    pauses = np.full(len(forces), BETWEEN)
    pauses[:ends] = pauses[-ends:] = UNLOADED
    weights = np.array(forces) * GRAM_FORCE
    return put_down(weights, seed=seed, run=run, layer=layer, age=age, unloaded=pauses)


COMMAND = "python -m book.chapter_2.force_logs"
TIMES = 10
"""Section 2.4: each object is measured ten times."""

AGES = (0.0, 1.0, 2.0, 4.0, 8.0)
"""h after the calibration, at which long runs begin."""

RUNS = {
    "weights": 0,
    "cycles": 1,
    "objects": 2,
    **{f"long-{age:g}h": 3 + k for k, age in enumerate(AGES)},
}
"""Logs, and the number of the run of each in `SEED`."""

SHOWS = {
    "weights": "Figure 2.8 (a), the 22 weights and none, three times each",
    "cycles": "Figure 2.8 (b), three cycles of loading and unloading to each of three forces",
    "objects": "Table 2.2, five objects ten times each",
}


@dataclass(frozen=True)
class LayerLog:
    """Readings, and the names of what lay on the layer, shape (N,); empty for weights."""

    reading: Reading
    names: tuple[str, ...] = ()


def simulate(name: str) -> LayerLog:
    """Make a log; `name` is a key of `RUNS`.

    Raises:
        UnknownNameError: If there is no such log.
    """
    if name not in RUNS:
        raise UnknownNameError("log of the force layer", name, [*RUNS])
    run = RUNS[name]
    if name == "weights":
        return LayerLog(put_down(weight_forces(), seed=SEED, run=run))
    if name == "cycles":
        return LayerLog(load_and_unload(seed=SEED, run=run))
    if name == "objects":
        objects = table_2_2()
        forces = np.repeat([weighed.true for weighed in objects.values()], TIMES)
        found = put_down(forces, seed=SEED, run=run, seating=fitted_layer().object_seating)
        return LayerLog(found, tuple(np.repeat([*objects], TIMES).tolist()))
    return LayerLog(long_run(AGES[run - 3], seed=SEED, run=run))


def file_of(name: str) -> str:
    """Return the path of a log below ``data/``."""
    return f"simulated/force-{name}.csv"


def read(name: str) -> pd.DataFrame:
    """Read a kept log; `name` is a key of `RUNS`, or "long" for all the long ones.

    Returns:
        DataFrame: Time (s), counts, voltage (V) and weight (N); the object, where there is one; the
            start (h) after the calibration, of long runs.
    """
    if name == "long":
        runs = [read(f"long-{age:g}h").assign(**{"start [h]": age}) for age in AGES]
        return pd.concat(runs, ignore_index=True)
    log = read_log(data_file(file_of(name)).path)
    frame = pd.DataFrame(
        {
            "time [s]": log["time"],
            "counts": log["layer_counts"].astype(int),
            "voltage [V]": log["layer"],
            "weight [N]": log["command"],
        }
    )
    return frame.assign(object=[words for _, words in log.events]) if log.events else frame


def write(folder: Path | None = None) -> Iterator[Path]:
    """Make all logs anew, below ``data/`` or another folder; yields each path when it is done."""
    for name in RUNS:
        path = (folder or data_folder()) / file_of(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.unlink(missing_ok=True)
        _write(name, simulate(name), path)
        yield path


def _write(name: str, made: LayerLog, path: Path) -> None:
    found = made.reading
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=COMMAND,
        back_end="simulated rig",
        period=float(found.time[1] - found.time[0]),
        seed=f"{SEED} run {RUNS[name]}",
        notes={"shows": SHOWS.get(name, "Figure 2.G, four weights again and again for an hour")},
        set_up="layer",
    )
    with LogWriter(path, header) as log:
        for k, event in enumerate(made.names or [""] * found.time.size):
            log.write(
                time=round(float(found.time[k]), 6),
                command=round(float(found.force[k]), 9),
                layer_counts=int(found.counts[k]),
                layer=round(float(found.voltage[k]), 6),
                event=event,
            )


if __name__ == "__main__":
    for written in write():
        print(written)
