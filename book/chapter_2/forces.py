"""What the simulated force layer reads: ``python -m book.chapter_2.forces``.

The command keeps the comparison of regressors, ``data/tactile/force_comparison.csv``, in half a
minute.
"""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pandas as pd

from book.chapter_2.force_logs import read
from softgrip.arrays import Floats, read_only
from softgrip.kept import write_data
from softgrip.provenance import data_file, data_folder
from softgrip.tactile.force import Weighing
from softgrip.tactile.force_comparison import cross_validated, regressors, root_mean_square
from softgrip.tactile.nadaraya_watson import NadarayaWatson, best_bandwidth

COMPARISON = "tactile/force_comparison.csv"
SEEDS = 20
"""Random splits that the regressors are compared on."""

RANDOM, WHOLE = "five random folds", "a weight at a time"
WIDE = "Nadaraya-Watson, wide"
"""With the bandwidth by leaving out whole weights; see `weight_bandwidth`."""


@cache
def weight_points() -> tuple[Floats, Floats]:
    """Return voltage (V) and force (N) of the 69 points, shapes (69,)."""
    log = read("weights")
    return read_only(log["voltage [V]"]), read_only(log["weight [N]"])


@cache
def weight_bandwidth(whole: bool = True) -> float:
    """Return the bandwidth, V, with the least error on weights, or else points, left out."""
    voltage, force = weight_points()
    return best_bandwidth(voltage[:, None], force, groups=force if whole else None)


@cache
def force_model(whole: bool = True) -> NadarayaWatson:
    """Return the regressor of Section 2.3 on the 69 points; `whole` as of `weight_bandwidth`."""
    voltage, force = weight_points()
    return NadarayaWatson(weight_bandwidth(whole)).fit(voltage[:, None], force)


def to_force(voltage: Floats, whole: bool = True) -> Floats:
    """Return the force, N, for voltages, V, shape (N,)."""
    return force_model(whole).predict(np.asarray(voltage)[:, None])


def weighed_objects(whole: bool = True) -> Mapping[str, Weighing]:
    """Return Table 2.2 of the simulated layer: each object ten times, N.

    Objects are rigid here. The text says that a soft one passes its weight incompletely; at rest
    what it does not pass must be carried by something beside the layer, which is not simulated.
    """
    log = read("objects")
    forces = log.assign(force=to_force(log["voltage [V]"].to_numpy(), whole))
    return MappingProxyType(
        {
            str(name): Weighing(
                float(rows["force"].mean()),
                float(rows["force"].std()),
                float(rows["weight [N]"].iloc[0]),
                len(rows),
            )
            for name, rows in forces.groupby("object", sort=False)
        }
    )


def compare() -> pd.DataFrame:
    """Return the root mean square error of each regressor, N, by split and seed."""
    voltage, force = weight_points()
    rows = []
    for seed in range(SEEDS):
        for name, model in regressors(seed).items():
            errors = cross_validated(model, voltage, force, seed=seed) - force
            rows.append((name, RANDOM, seed, root_mean_square(errors)))
    wide = {WIDE: NadarayaWatson(weight_bandwidth())}
    for name, model in {**regressors(), **wide}.items():
        errors = cross_validated(model, voltage, force, groups=force) - force
        rows.append((name, WHOLE, 0, root_mean_square(errors)))
    for seed in range(SEEDS):
        errors = cross_validated(wide[WIDE], voltage, force, seed=seed) - force
        rows.append((WIDE, RANDOM, seed, root_mean_square(errors)))
    return pd.DataFrame(rows, columns=["regressor", "left out", "seed", "error [N]"])


def kept_comparison() -> pd.DataFrame:
    """Read the kept comparison: mean error by regressor and what was left out, N."""
    rows = pd.read_csv(data_file(COMPARISON).path, comment="#")
    return rows.pivot_table(
        index="regressor", columns="left out", values="error [N]", aggfunc="mean", sort=False
    )


def write(path: Path | None = None) -> Path:
    """Make the kept comparison anew, below ``data/`` or elsewhere, and return its path."""
    table = compare().to_csv(index=False, float_format="%.6g")
    target = path or data_folder() / COMPARISON
    return write_data(target, table, source="python -m book.chapter_2.forces")


if __name__ == "__main__":
    print(write())
