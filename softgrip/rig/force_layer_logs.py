"""Logs of the simulated force-measurement layer: ``python -m softgrip.rig.force_layer_logs``.

Each is a CSV file with a header, one row a reading: time, counts, voltage and the true weight.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from softgrip.errors import UnknownNameError
from softgrip.provenance import data_file, data_folder
from softgrip.rig.force_layer import ForceLayer
from softgrip.rig.force_layer_protocols import (
    Reading,
    load_and_unload,
    long_run,
    put_down,
    weight_forces,
)
from softgrip.tactile.force import table_2_2

COMMAND = "python -m softgrip.rig.force_layer_logs"
SEED = 2024
TIMES = 10
"""Section 2.4: each object is measured ten times."""

AGES = (0.0, 1.0, 2.0, 4.0, 8.0)
"""h after the calibration, at which long runs begin."""

RUNS = {"weights": 0, "cycles": 1, "objects": 2, "long": 3}
"""Logs, and the number of the first run of each in `SEED`."""


def _rows(found: Reading) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "time [s]": found.time.round(6),
            "counts": found.counts,
            "voltage [V]": found.voltage.round(6),
            "weight [N]": found.force.round(9),
        }
    )


def simulate(name: str) -> pd.DataFrame:
    """Make the rows of a log; `name` is a key of `RUNS`.

    Raises
    ------
    UnknownNameError
        If there is no such log.
    """
    if name not in RUNS:
        raise UnknownNameError("log of the force layer", name, [*RUNS])
    run = RUNS[name]
    if name == "weights":
        return _rows(put_down(weight_forces(), seed=SEED, run=run))
    if name == "cycles":
        return _rows(load_and_unload(seed=SEED, run=run))
    if name == "objects":
        objects = table_2_2()
        forces = np.repeat([weighed.true for weighed in objects.values()], TIMES)
        found = put_down(forces, seed=SEED, run=run, seating=ForceLayer().object_seating)
        return _rows(found).assign(object=np.repeat([*objects], TIMES))
    runs = [
        _rows(long_run(age, seed=SEED, run=run + k)).assign(**{"start [h]": age})
        for k, age in enumerate(AGES)
    ]
    return pd.concat(runs, ignore_index=True)


def file_of(name: str) -> str:
    """Return the path of a log below ``data/``."""
    return f"simulated/force-{name}.csv"


def read(name: str) -> pd.DataFrame:
    """Read a kept log; `name` is a key of `RUNS`."""
    return pd.read_csv(data_file(file_of(name)).path, comment="#")


def write(folder: Path | None = None) -> Iterator[Path]:
    """Make all logs anew, below ``data/`` or another folder; yields each path when it is done."""
    for name, run in RUNS.items():
        path = (folder or data_folder()) / file_of(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        header = f"# provenance: simulated\n# source: {COMMAND}\n# seed: {SEED} run {run}\n"
        path.write_text(header + simulate(name).to_csv(index=False), encoding="utf-8")
        yield path


if __name__ == "__main__":
    for written in write():
        print(written)
