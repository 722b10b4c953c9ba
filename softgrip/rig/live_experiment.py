"""What a live run follows: a reference that moves, and the controller that follows it."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

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


class MovingReference:
    """A controller of the mean of the fingers' angles, with a reference that moves.

    Parameters
    ----------
    controller
        Of one angle.
    samples
        rad, shape (N,), one a period; after them the last is held.
    fingers
        How many follow it.

    Attributes
    ----------
    now
        rad, shape (fingers,): the reference at the end of the period that was last commanded. It
        is one array, changed in place: `experiment.record` takes references once, and so logs
        those that move too.

    Examples
    --------
    >>> from softgrip.control.pid import PID, Gains
    >>> moving = MovingReference(PID(Gains(kp=2.0)), [0.0, 0.5], fingers=1)
    >>> moving.update([[0.0]]).tolist(), moving.now.tolist(), moving.update([[0.0]]).tolist()
    ([0.0], [0.5], [1.0])
    """

    def __init__(self, controller: Controller, samples: ArrayLike, fingers: int) -> None:
        self.controller = controller
        self._samples = np.asarray(samples, dtype=np.float64)
        self._sample = 0
        self.now = np.full(fingers, self._samples[0])

    def _at(self, sample: int) -> float:
        return float(self._samples[min(sample, self._samples.size - 1)])

    def update(self, measured: ArrayLike) -> Floats:
        """Return the command, rad/s, shape (runs,); angles in rad, shape (fingers, runs)."""
        mean = np.asarray(measured, dtype=np.float64).mean(axis=0)
        reference = np.full(mean.shape, self._at(self._sample))
        command = np.asarray(self.controller.update(reference, mean))
        self._sample += 1
        self.now[:] = self._at(self._sample)
        return command
