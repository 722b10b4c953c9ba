"""The line to a board: bytes out, bytes in, and the clock by which both sides wait."""

import errno
import os
import sys
import time
import weakref
from collections.abc import Callable
from typing import Protocol, final

import serial

from softgrip.board.errors import ConnectionLostError, PortBusyError, PortUnavailableError
from softgrip.board.port_lock import claim, holders, release
from softgrip.board.protocol import BAUD
from softgrip.errors import InvalidInputError

WRITE_WITHIN = 0.5
"""s: a line that takes no bytes for so long is a broken one."""
AT_ONCE = 4096
"""Bytes that one reading returns at most, whatever keeps coming."""


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
        If it cannot be opened.
    PortBusyError
        If another program has it, since two hosts that command one pump are a danger.

    Notes
    -----
    Opening the port of an Arduino resets it; its boot loader then listens for about a second, in
    which nothing answers.

    One port, one host, holds within these bounds. A program that locks ports, as this one does, is
    refused, and refuses, always. One that asks for no lock is found before the port is opened if
    it runs under Linux and this user may see it (see `port_lock.holders`); if it comes later, the
    kernel of Linux or macOS refuses it, unless it is root's. Windows lets nobody open a port twice.
    Processes forked while a port is open can use it: fork before, or start them by "spawn".
    A socket has the peers that its server lets in, and none of this.

    A pseudo-terminal whose host was killed stays closed to all but root until its server ends.
    """

    def __init__(self, url: str) -> None:
        if not url:
            raise InvalidInputError("url", expected="a port or a URL of one", got=url)
        self.url = url
        self._release: Callable[[], object] = lambda: None
        local = "://" not in url  # pyserial knows no lock on a URL
        if local and (found := holders(url)):
            raise PortBusyError(url, found)
        try:
            lock = {"exclusive": True} if local else {}
            self._port = serial.serial_for_url(
                url, baudrate=BAUD, timeout=0, write_timeout=WRITE_WITHIN, **lock
            )
            if local and sys.platform != "win32":
                claim(self._port.fileno())
                # Also for a link that is dropped without being closed.
                self._release = weakref.finalize(self, release, self._port.fileno(), os.getpid())
        except (OSError, ValueError) as error:  # serial.SerialException is an OSError
            if getattr(error, "errno", None) in (errno.EBUSY, errno.EAGAIN):
                raise PortBusyError(url, holders(url)) from error
            # Windows tells a port that is taken from a forbidden one in no way.
            raise PortUnavailableError(
                url, f"cannot be opened, or another program has it: {error}"
            ) from error

    def write(self, data: bytes) -> None:
        """Send bytes."""
        try:
            self._port.write(data)
        except (OSError, TypeError) as error:  # pyserial's descriptor is None once closed
            raise ConnectionLostError(self.url, str(error)) from error

    def read(self, timeout: float) -> bytes:
        """Return what has come; wait at most `timeout` seconds for a first byte.

        Raises
        ------
        ConnectionLostError
            If the line broke, once all that had been received from it has been returned.
        """
        found = b""
        try:
            self._port.timeout = timeout
            found = self._port.read(1)
            # A pyserial reading in which the line breaks throws away what it has got so far. So
            # each asks for no more than is there; on a socket, that is told byte by byte.
            while found and len(found) < AT_ONCE and (waiting := self._port.in_waiting):
                found += self._port.read(waiting)
        except (OSError, TypeError) as error:
            if not found:
                raise ConnectionLostError(self.url, str(error)) from error
        return found

    def now(self) -> float:
        """Return the seconds of the computer's monotonic clock."""
        return time.monotonic()

    def close(self) -> None:
        """Close the port, and let others have it."""
        self._release()
        # pyserial leaves a socket open whose peer has gone.
        left = getattr(self._port, "_socket", None)
        self._port.close()
        if left is not None:
            left.close()
