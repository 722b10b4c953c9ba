"""What can go wrong between a host and a board: the port, the command, and what the board said."""

from collections.abc import Mapping

from softgrip.errors import SoftgripError


class BoardError(SoftgripError):
    """A fault of a board or of the line to it.

    Args:
        port: Where the board is.
        message: What happened, and what to do.
        command: What was asked of the board; empty if nothing.
        state: What it last said of itself; empty if nothing.

    >>> str(BoardError("COM3", "no answer", command="SETPOINT", state="homed"))
    'COM3: no answer (command: SETPOINT; board: homed)'
    """

    def __init__(self, port: str, message: str, *, command: str = "", state: str = "") -> None:
        self.port, self.command, self.state = port, command, state
        more = [f"command: {command}"] if command else []
        more += [f"board: {state}"] if state else []
        super().__init__(f"{port}: {message}" + (f" ({'; '.join(more)})" if more else ""))


class PortUnavailableError(BoardError):
    """A port cannot be opened."""


class PortBusyError(PortUnavailableError):
    """Another program has a port; `holders` are the programs seen, names by process number."""

    def __init__(self, port: str, holders: Mapping[int, str]) -> None:
        self.holders = holders
        seen = ", ".join(f"{name} (process {number})" for number, name in holders.items())
        unseen = "its name is not seen; or this program, by another connection"
        super().__init__(port, f"another program has it, {seen or unseen}: close the port there")


class NoBoardError(BoardError):
    """No board was found."""


class ConnectionLostError(BoardError):
    """The line broke: a cable pulled, a board without power."""

    def __init__(self, port: str, reason: str, *, command: str = "", state: str = "") -> None:
        super().__init__(port, f"the line is lost: {reason}", command=command, state=state)


class NoAnswerError(ConnectionLostError):
    """A board that should have answered did not."""


class BoardResetError(ConnectionLostError):
    """The board began anew, and has forgotten the place of the plunger."""


class VersionMismatchError(BoardError):
    """Host and firmware speak other versions of the protocol."""


class WrongBoardError(BoardError):
    """A calibration belongs to another board."""


class CommandRefusedError(BoardError):
    """The board, or what stands for one, said no: its reason is in `reason`."""

    def __init__(self, port: str, reason: str, *, command: str, state: str = "") -> None:
        self.reason = reason
        super().__init__(port, f"refused: {reason}", command=command, state=state)


class EndOfReplayError(BoardError):
    """A replayed log has no further row."""
