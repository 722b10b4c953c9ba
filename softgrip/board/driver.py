"""The driver of a board: ``with Rig("/dev/ttyACM0") as rig`` stops the pump on the way out."""

from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from softgrip.board.calibration import BoardCalibration, nominal
from softgrip.board.commands import HUNG_AFTER, BoardCommands
from softgrip.board.errors import BoardError
from softgrip.board.line import BoardLine
from softgrip.board.link import Link
from softgrip.board.protocol import CHANNELS, PROTOCOL_VERSION, TELEMETRY_PERIOD
from softgrip.board.telemetry import Telemetry
from softgrip.errors import InvalidInputError
from softgrip.logs.schema import LogHeader
from softgrip.provenance import Provenance
from softgrip.simulator.motor import one_speed
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.sensors import Measurement

PRESSURE, FLEX = CHANNELS.index("pressure"), CHANNELS.index("flex_1")


class Rig(BoardCommands):
    """A board as a `Connection`.

    Nothing moves because one connects. The board stops the motor by itself when this program
    hangs, dies, or asks for nothing new within `HUNG_AFTER` while the motor turns.

    Parameters
    ----------
    port
        A port or a URL as of `SerialLink`, or a `Link`.
    fingers
        With a flex sensor, 1 or 2.
    period
        Sampling period, s, a whole number of the 25 ms of telemetry.
    calibration
        Of this board's sensors; None for the data sheets' lines.
    pump
        Its lead and area.
    emulated
        Whether the physics behind the line is simulated, which logs must say; None: if `port` is
        a `Link`.

    Raises
    ------
    PortUnavailableError, NoBoardError, VersionMismatchError, WrongBoardError
        If there is no such port or another program has it, nothing answers on it, the firmware
        speaks another version, or the calibration is another board's.
    """

    def __init__(
        self,
        port: str | Link,
        *,
        fingers: int = 1,
        period: float = TELEMETRY_PERIOD,
        calibration: BoardCalibration | None = None,
        pump: PumpParameters | None = None,
        emulated: bool | None = None,
    ) -> None:
        frames = round(period / TELEMETRY_PERIOD)
        if frames < 1 or abs(frames * TELEMETRY_PERIOD - period) > 1e-9:
            raise InvalidInputError("period", expected="a multiple of 25 ms", got=period)
        self.calibration = nominal(2) if calibration is None else calibration
        if not 1 <= fingers <= min(2, len(self.calibration.angles)):
            raise InvalidInputError("fingers", expected="1 or 2, each calibrated", got=fingers)
        self.fingers, self.period = fingers, period
        self.pump = PumpParameters() if pump is None else pump
        self.emulated = not isinstance(port, str) if emulated is None else emulated
        super().__init__(BoardLine(port, self.calibration, self.pump))

    def measure(self) -> Measurement:
        """Return the last telemetry in SI units."""
        told, lines = self.telemetry, self.calibration
        pressure = np.array([told.channels[PRESSURE]])
        flex = np.array(told.channels[FLEX : FLEX + self.fingers])[:, None]
        angles = [line.value(row) for line, row in zip(lines.angles, flex, strict=False)]
        return Measurement(
            self.line.time, lines.pressure.value(pressure), np.array(angles), pressure, flex
        )

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period; see `Connection.advance`.

        Raises
        ------
        ConnectionLostError
            If the line broke, or nothing comes over it; `reconnect` finds it again.
        """
        limit = self.info.limits.speed
        speed = min(max(one_speed(command), -limit), limit)
        until = self.line.time + self.period - TELEMETRY_PERIOD / 2
        self.turn(speed, self.period)
        self.line.session.wait(
            lambda: self.line.time >= until, self.period + HUNG_AFTER, "telemetry"
        )
        return self.measure()

    def listen(self) -> Telemetry:
        """Wait for the next telemetry frame and return it: all channels, in counts."""
        self.line.wait_for(lambda _: True, HUNG_AFTER, "telemetry")
        return self.telemetry

    def take_event(self) -> str:
        """Return words on what happened since the last call, lost telemetry included."""
        return self.line.take_event()

    def reconnect(self, within: float) -> None:
        """Find a line that was lost again; the motor is then at rest.

        Raises
        ------
        ConnectionLostError
            If that does not happen within some seconds.
        WrongBoardError
            If another board answers.
        """
        self.line.reopen(within)
        self.stop()

    def header(self) -> LogHeader:
        """Return what a log says of this rig."""
        info = self.info
        return LogHeader(
            provenance=Provenance.SIMULATED if self.emulated else Provenance.LOGGED,
            source=f"softgrip.board.driver on {self.line.port}",
            back_end="emulated board" if self.emulated else "board",
            period=self.period,
            board=info.identity,
            firmware=f"protocol {PROTOCOL_VERSION} build {info.build}",
            calibration=self.calibration.name,
            notes={"area": f"{self.pump.area!r} m^2", "lead": f"{self.pump.lead!r} m"},
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Stop, vent, and give the port up."""
        try:
            self.stop()
            self.vent(open_valve=True)
        except BoardError:
            # The first error is the one to tell; a board that does not hear stops by itself.
            if error is None:
                raise
        finally:
            self.line.close()
