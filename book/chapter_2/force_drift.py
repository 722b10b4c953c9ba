"""What the correction of Section 2.3 makes of drift: ``python -m book.chapter_2.force_drift``.

The command keeps the errors of many simulated hours, ``data/tactile/force_drift.csv``.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd

from book.chapter_2.force_logs import AGES, read
from book.chapter_2.force_protocols import LONG_WEIGHTS, long_run
from book.chapter_2.forces import to_force, weight_points
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.kept import write_data
from softgrip.provenance import data_file, data_folder
from softgrip.simulator.chance import SEED
from softgrip.tactile.drift import DRIFT_WEIGHTS, DriftBetween, LinearDrift
from softgrip.units import GRAM_FORCE

DRIFT = "tactile/force_drift.csv"
HOURS = 40
"""Simulated hours by time of start, each with its own noise and seating."""

FIRST = 100
"""Number of the first of their runs: beyond those of the logs."""

ToForce = Callable[[Floats], Floats]


def calibrated() -> Floats:
    """Return the mean voltage of each weight for the drift among the 69 points, V, shape (4,)."""
    voltage, force = weight_points()
    same = (np.isclose(force, w * GRAM_FORCE, rtol=1e-6) for w in DRIFT_WEIGHTS)
    return np.array([voltage[rows].mean() for rows in same])


def hour_errors(
    time: Floats, voltage: Floats, force: Floats, reference: Floats, to_force: ToForce
) -> pd.DataFrame:
    """Return the errors of the readings between the weights for the drift.

    Parameters
    ----------
    time, voltage, force
        s, V and N (true), shape (readings,), of an hour that begins and ends with
        `DRIFT_WEIGHTS`.
    reference
        Voltages of these weights at the calibration, V.
    to_force
        From voltages to N.

    Returns
    -------
    DataFrame
        One row a reading: "time", h from the first reading; and the error, N, "without" any
        correction, "repaired" by the line of Section 2.3, and with lines at both ends ("between"),
        which is ours.

    Raises
    ------
    InvalidInputError
        If the hour does not begin and end so: a row is missing there.
    """
    count = len(DRIFT_WEIGHTS)
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


def logged_errors(start: float) -> pd.DataFrame:
    """Return `hour_errors` of the kept log that starts at a time after the calibration, h."""
    rows = read("long")
    rows = rows[rows["start [h]"] == start]
    time, voltage, force = (rows[n].to_numpy() for n in ("time [s]", "voltage [V]", "weight [N]"))
    return hour_errors(time, voltage, force, calibrated(), to_force)


def simulate() -> pd.DataFrame:
    """Return root mean square errors, N, by start (h) and round of the four weights (1 to 5)."""
    found, reference = [], calibrated()
    for start in AGES:
        for hour in range(HOURS):
            run = long_run(start, seed=SEED, run=FIRST + hour)
            errors = hour_errors(run.time, run.voltage, run.force, reference, to_force)
            # Rounds, so that all parts of the hour have the same weights.
            number = np.arange(len(errors)) // len(LONG_WEIGHTS) + 1
            found.append(errors.drop(columns="time").assign(start=start, round=number))
    squares = pd.concat(found).set_index(["start", "round"]) ** 2
    return squares.groupby(level=[0, 1]).mean() ** 0.5


def kept() -> pd.DataFrame:
    """Read the kept errors, N, indexed by start (h) and round."""
    rows = pd.read_csv(data_file(DRIFT).path, comment="#", index_col=[0, 1])
    return rows.rename(columns=lambda name: name.removesuffix(" [N]"))


def write(path: Path | None = None) -> Path:
    """Make the kept errors anew, below ``data/`` or elsewhere, and return their path."""
    rows = simulate().add_suffix(" [N]").to_csv(float_format="%.6g")
    return write_data(
        path or data_folder() / DRIFT,
        rows,
        source="python -m book.chapter_2.force_drift",
        notes=f"seed: {SEED} runs {FIRST} to {FIRST + HOURS - 1}",
    )


if __name__ == "__main__":
    print(write())
