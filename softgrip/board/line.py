"""A greeted board at the end of a line that can be lost and found again."""

import time
from collections.abc import Callable

from serial.tools import list_ports

from softgrip.board.calibration import BoardCalibration
from softgrip.board.errors import BoardError, ConnectionLostError, WrongBoardError
from softgrip.board.handshake import GREET_WITHIN, greet
from softgrip.board.info import BoardInfo, Scale, integer
from softgrip.board.link import Link, SerialLink
from softgrip.board.protocol import Flag
from softgrip.board.session import Session
from softgrip.board.telemetry import Telemetry, in_words
from softgrip.simulator.parameters import PumpParameters

TELEMETRY_WITHIN = 1.0
TRY_EVERY = 0.2
"""s between attempts to open a port that is not there."""


class BoardLine:
    """A line, the conversation over it, and what the board said of itself.

    Parameters
    ----------
    port
        A port or a URL, which is opened and listened to in the background; or a `Link`.
    calibration, pump
        For units; the calibration must be this board's.

    Attributes
    ----------
    session
        The conversation.
    info, scale
        What the board is, and its units.
    """

    def __init__(
        self, port: str | Link, calibration: BoardCalibration, pump: PumpParameters
    ) -> None:
        self.port = port if isinstance(port, str) else "link"
        self._given = None if isinstance(port, str) else port
        self._calibration, self._pump = calibration, pump
        self._offset = 0.0
        self._events: list[str] = []
        try:
            self._open(GREET_WITHIN)
        except BaseException:
            if self._given is not None:
                self._given.close()
            raise
        self._known = self.info, self.time, self.session.heard_at

    def _open(self, within: float) -> None:
        self._link = SerialLink(self.port) if self._given is None else self._given
        self.session = Session(self._link, self.port, background=self._given is None)
        self._flags, self._lost = Flag(0), 0
        try:
            self.greet(within)
            self._calibration.for_board(self.info.identity, self.port)
            self.session.wait(
                lambda: self.session.telemetry is not None, TELEMETRY_WITHIN, "telemetry"
            )
        except BaseException:
            self._hang_up()
            raise

    def greet(self, within: float = GREET_WITHIN) -> None:
        """Say HELLO, and keep what the board answers."""
        told = greet(self.session, within=within)
        self.scale = Scale(integer(told, "steps"), self._pump, self._calibration.pressure)
        self.info = BoardInfo.of(told, usb_serial(self.port), self.scale)

    @property
    def latest(self) -> Telemetry:
        """The last telemetry."""
        told = self.session.telemetry
        if told is None:  # `_open` waits for the first
            raise ConnectionLostError(self.port, "no telemetry yet")
        return told

    @property
    def time(self) -> float:
        """The board's time of the last telemetry, s; it goes on over a lost line or a reset."""
        return self.latest.time + self._offset

    def wait_for(self, done: Callable[[Flag], bool], seconds: float, what: str) -> None:
        """Listen until the flags of a new telemetry frame are so."""
        before = self.latest.number
        self.session.wait(
            lambda: self.latest.number != before and done(self.latest.flags), seconds, what
        )

    def note(self, words: str) -> None:
        """Keep words for `take_event`."""
        self._events.append(words)

    def take_event(self) -> str:
        """Return what happened since the last call: notes, flags that rose, telemetry lost."""
        usual = Flag.MOVING | Flag.HOMED | Flag.GREETED | Flag.HOME_SWITCH
        risen = self.latest.flags & ~self._flags & ~usual
        events = [*self._events, *in_words(risen)]
        if self.session.lost > self._lost:
            events.append(f"telemetry lost: {self.session.lost - self._lost}")
        self._events, self._flags, self._lost = [], self.latest.flags, self.session.lost
        return "; ".join(events)

    def reopen(self, within: float) -> None:
        """Find the same board again.

        Raises
        ------
        ConnectionLostError
            If that does not happen within some seconds.
        WrongBoardError
            If another board, or other firmware, answers.
        """
        if self.session.telemetry is not None:  # else this is a further attempt
            self._known = self.info, self.time, self.session.heard_at
        (known, told, heard_at), end = self._known, self._link.now() + within
        self._hang_up()
        why: BoardError | None = None
        while True:
            left = end - self._link.now()
            if left <= 0:
                raise ConnectionLostError(
                    self.port, f"not found again in {within:g} s; at last: {why}"
                ) from why
            try:
                self._open(left)
                break
            except WrongBoardError:
                raise
            except BoardError as error:
                why = error
                if self._given is None:
                    time.sleep(TRY_EVERY)
        if (self.info.identity, self.info.build) != (known.identity, known.build):
            self._hang_up()
            raise WrongBoardError(self.port, f"was {known.identity}, is now {self.info.identity}")
        self._offset = told + (self.session.heard_at - heard_at) - self.latest.time

    def _hang_up(self) -> None:
        """End the conversation, and close a line that can be opened again."""
        self.session.end()
        if self._given is None:
            self._link.close()

    def close(self) -> None:
        """End the conversation and give the port up."""
        self.session.end()
        self._link.close()


def usb_serial(port: str) -> str:
    """Return the USB serial number of a port, empty if it has none."""
    found = [one.serial_number for one in list_ports.comports() if one.device == port]
    return (found[0] or "") if found else ""
