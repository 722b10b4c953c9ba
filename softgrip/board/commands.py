"""What a board can be told beside a speed: to stop, home, vent, and its limits."""

from softgrip.board.errors import CommandRefusedError
from softgrip.board.info import BoardInfo, Limits
from softgrip.board.line import BoardLine
from softgrip.board.protocol import (
    CLEAR,
    COUNTERS,
    ESTOP,
    HOME,
    SET_LIMITS,
    SETPOINT,
    VENT,
    Flag,
    Reason,
)
from softgrip.board.session import Values
from softgrip.board.telemetry import Telemetry, reason_name

HOME_WITHIN = 60.0
"""s, for the whole stroke at a slow speed."""
STOP_WITHIN = 2.0
HUNG_AFTER = 0.5
"""s after a command's period, from which a turning motor is left to the board's own watchdog."""
HELD_BACK = {reason_name(one) for one in (Reason.OVER_PRESSURE, Reason.POSITION_LIMIT)}
"""Reasons that hold a push back and end nothing."""


class BoardCommands:
    """A greeted board.

    Parameters
    ----------
    line
        To it.
    """

    def __init__(self, line: BoardLine) -> None:
        self.line = line

    @property
    def info(self) -> BoardInfo:
        """Who the board is, and its limits."""
        return self.line.info

    @property
    def telemetry(self) -> Telemetry:
        """The last telemetry in the board's own units, with all channels."""
        return self.line.latest

    @property
    def lost(self) -> int:
        """Telemetry frames that never came since the line was opened."""
        return self.line.session.lost

    def turn(self, speed: float, hold: float) -> None:
        """Turn at a speed [rad/s] until told otherwise, or a while after `hold` seconds.

        Raises
        ------
        CommandRefusedError
            After an emergency stop, before homing, or with a faulty sensor. A push against a limit
            is held back and noted.
        """
        session = self.line.session
        session.alive_for(hold + HUNG_AFTER if speed else float("inf"))
        try:
            session.ask(SETPOINT, speed=self.line.scale.speed_out(speed))
        except CommandRefusedError as error:
            if error.reason not in HELD_BACK:
                raise
            self.line.note(f"held back: {error.reason}")

    def stop(self) -> None:
        """Bring the motor to rest, and wait until it is."""
        try:
            self.turn(0.0, 0.0)
        except CommandRefusedError as error:
            # A speed that is refused, as after an emergency stop, brings the motor to rest as well;
            # a board that is homing goes on, but rests when it is greeted.
            if error.reason == reason_name(Reason.MOVING):
                self.line.greet()
        self.line.wait_for(lambda flags: not flags & Flag.MOVING, STOP_WITHIN, "rest")

    def emergency_stop(self) -> None:
        """Stop at once, and refuse to move until `clear`; the board keeps the latch."""
        self.line.session.ask(ESTOP)

    def clear(self) -> None:
        """Take an emergency stop and latched faults back, if their cause is gone."""
        self.line.session.ask(CLEAR)

    def home(self) -> None:
        """Draw the plunger out to its switch, through an open valve where there is one.

        Raises
        ------
        CommandRefusedError
            If the switch is not found.
        """
        self.stop()
        self.vent(open_valve=True)
        self.line.session.alive_for(HOME_WITHIN)
        try:
            self.line.session.ask(HOME)
        except CommandRefusedError as error:
            # Said again, since its answer was lost, it finds itself under way.
            if error.reason != reason_name(Reason.MOVING):
                raise
        self.line.wait_for(lambda flags: not flags & Flag.HOMING, HOME_WITHIN, "end of homing")
        if not self.telemetry.flags & Flag.HOMED:
            raise CommandRefusedError(
                self.line.port, "homing failed", command="home", state=self.line.session.state
            )
        self.line.session.alive_for(float("inf"))
        self.vent(open_valve=False)

    def vent(self, *, open_valve: bool) -> None:
        """Open or shut the valve; nothing happens where there is none."""
        if self.info.valve:
            self.line.session.ask(VENT, open=int(open_valve))

    def set_limits(self, limits: Limits) -> Limits:
        """Set the limits, at rest and within the board's bounds; return those now in force."""
        fields = SET_LIMITS.pack(**self.line.scale.limits_out(limits))
        self.line.session.say(SET_LIMITS, fields)
        self.line.greet()
        return self.info.limits

    def counters(self) -> Values:
        """Return the board's counts of good and bad frames."""
        return self.line.session.ask(COUNTERS)
