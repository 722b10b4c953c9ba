"""Logs of several runs of one experiment, sample by sample alike."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from softgrip.errors import DataFileError
from softgrip.rig.log_gaps import refuse_gaps
from softgrip.rig.log_reader import read_log
from softgrip.rig.log_schema import Log


def read_alike(paths: Sequence[Path | str]) -> list[Log]:
    """Read logs that have the same times.

    None may have a gap: what is made of runs is their mean at each time, their spectra, and models
    that take input and output between two samples as known.

    Raises
    ------
    DataFileError
        If a log cannot be read, has a gap, or other times than the first.
    """
    logs = [read_log(path) for path in paths]
    time = logs[0]["time"]
    for path, log in zip(paths, logs, strict=True):
        refuse_gaps(path, log, "a mean of runs")
        if log["time"].shape != time.shape or not np.allclose(log["time"], time):
            raise DataFileError(path, expected=f"the times of {paths[0]}", got="other times")
    return logs
