"""What the live page asks of a rig before it drives it."""

from softgrip.board.driver import Board
from softgrip.control.pid import PERIOD
from softgrip.errors import InvalidInputError
from softgrip.rig.interface import Connection


def listens(connection: Connection) -> bool:
    """Return whether a rig can be spoken to while another thread waits for its answer.

    A board on a port can: the driver listens in the background. Whatever is computed or emulated
    in virtual time can not, and is told between two periods.
    """
    return isinstance(connection, Board) and connection.real_time


def check_period(connection: Connection) -> None:
    """Raise `InvalidInputError` unless a rig is sampled as the controller is, each 25 ms."""
    if abs(connection.period - PERIOD) > 1e-9:
        raise InvalidInputError(
            "connection", expected=f"a period of {PERIOD} s", got=connection.period
        )


def check_simulated(connection: Connection) -> None:
    """Raise `InvalidInputError` unless a rig is the simulated one, which moves nothing."""
    if (found := connection.header().back_end) != "simulated rig":
        raise InvalidInputError("connection", expected="the simulated rig", got=found)
