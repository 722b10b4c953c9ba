"""The driver of a board: ``with Board("/dev/ttyACM0") as rig`` stops the pump on the way out."""

import time
from collections.abc import Callable
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from serial.tools import list_ports

from softgrip.board import protocol
from softgrip.board.calibration import BoardCalibration, nominal
from softgrip.board.errors import (
    BoardError,
    CommandRefusedError,
    ConnectionLostError,
    WrongBoardError,
)
from softgrip.board.info import BoardInfo, Limits, Scale
from softgrip.board.link import Link, SerialLink
from softgrip.board.protocol import Flag, Reason, Values, in_words
from softgrip.board.session import GREET_WITHIN, Session, Telemetry
from softgrip.errors import InvalidInputError
from softgrip.logs.schema import LogHeader
from softgrip.provenance import Provenance
from softgrip.simulator.motor import one_speed
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.sensors import Measurement

PRESSURE, FLEX = protocol.CHANNELS.index("pressure"), protocol.CHANNELS.index("flex_1")
TELEMETRY_WITHIN = 1.0
TRY_EVERY = 0.2
"""s between attempts to open a port that is not there."""
HOME_WITHIN = 60.0
"""s, for the whole stroke at a slow speed."""
STOP_WITHIN = 2.0
HUNG_AFTER = 0.5
"""s after a command's period, from which a turning motor is left to the board's own watchdog."""
HELD_BACK = {in_words(one) for one in (Reason.OVER_PRESSURE, Reason.POSITION_LIMIT)}
"""Reasons that hold a push back and end nothing."""
USUAL = Flag.MOVING | Flag.HOMED | Flag.GREETED | Flag.HOME_SWITCH
"""Flags that are no event."""


