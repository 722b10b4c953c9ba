"""Several logs of one step, Section 5.4: read together, and their mean."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.gaps import evened, refuse_gaps, refuse_late_start
from softgrip.logs.reader import read_log
from softgrip.logs.schema import Log


def read_alike(paths: Sequence[Path | str] | Path | str) -> list[Log]:
    """Read logs that have the same times; those between even ones on straight lines.

    None may have a gap or lack its start: what is made of runs is their mean at each time, their
    spectra, and models of a rest before the first sample that take input and output between two as
    known.

    Raises:
        DataFileError: If a log cannot be read, has a gap or a single row, lacks its start, or has
            other times than the first.
    """
    if isinstance(paths, str | Path):
        paths = [paths]
    if not paths:
        raise InvalidInputError("paths", expected="one log or more", got="none")
    logs = [read_log(path) for path in paths]
    time = logs[0]["time"]
    for path, log in zip(paths, logs, strict=True):
        refuse_late_start(path, log, "a mean of runs")
        refuse_gaps(path, log, "a mean of runs")
        if log["time"].size < 2:
            raise DataFileError(path, expected="two rows or more", got=f"{log['time'].size}")
        if log["time"].shape != time.shape or not np.allclose(log["time"], time):
            raise DataFileError(path, expected=f"the times of {paths[0]}", got="other times")
    return [evened(log) for log in logs]


@dataclass(frozen=True)
class StepTest:
    """Several runs of one step and their mean, SI.

    Attributes:
        time: s, shape (N,).
        pressures, angles: Gauge pressure, Pa, and angle, rad, of each run, shape (runs, N).
    """

    time: Floats
    pressures: Floats
    angles: Floats

    @property
    def pressure(self) -> Floats:
        """Mean over the runs, Pa, shape (N,)."""
        return np.asarray(self.pressures.mean(axis=0))

    @property
    def angle(self) -> Floats:
        """Mean over the runs, rad, shape (N,)."""
        return np.asarray(self.angles.mean(axis=0))


def read_step_test(paths: Sequence[Path | str]) -> StepTest:
    """Read the runs of one step from their logs.

    Args:
        paths: Logs that start at rest and at atmospheric pressure, with the same times; at least
            one.

    Raises:
        DataFileError: As of `read_alike`.
    """
    logs = read_alike(paths)
    return StepTest(
        logs[0]["time"], *(np.stack([log[name] for log in logs]) for name in ("pressure", "angle"))
    )
