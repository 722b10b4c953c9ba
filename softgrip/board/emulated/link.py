"""The emulated board as a `softgrip.board.link.Link`: waiting is what lets its time pass."""

from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.errors import ConnectionLostError


class EmulatedLink:
    """A line to an emulated board."""

    def __init__(self, board: EmulatedBoard) -> None:
        self.board, self.closed = board, False

    def _check(self) -> None:
        if self.closed:
            raise ConnectionLostError("emulated board", "the link was closed")

    def write(self, data: bytes) -> None:
        """Send bytes."""
        self._check()
        self.board.write(data)

    def read(self, timeout: float) -> bytes:
        """Return what has come; let at most `timeout` s of virtual time pass for a first byte."""
        self._check()
        return self.board.read(timeout)

    def now(self) -> float:
        """Return the virtual time, s."""
        return self.board.time

    def close(self) -> None:
        """Give the line up; the board goes on when its time does."""
        self.closed = True