class Board:
    """A board as a `Rig`.

    Nothing moves because one connects. The board stops the motor by itself when this program
    hangs, dies, or asks for nothing new within `HUNG_AFTER` while the motor turns.

    Args:
        port: A port or a URL as of `SerialLink`, or a `Link` in virtual time.
        fingers: With a flex sensor, 1 or 2.
        period: Sampling period, s, a whole number of the 25 ms of telemetry.
        calibration: Of this board's sensors; None for the data sheets' lines.
        pump: Its lead and area.
        emulated: Whether the physics behind a port is simulated, which logs must say; behind a
            `Link` it is.

    Attributes:
        session: The conversation; `reconnect` begins another one.
        info, scale: What the board is, and its units.

    Raises:
        PortUnavailableError, NoBoardError, VersionMismatchError, WrongBoardError: If there is no
            such port or another program has it, nothing answers on it, the firmware speaks another
            version, or the calibration is another board's.
    """

    def __init__(
        self,
        port: str | Link,
        *,
        fingers: int = 1,
        period: float = protocol.TELEMETRY_PERIOD,
        calibration: BoardCalibration | None = None,
        pump: PumpParameters | None = None,
        emulated: bool = False,
    ) -> None:
        frames = round(period / protocol.TELEMETRY_PERIOD)
        if frames < 1 or abs(frames * protocol.TELEMETRY_PERIOD - period) > 1e-9:
            raise InvalidInputError("period", expected="a multiple of 25 ms", got=period)
        self.calibration = nominal(2) if calibration is None else calibration
        if not 1 <= fingers <= min(2, len(self.calibration.angles)):
            raise InvalidInputError("fingers", expected="1 or 2, each calibrated", got=fingers)
        self.fingers, self.period = fingers, period
        self.pump = PumpParameters() if pump is None else pump
        self._given = None if isinstance(port, str) else port
        self.port = port if isinstance(port, str) else port.name
        self.real_time = isinstance(port, str) or port.real_time
        self.emulated = emulated or not self.real_time
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
        self.session = Session(SerialLink(self.port) if self._given is None else self._given)
        self._flags, self._lost = Flag(0), 0
        try:
            self._greet(within)
            self.calibration.for_board(self.info.identity, self.port)
            self.session.wait(
                lambda: self.session.telemetry is not None, TELEMETRY_WITHIN, "telemetry"
            )
        except BaseException:
            self._hang_up()
            raise

    def _greet(self, within: float = GREET_WITHIN) -> None:
        told = self.session.greet(within)
        self.scale = Scale(told["steps"], self.pump, self.calibration.pressure)
        self.info = BoardInfo.of(told, usb_serial(self.port), self.scale)

    def _hang_up(self) -> None:
        """End the conversation, and close a line that can be opened again."""
        self.session.end()
        if self._given is None:
            self.session.link.close()

    # What it says.

    @property
    def telemetry(self) -> Telemetry:
        """The last telemetry in the board's own units, with all channels."""
        told = self.session.telemetry
        if told is None:  # `_open` waits for the first
            raise ConnectionLostError(self.port, "no telemetry yet")
        return told

    @property
    def time(self) -> float:
        """The board's time of the last telemetry, s; it goes on over a lost line or a reset."""
        return self.telemetry.time + self._offset

    def measure(self) -> Measurement:
        """Return the last telemetry in SI units."""
        told, lines = self.telemetry, self.calibration
        pressure = np.array([told.channels[PRESSURE]])
        flex = np.array(told.channels[FLEX : FLEX + self.fingers])[:, None]
        angles = [line.value(row) for line, row in zip(lines.angles, flex, strict=False)]
        return Measurement(
            self.time, lines.pressure.value(pressure), np.array(angles), pressure, flex
        )

    def listen(self) -> Telemetry:
        """Wait for the next telemetry frame and return it: all channels, in counts."""
        self._wait_for(lambda _: True, HUNG_AFTER, "telemetry")
        return self.telemetry

    def _wait_for(self, done: Callable[[Flag], bool], seconds: float, what: str) -> None:
        """Listen until the flags of a new telemetry frame are so."""
        before = self.telemetry.number
        self.session.wait(
            lambda: self.telemetry.number != before and done(self.telemetry.flags), seconds, what
        )

    def take_event(self) -> str:
        """Return what happened since the last call: notes, flags that rose, telemetry lost."""
        flags, lost = self.telemetry.flags, self.session.lost
        events = [*self._events, *map(in_words, flags & ~self._flags & ~USUAL)]
        if lost > self._lost:
            events.append(f"telemetry lost: {lost - self._lost}")
        self._events, self._flags, self._lost = [], flags, lost
        return "; ".join(events)

    def counters(self) -> Values:
        """Return the board's counts of good and bad frames."""
        return self.session.ask(protocol.COUNTERS)

    def header(self) -> LogHeader:
        """Return what a log says of this rig."""
        info = self.info
        return LogHeader(
            provenance=Provenance.SIMULATED if self.emulated else Provenance.LOGGED,
            source=f"softgrip.board.driver on {self.port}",
            back_end="emulated board" if self.emulated else "board",
            period=self.period,
            board=info.identity,
            firmware=f"protocol {protocol.PROTOCOL_VERSION} build {info.build}",
            calibration=self.calibration.name,
            notes={"area": f"{self.pump.area!r} m^2", "lead": f"{self.pump.lead!r} m"},
        )

    # What it is told.

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period; see `Rig.advance`.

        Raises:
            ConnectionLostError: If the line broke, or nothing comes over it; `reconnect` finds it
                again.
        """
        limit = self.info.limits.speed
        speed = min(max(one_speed(command), -limit), limit)
        until = self.time + self.period - protocol.TELEMETRY_PERIOD / 2
        self.turn(speed, self.period)
        self.session.wait(lambda: self.time >= until, self.period + HUNG_AFTER, "telemetry")
        return self.measure()

    def turn(self, speed: float, hold: float) -> None:
        """Turn at a speed [rad/s] until told otherwise, or a while after `hold` seconds.

        Raises:
            CommandRefusedError: After an emergency stop, before homing, or with a faulty sensor. A
                push against a limit is held back and noted.
        """
        self.session.alive_for(hold + HUNG_AFTER if speed else float("inf"))
        try:
            self.session.ask(protocol.SETPOINT, speed=self.scale.speed_out(speed))
        except CommandRefusedError as error:
            if error.reason not in HELD_BACK:
                raise
            self._events.append(f"held back: {error.reason}")

    def stop(self) -> None:
        """Bring the motor to rest, and wait until it is."""
        try:
            self.turn(0.0, 0.0)
        except CommandRefusedError as error:
            # A speed that is refused, as after an emergency stop, brings the motor to rest as well;
            # a board that is homing goes on, but rests when it is greeted.
            if error.reason == in_words(Reason.MOVING):
                self._greet()
        self._wait_for(lambda flags: not flags & Flag.MOVING, STOP_WITHIN, "rest")

    def emergency_stop(self) -> None:
        """Stop at once, and refuse to move until `clear`; the board keeps the latch."""
        self.session.ask(protocol.ESTOP)

    def clear(self) -> None:
        """Take an emergency stop and latched faults back, if their cause is gone."""
        self.session.ask(protocol.CLEAR)

    def home(self) -> None:
        """Draw the plunger out to its switch, through an open valve where there is one.

        Raises:
            CommandRefusedError: If the switch is not found.
        """
        self.stop()
        self.vent(open_valve=True)
        self.session.alive_for(HOME_WITHIN)
        try:
            self.session.ask(protocol.HOME)
        except CommandRefusedError as error:
            # Said again, since its answer was lost, it finds itself under way.
            if error.reason != in_words(Reason.MOVING):
                raise
        self._wait_for(lambda flags: not flags & Flag.HOMING, HOME_WITHIN, "end of homing")
        if not self.telemetry.flags & Flag.HOMED:
            raise CommandRefusedError(
                self.port, "homing failed", command="home", state=self.session.state
            )
        self.session.alive_for(float("inf"))
        self.vent(open_valve=False)

    def vent(self, *, open_valve: bool) -> None:
        """Open or shut the valve; nothing happens where there is none."""
        if self.info.valve:
            self.session.ask(protocol.VENT, open=int(open_valve))

    def set_limits(self, limits: Limits) -> Limits:
        """Set the limits, at rest and within the board's bounds; return those now in force."""
        self.session.ask(protocol.SET_LIMITS, **self.scale.limits_out(limits))
        self._greet()
        return self.info.limits

    # A line that was lost, and the way out.

    def reconnect(self, within: float) -> None:
        """Find the same board again; the motor is then at rest.

        Raises:
            ConnectionLostError: If that does not happen within some seconds.
            WrongBoardError: If another board, or other firmware, answers.
        """
        if self.session.telemetry is not None:  # else this is a further attempt
            self._known = self.info, self.time, self.session.heard_at
        (known, told, heard_at), clock = self._known, self.session.link.now
        end = clock() + within
        self._hang_up()
        why: BoardError | None = None
        while True:
            left = end - clock()
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
                if self.real_time:
                    time.sleep(TRY_EVERY)
        if (self.info.identity, self.info.build) != (known.identity, known.build):
            self._hang_up()
            raise WrongBoardError(self.port, f"was {known.identity}, is now {self.info.identity}")
        self._offset = told + (self.session.heard_at - heard_at) - self.telemetry.time
        self.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        """Stop, vent, and give the port up."""
        try:
            self.stop()
            self.vent(open_valve=True)
        except BoardError:
            # The first error is the one to tell; a board that does not hear stops by itself.
            if error[0] is None:
                raise
        finally:
            self.session.end()
            self.session.link.close()


def usb_serial(port: str) -> str:
    """Return the USB serial number of a port, empty if it has none."""
    found = [one.serial_number for one in list_ports.comports() if one.device == port]
    return (found[0] or "") if found else ""
