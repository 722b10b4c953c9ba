"""One interface over what can be driven: a simulated rig, a replay, an emulated board, a board."""

from typing import Protocol, Self

from numpy.typing import ArrayLike

from softgrip.board.errors import CommandRefusedError
from softgrip.logs.schema import LogHeader
from softgrip.simulator.motor import one_speed
from softgrip.simulator.sensors import Measurement


class Rig(Protocol):
    """A rig that is sampled: a context manager that stops the pump on its way out.

    A measurement has a pressure of shape (1,) and angles of shape (fingers, 1), as those of a
    simulated gripper of one run, so that controllers and loops need not know what they drive.
    """

    period: float
    """Sampling period, s."""
    fingers: int
    """Number of fingers with a flex sensor."""
    real_time: bool
    """Whether its time goes on by itself, as a board's does, and not only when asked. Then it keeps
    the pace of a clock, and hears an emergency stop while another thread waits for a sample; else
    nothing can be said to it but between two periods."""

    def measure(self) -> Measurement:
        """Return what the sensors say now."""
        ...

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period and return the measurement at its end.

        Args:
            command: rad/s, positive into the syringe, one number. A command that would go beyond a
                limit of pressure or travel is held back, and an event says so.

        Raises:
            CommandRefusedError: After an emergency stop, and for a push before the plunger's place
                is known.
        """
        ...

    def take_event(self) -> str:
        """Return words on what happened since the last call, empty if nothing."""
        ...

    def stop(self) -> None:
        """Bring the motor to rest."""
        ...

    def emergency_stop(self) -> None:
        """Stop at once, and refuse to move until `clear`."""
        ...

    def clear(self) -> None:
        """Take an emergency stop back."""
        ...

    def home(self) -> None:
        """Draw the plunger out to its end, from where its travel counts."""
        ...

    def reconnect(self, within: float) -> None:
        """Find a line that was lost again, for at most some seconds."""
        ...

    def header(self) -> LogHeader:
        """Return what a log says of this rig."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(self, *error: object) -> None: ...


class StandIn:
    """What stands in for a board, as strict as the board, so that a script runs on both.

    Args:
        name: Of the stand-in, for messages.
        pressure_limit: Pa, above which nothing is pushed.
    """

    real_time = False

    def __init__(self, name: str, pressure_limit: float) -> None:
        self.name, self.pressure_limit = name, pressure_limit
        self._stopped = self._homed = False
        self._event = ""

    def permitted(self, command: ArrayLike, pressure: float) -> float:
        """Return the speed that a command becomes at a pressure [Pa], or refuse it.

        Raises:
            InvalidInputError: If the command is not one finite number.
            CommandRefusedError: After an emergency stop, or for a push before homing.
        """
        speed = one_speed(command)
        if self._stopped:
            raise CommandRefusedError(
                self.name, "emergency stop; clear() takes it back", command="advance"
            )
        if speed > 0 and not self._homed:
            raise CommandRefusedError(
                self.name, "the plunger's place is not known; home() first", command="advance"
            )
        if speed > 0 and pressure > self.pressure_limit:
            self._event = "held back: over pressure"
            return 0.0
        return speed

    def take_event(self) -> str:
        """Return words on what happened since the last call, empty if nothing."""
        event, self._event = self._event, ""
        return event

    def stop(self) -> None:
        """Do nothing, unless something moves."""

    def emergency_stop(self) -> None:
        """Stop, and refuse to move until `clear`."""
        self._stopped = True
        self.stop()

    def clear(self) -> None:
        """Take an emergency stop back."""
        self._stopped = False

    def home(self) -> None:
        """Allow pushes."""
        self._homed = True

    def reconnect(self, within: float) -> None:
        """Do nothing: this line is never lost."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()
