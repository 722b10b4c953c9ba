"""What a live run follows: a reference that moves, and the controller that follows it."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import Controller
from softgrip.control.pid import PERIOD


@dataclass(frozen=True)
class LiveExperiment:
    """What is run.

    Attributes
    ----------
    name
        For the log's name.
    reference
        rad, shape (N,), a sample each 25 ms.
    controller
        Makes what follows it, from one angle to motor speed.
    shows
        In words, for the log.
    """

    name: str
    reference: Floats
    controller: Callable[[], Controller]
    shows: str

    @property
    def duration(self) -> float:
        """From the first sample to the last, s."""
        return (self.reference.size - 1) * PERIOD

    @property
    def time(self) -> Floats:
        """Of the samples, s, shape (N,)."""
        return np.arange(float(self.reference.size)) * PERIOD

    def log_path(self, folder: Path | str) -> Path:
        """Return a path for a new log, with the name and the time; make its folder.

        To the microsecond, for a run that is stopped and begun again needs less than a second.
        """
        made = Path(folder)
        made.mkdir(parents=True, exist_ok=True)
        return made / f"{self.name}-{datetime.now():%Y-%m-%d-%H%M%S-%f}.csv"
