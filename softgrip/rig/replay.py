"""A log as a rig: it says again what was recorded, whatever it is told."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from softgrip.board.errors import EndOfReplayError
from softgrip.errors import DataFileError
from softgrip.logs.fingers import fingers_of
from softgrip.logs.gaps import gaps_of, period_of
from softgrip.logs.reader import read_log
from softgrip.logs.schema import LogHeader
from softgrip.rig.interface import StandIn
from softgrip.simulator.sensors import Measurement


class Replay(StandIn):
    """A log of the gripper as a `Rig`, one row a call of `advance`.

    A log with a gap is given as it came: the row after it is the next one, with its own time, and
    an event that names the gap. A board's driver does the same when telemetry is lost, so that a
    controller is asked as often as it was in the run.

    Args:
        path: Of the log.

    Attributes:
        difference: Largest difference so far between a command given and the one recorded, rad/s: a
            replay cannot answer to another command, so that above zero it says nothing of the
            controller.

    Raises:
        DataFileError: If it cannot be read, holds no row, or is a log of the pad.
    """

    def __init__(self, path: Path | str) -> None:
        self.log = read_log(path)
        if self.log.header.set_up != "gripper" or self.log["time"].size == 0:
            raise DataFileError(path, expected="rows of a gripper", got=self.log.header.set_up)
        # What was recorded was permitted then: only the latch and the homing are kept here.
        super().__init__(f"replay of {path}", np.inf)
        self.period, self.difference = period_of(self.log), 0.0
        self._angles = fingers_of(self.log)
        self._counts = fingers_of(self.log, "angle_counts").astype(np.int64)
        self.fingers, self._row, self._events = len(self._angles), 0, dict(self.log.events)
        for gap in gaps_of(self.log):
            told = self._events.get(gap.end, "")
            self._events[gap.end] = "; ".join(filter(None, (told, f"log: {gap}")))

    def measure(self) -> Measurement:
        """Return the present row."""
        row = self._row
        return Measurement(
            float(self.log["time"][row]),
            self.log["pressure"][[row]],
            self._angles[:, [row]],
            self.log["pressure_counts"][[row]].astype(np.int64),
            self._counts[:, [row]],
        )

    def advance(self, command: ArrayLike) -> Measurement:
        """Return the next row; see `Rig.advance`.

        Raises:
            EndOfReplayError: After the last row.
        """
        speed = self.permitted(command, 0.0)
        if self._row + 1 == self.log["time"].size:
            raise EndOfReplayError(self.name, f"the log ends after row {self._row + 1}")
        self._row += 1
        self.difference = max(self.difference, abs(speed - float(self.log["command"][self._row])))
        return self.measure()

    def take_event(self) -> str:
        """Return the words of the present row, once."""
        return self._events.pop(float(self.log["time"][self._row]), "")

    def header(self) -> LogHeader:
        """Return the header of the log, which stays what it was: simulated or logged."""
        return replace(self.log.header, back_end="replay", source=self.name)
