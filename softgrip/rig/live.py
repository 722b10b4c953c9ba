"""A run in a thread of its own: watched while it goes on, and stopped by a call from outside."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import NamedTuple
from weakref import WeakSet

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import Controller
from softgrip.control.pid import PERIOD
from softgrip.control.rig_controller import Tracking
from softgrip.errors import InvalidInputError
from softgrip.files import path_of
from softgrip.logs.fingers import column
from softgrip.rig.interface import Rig
from softgrip.rig.record import Recording, Row, record


@dataclass(frozen=True)
class LiveExperiment:
    """What is run.

    Attributes:
        name: For the log's name.
        reference: rad, shape (N,), a sample each 25 ms.
        controller: Makes what follows it, from one angle to motor speed.
        shows: In words, for the log.
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


def check_period(rig: Rig) -> None:
    """Raise `InvalidInputError` unless a rig is sampled as the controller is, each 25 ms."""
    if abs(rig.period - PERIOD) > 1e-9:
        raise InvalidInputError("rig", expected=f"a period of {PERIOD} s", got=rig.period)


_STARTED: "WeakSet[LiveRun]" = WeakSet()


class Sample(NamedTuple):
    """What is drawn of one period: s, rad/s, Pa, and rad of each finger."""

    time: float
    command: float
    pressure: float
    angles: tuple[float, ...]


class LiveRun(threading.Thread):
    """An experiment on a rig: home, rest, run. Nothing moves before `start`.

    A daemon: when the program ends, nobody speaks to the board any more, and it stops.

    Args:
        rig: Sampled each 25 ms. Nothing else may use it until the run is over.
        experiment: What is run.
        path: Of the log, which must not exist.
        rest: How long to wait after homing, s, for a finger that was bent before.
        real_time: Whether a rig in virtual time is held back to the pace of a clock.

    Attributes:
        samples: So far; the thread appends to it.
        state: In one word.
        recording: None before the end, or if there was an error.
        error: What ended the run early; None if nothing did.

    >>> import tempfile
    >>> import numpy as np
    >>> from softgrip.rig.connect import connect
    >>> from softgrip.control.pid import PID, Gains
    >>> step = LiveExperiment("step", np.full(41, 0.5), lambda: PID(Gains(kp=5.0)), "half a radian")
    >>> with connect("simulated") as rig:
    ...     path = Path(tempfile.mkdtemp()) / "log.csv"
    ...     run = LiveRun(rig, step, path, real_time=False)
    ...     run.start()
    ...     run.wait().samples
    41
    """

    def __init__(
        self,
        rig: Rig,
        experiment: LiveExperiment,
        path: Path | str,
        *,
        rest: float = 0.0,
        real_time: bool = True,
    ) -> None:
        check_period(rig)
        super().__init__(name="softgrip run", daemon=True)
        self.rig, self.experiment, self.path = rig, experiment, path_of(path)
        self.samples: list[Sample] = []
        self.state = "ready"
        self.recording: Recording | None = None
        self.error: Exception | None = None
        self._rest, self._paced = rest, real_time and not rig.real_time
        self._begun = 0.0
        self._halt = threading.Event()

    def start(self) -> None:
        """Begin; a run can be started once.

        Raises:
            InvalidInputError: If another run of this rig is on.
        """
        if any(run.is_alive() and run.rig is self.rig for run in _STARTED):
            raise InvalidInputError("rig", expected="a rig with no other run on", got=self.rig)
        _STARTED.add(self)
        super().start()

    def wait(self, within: float | None = None) -> Recording:
        """Wait for the end and return how the run went.

        Args:
            within: s; None for as long as it takes.

        Raises:
            TimeoutError: If it is not over by then; it goes on.
            BoardError: Or whatever else ended the run early.
        """
        self.join(within)
        if self.error is not None:
            raise self.error
        if self.recording is None:
            raise TimeoutError(f"{self.experiment.name} is not over in {within} s")
        return self.recording

    def emergency_stop(self) -> None:
        """Stop the motor at once and end the run; the rig refuses to move until it is cleared.

        A rig in real time is told at once, another one before its next period. If the line is
        lost, this raises `ConnectionLostError`, the board stops by itself, and it is told again
        when the line is back.
        """
        self._halt.set()
        if self.rig.real_time:
            self.rig.emergency_stop()

    def run(self) -> None:
        """Drive the rig: what the thread does."""
        try:
            self._drive()
            self.state = "done"
        except Exception as error:  # nobody would see it: it is the thread's
            self.error = error
            self.state = "stopped" if self._halt.is_set() else "failed"

    def _drive(self) -> None:
        self.state = "homing"
        self.rig.home()
        self.state = "resting"
        for _ in range(round(self._rest / self.rig.period)):
            self._obey()
            self.rig.advance(0.0)
        self._obey()
        self.state = "running"
        self._begun = time.monotonic()
        self.recording = record(
            self.rig,
            Tracking(self.experiment.controller(), self.experiment.reference),
            self.experiment.duration,
            self.path,
            reference=self.experiment.reference[:, None],
            shows=self.experiment.shows,
            progress=self._sampled,
        )

    def _obey(self) -> None:
        if self._halt.is_set():
            self.rig.emergency_stop()  # what is commanded next is refused, and ends the run

    def _sampled(self, row: Row, _: float) -> None:
        angles = tuple(row[column("angle", finger)] for finger in range(self.rig.fingers))
        self.samples.append(Sample(row["time"], row["command"], row["pressure"], angles))
        if self._paced and (early := self._begun + row["time"] - time.monotonic()) > 0:
            self._halt.wait(early)
        self._obey()
