"""What the simulated force layer reads: ``python -m book.chapter_2.forces``.

The command keeps the comparison of regressors, ``data/tactile/force_comparison.csv``, and the
errors of many simulated hours with and without the correction of Section 2.3 for drift,
``data/tactile/force_drift.csv``, in half a minute.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pandas as pd

from book.chapter_2.force_logs import AGES, LONG_WEIGHTS, long_run, read
from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError
from softgrip.kept import write_data
from softgrip.provenance import data_file, data_folder
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED
from softgrip.tactile.drift import DRIFT_WEIGHTS, DriftBetween, LinearDrift
from softgrip.tactile.force import Weighing
from softgrip.tactile.force_comparison import cross_validated, regressors, root_mean_square
from softgrip.tactile.nadaraya_watson import NadarayaWatson, best_bandwidth
from softgrip.units import GRAM_FORCE

COMPARISON = "tactile/force_comparison.csv"
SEEDS = 20
"""Random splits that the regressors are compared on."""

RANDOM, WHOLE = "five random folds", "a weight at a time"
WIDE = "Nadaraya-Watson, wide"
"""With the bandwidth by leaving out whole weights; see `weight_bandwidth`."""


@remembered
def weight_points() -> tuple[Floats, Floats]:
    """Return voltage (V) and force (N) of the 69 points, shapes (69,)."""
    log = read("weights")
    return read_only(log["voltage [V]"]), read_only(log["weight [N]"])


@remembered
def weight_bandwidth(whole: bool = True) -> float:
    """Return the bandwidth, V, with the least error on weights, or else points, left out."""
    voltage, force = weight_points()
    return best_bandwidth(voltage[:, None], force, groups=force if whole else None)


@remembered
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


def write_comparison(path: Path | None = None) -> Path:
    """Make the kept comparison anew, below ``data/`` or elsewhere, and return its path."""
    table = compare().to_csv(index=False, float_format="%.6g")
    target = path or data_folder() / COMPARISON
    return write_data(target, table, source="python -m book.chapter_2.forces")


DRIFT = "tactile/force_drift.csv"
HOURS = 40
"""Simulated hours by time of start, each with its own noise and seating."""

FIRST = 100
"""Number of the first of their runs: beyond those of the logs."""


@remembered
def calibrated() -> Floats:
    """Return the mean voltage of each weight for the drift among the 69 points, V, shape (4,)."""
    voltage, force = weight_points()
    same = (np.isclose(force, w * GRAM_FORCE, rtol=1e-6) for w in DRIFT_WEIGHTS)
    return np.array([voltage[rows].mean() for rows in same])


def hour_errors(time: Floats, voltage: Floats, force: Floats) -> pd.DataFrame:
    """Return the errors of the readings between the weights for the drift.

    Args:
        time, voltage, force: s, V and N (true), shape (readings,), of an hour that begins and ends
            with `DRIFT_WEIGHTS`.

    Returns:
        DataFrame: One row a reading: "time", h from the first reading; and the error, N, "without"
            any correction, "repaired" by the line of Section 2.3, and with lines at both ends
            ("between"), which is ours.

    Raises:
        InvalidInputError: If the hour does not begin and end so: a row is missing there.
    """
    count, reference = len(DRIFT_WEIGHTS), calibrated()
    for ends in (force[:count], force[-count:]):
        if ends.size < count or not np.allclose(ends, np.array(DRIFT_WEIGHTS) * GRAM_FORCE):
            raise InvalidInputError(
                "force", expected=f"{DRIFT_WEIGHTS} gf at both ends", got=ends / GRAM_FORCE
            )
    first = LinearDrift.from_weights(reference, voltage[:count])
    last = LinearDrift.from_weights(reference, voltage[-count:])
    begin, end = time[:count].mean(), time[-count:].mean()
    t, v, f = (values[count:-count] for values in (time, voltage, force))
    both = DriftBetween(first, last).corrected(v, (t - begin) / (end - begin))
    return pd.DataFrame(
        {
            "time": (t - time[0]) / 3600,
            "without": to_force(v) - f,
            "repaired": to_force(first.corrected(v)) - f,
            "between": to_force(both) - f,
        }
    )


def drift_errors() -> pd.DataFrame:
    """Return root mean square errors, N, by start (h) and round of the four weights (1 to 5)."""
    found = []
    for start in AGES:
        for hour in range(HOURS):
            run = long_run(start, seed=SEED, run=FIRST + hour)
            errors = hour_errors(run.time, run.voltage, run.force)
            # Rounds, so that all parts of the hour have the same weights.
            number = np.arange(len(errors)) // len(LONG_WEIGHTS) + 1
            found.append(errors.drop(columns="time").assign(start=start, round=number))
    squares = pd.concat(found).set_index(["start", "round"]) ** 2
    return squares.groupby(level=[0, 1]).mean() ** 0.5


def kept_drift() -> pd.DataFrame:
    """Read the kept errors, N, indexed by start (h) and round."""
    rows = pd.read_csv(data_file(DRIFT).path, comment="#", index_col=[0, 1])
    return rows.rename(columns=lambda name: name.removesuffix(" [N]"))


def write_drift(path: Path | None = None) -> Path:
    """Make the kept errors anew, below ``data/`` or elsewhere, and return their path."""
    return write_data(
        path or data_folder() / DRIFT,
        drift_errors().add_suffix(" [N]").to_csv(float_format="%.6g"),
        source="python -m book.chapter_2.forces",
        notes=f"seed: {SEED} runs {FIRST} to {FIRST + HOURS - 1}",
    )


if __name__ == "__main__":
    print(write_comparison(), write_drift(), sep="\n")
