"""A run in a thread of its own: watched while it goes on, and stopped by a call from outside."""

import threading
import time
from pathlib import Path
from typing import NamedTuple
from weakref import WeakSet

from numpy.typing import ArrayLike

from softgrip.board.driver import Board
from softgrip.control.rig_controller import Tracking
from softgrip.errors import InvalidInputError
from softgrip.rig.interface import Connection
from softgrip.rig.live_experiment import LiveExperiment
from softgrip.rig.live_rig import check_period, listens
from softgrip.rig.record import Recording, record
from softgrip.simulator.motor import one_speed

_STARTED: "WeakSet[LiveRun]" = WeakSet()


class Sample(NamedTuple):
    """What is drawn of one period: s, rad/s, Pa, and rad of each finger."""

    time: float
    command: float
    pressure: float
    angles: tuple[float, ...]


class LiveRun:
    """An experiment on a rig: home, rest, run. Nothing moves before `start`.

    Parameters
    ----------
    connection
        Sampled each 25 ms. Nothing else may use it until the run is over.
    experiment
        What is run.
    path
        Of the log, which must not exist.
    rest
        How long to wait after homing, s, for a finger that was bent before.
    real_time
        Whether a rig that is no board is held back to the pace of a clock.

    Attributes
    ----------
    samples
        So far; the thread appends to it.
    state
        In one word.
    recording
        None before the end, or if there was an error.
    error
        What ended the run early; None if nothing did.

    Examples
    --------
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
        connection: Connection,
        experiment: LiveExperiment,
        path: Path | str,
        *,
        rest: float = 0.0,
        real_time: bool = True,
    ) -> None:
        check_period(connection)
        self.connection, self.experiment, self.path = connection, experiment, Path(path)
        self.samples: list[Sample] = []
        self.state = "ready"
        self.recording: Recording | None = None
        self.error: Exception | None = None
        self._rest, self._paced = rest, real_time and not isinstance(connection, Board)
        self._control = Tracking(experiment.controller(), experiment.reference)
        self._command, self._begun = 0.0, 0.0
        self._halt = threading.Event()
        # A daemon: when the program ends, nobody speaks to the board any more, and it stops.
        self._thread = threading.Thread(target=self._run, name="softgrip run", daemon=True)

    @property
    def back_end(self) -> str:
        """What is driven, in words."""
        return self.connection.header().back_end

    @property
    def running(self) -> bool:
        """Whether the thread is at work."""
        return self._thread.is_alive()

    def start(self) -> None:
        """Begin; a run can be started once.

        Raises
        ------
        InvalidInputError
            If another run of this rig is on.
        """
        if any(run.running and run.connection is self.connection for run in _STARTED):
            raise InvalidInputError(
                "connection", expected="a rig with no other run on", got=self.connection
            )
        _STARTED.add(self)
        self._thread.start()

    def wait(self, within: float | None = None) -> Recording:
        """Wait for the end and return how the run went.

        Parameters
        ----------
        within
            s; None for as long as it takes.

        Raises
        ------
        TimeoutError
            If it is not over by then; it goes on.
        BoardError
            Or whatever else ended the run early.
        """
        self.join(within)
        if self.error is not None:
            raise self.error
        if self.recording is None:
            raise TimeoutError(f"{self.experiment.name} is not over in {within} s")
        return self.recording

    def join(self, within: float | None = None) -> None:
        """Wait for the end, whatever it is, for at most some seconds."""
        self._thread.join(within)

    def emergency_stop(self) -> None:
        """Stop the motor at once and end the run; the rig refuses to move until it is cleared.

        A board is told at once, a rig that is no board before its next period. If the line is
        lost, this raises `ConnectionLostError`, the board stops by itself, and it is told again
        when the line is back.
        """
        self._halt.set()
        if listens(self.connection):
            self.connection.emergency_stop()

    def _run(self) -> None:
        try:
            self._drive()
            self.state = "done"
        except Exception as error:  # nobody would see it: it is the thread's
            self.error = error
            self.state = "stopped" if self._halt.is_set() else "failed"

    def _drive(self) -> None:
        self.state = "homing"
        self.connection.home()
        self.state = "resting"
        for _ in range(round(self._rest / self.connection.period)):
            self._obey()
            self.connection.advance(0.0)
        self.state = "running"
        self._begun = time.monotonic()
        self.recording = record(
            self.connection,
            self,
            self.experiment.duration,
            self.path,
            reference=self.experiment.reference[:, None],
            shows=self.experiment.shows,
            progress=self._sampled,
        )

    def _obey(self) -> None:
        if self._halt.is_set():
            self.connection.emergency_stop()  # what is commanded next is refused, and ends the run

    def update(self, measured: ArrayLike) -> float:
        """Return the next command, rad/s: `record` asks, in the thread."""
        self._obey()
        self._command = one_speed(self._control.update(measured))
        return self._command

    def _sampled(self, done: float, duration: float) -> None:  # noqa: ARG002
        seen = self.connection.measure()
        angles = tuple(float(angle) for angle in seen.angle[:, 0])
        self.samples.append(Sample(done, self._command, float(seen.pressure[0]), angles))
        if self._paced and (early := self._begun + done - time.monotonic()) > 0:
            self._halt.wait(early)
