"""The line to a board: bytes out, bytes in, and the clock by which both sides wait."""

import time
from typing import Protocol, final

import serial

from softgrip.errors import InvalidInputError
from softgrip.rig.board_errors import ConnectionLostError, PortUnavailableError
from softgrip.rig.protocol import BAUD

WRITE_WITHIN = 0.5
"""s: a line that takes no bytes for so long is a broken one."""


class Link(Protocol):
    """What the driver needs of a line; times are seconds of the line's own clock."""

    def write(self, data: bytes) -> None:
        """Send bytes."""
        ...

    def read(self, timeout: float) -> bytes:
        """Return what has come; wait at most `timeout` seconds for a first byte."""
        ...

    def now(self) -> float:
        """Return the time, s. It may stand still unless one reads, as in emulation."""
        ...

    def close(self) -> None:
        """Give the line up; nothing happens if that was done before."""
        ...


@final
class SerialLink:
    """A serial port, a pseudo-terminal or a socket.

    Parameters
    ----------
    url
        What pyserial's ``serial_for_url`` takes: "/dev/ttyACM0", "COM3", "socket://host:port".

    Raises
    ------
    PortUnavailableError
        If it cannot be opened; also if another program has it, since two hosts that command one
        pump are a danger.

    Notes
    -----
    Opening the port of an Arduino resets it; its boot loader then listens for about a second, in
    which nothing answers.
    """

    def __init__(self, url: str) -> None:
        if not url:
            raise InvalidInputError("url", expected="a port or a URL of one", got=url)
        self.url = url
        try:
            # A socket has one peer by itself, and pyserial knows no lock on it.
            lock = {} if "://" in url else {"exclusive": True}
            self._port = serial.serial_for_url(
                url, baudrate=BAUD, timeout=0, write_timeout=WRITE_WITHIN, **lock
            )
        except (OSError, ValueError) as error:  # serial.SerialException is an OSError
            raise PortUnavailableError(url, str(error)) from error

    def write(self, data: bytes) -> None:
        """Send bytes."""
        try:
            self._port.write(data)
        except (OSError, TypeError) as error:  # pyserial's descriptor is None once closed
            raise ConnectionLostError(self.url, str(error)) from error

    def read(self, timeout: float) -> bytes:
        """Return what has come; wait at most `timeout` seconds for a first byte."""
        try:
            self._port.timeout = timeout
            first = self._port.read(1)
            if not first:
                return b""
            return bytes(first + self._port.read(self._port.in_waiting))
        except (OSError, TypeError) as error:
            raise ConnectionLostError(self.url, str(error)) from error

    def now(self) -> float:
        """Return the seconds of the computer's monotonic clock."""
        return time.monotonic()

    def close(self) -> None:
        """Close the port."""
        # pyserial leaves a socket open whose peer has gone.
        left = getattr(self._port, "_socket", None)
        self._port.close()
        if left is not None:
            left.close()
