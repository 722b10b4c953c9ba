"""The line to a board: bytes out, bytes in, and the clock by which both sides wait.

pyserial's lock of a port, a ``flock``, binds only programs that ask for it. What is done here
beside it binds the others too: who has the port already is looked up, and who comes later is
refused by the kernel.
"""

import errno
import os
import sys
import time
import weakref
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Protocol, final

import serial

from softgrip.board.errors import ConnectionLostError, PortBusyError, PortUnavailableError
from softgrip.board.protocol import BAUD
from softgrip.errors import InvalidInputError

if sys.platform != "win32":
    import fcntl
    import termios

WRITE_WITHIN = 0.5
"""s: a line that takes no bytes for so long is a broken one."""
AT_ONCE = 4096
"""Bytes that one reading returns at most, whatever keeps coming."""


class Link(Protocol):
    """What the driver needs of a line; times are seconds of the line's own clock."""

    name: str
    """For messages."""
    real_time: bool
    """Whether its clock runs by itself; else only while one reads, as in emulation."""

    def write(self, data: bytes) -> None:
        """Send bytes."""
        ...

    def read(self, timeout: float) -> bytes:
        """Return what has come; wait at most `timeout` seconds for a first byte."""
        ...

    def now(self) -> float:
        """Return the time, s."""
        ...

    def close(self) -> None:
        """Give the line up; nothing happens if that was done before."""
        ...


@final
class SerialLink:
    """A serial port, a pseudo-terminal or a socket.

    Args:
        name: What pyserial's ``serial_for_url`` takes: "/dev/ttyACM0", "COM3",
            "socket://host:port".

    Raises:
        PortUnavailableError: If it cannot be opened.
        PortBusyError: If another program has it, since two hosts that command one pump are a
            danger.

    Opening the port of an Arduino resets it; its boot loader then listens for about a second, in
    which nothing answers.

    One port, one host, holds within these bounds. A program that locks ports, as this one does, is
    refused, and refuses, always. One that asks for no lock is found before the port is opened if
    it runs under Linux and this user may see it (see `holders`); if it comes later, the
    kernel of Linux or macOS refuses it, unless it is root's. Windows lets nobody open a port twice.
    Processes forked while a port is open can use it: fork before, or start them by "spawn".
    A socket has the peers that its server lets in, and none of this; nor has a port that is named
    by a URL, such as "spy:///dev/ttyACM0".

    A pseudo-terminal whose host was killed stays closed to all but root until its server ends.
    """

    real_time = True

    def __init__(self, name: str) -> None:
        if not name:
            raise InvalidInputError("port", expected="a port or a URL of one", got=name)
        self.name = name
        self._release: Callable[[], object] = lambda: None
        local = "://" not in name  # pyserial knows no lock on a URL
        if local and (found := holders(name)):
            raise PortBusyError(name, found)
        try:
            lock = {"exclusive": True} if local else {}
            self._port = serial.serial_for_url(
                name, baudrate=BAUD, timeout=0, write_timeout=WRITE_WITHIN, **lock
            )
            if local and sys.platform != "win32":
                claim(self._port.fileno())
                # Also for a link that is dropped without being closed.
                self._release = weakref.finalize(self, release, self._port.fileno(), os.getpid())
        except (OSError, ValueError) as error:  # serial.SerialException is an OSError
            if getattr(error, "errno", None) in (errno.EBUSY, errno.EAGAIN):
                raise PortBusyError(name, holders(name)) from error
            # Windows tells a port that is taken from a forbidden one in no way.
            raise PortUnavailableError(
                name, f"cannot be opened, or another program has it: {error}"
            ) from error

    def write(self, data: bytes) -> None:
        """Send bytes."""
        try:
            self._port.write(data)
        except (OSError, TypeError) as error:  # pyserial's descriptor is None once closed
            raise ConnectionLostError(self.name, str(error)) from error

    def read(self, timeout: float) -> bytes:
        """Return what has come; wait at most `timeout` seconds for a first byte.

        Raises:
            ConnectionLostError: If the line broke, once all that had been received from it has been
                returned.
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
                raise ConnectionLostError(self.name, str(error)) from error
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


def holders(port: str) -> dict[int, str]:
    """Return the other programs that have a port open: names by process number.

    Args:
        port: Path of a device, or of a link to it.

    Returns:
        dict: Empty where there is no ``/proc``, as on Windows and macOS. Programs of other users
            are seen by root alone. Children of this process are not counted, since a fork inherits
            what is open; nor is who serves a pseudo-terminal, having both its ends.
    """
    device = os.path.realpath(port)
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):  # a process that has ended, or another user's
            opened = {str(entry.readlink()) for entry in (folder / "fd").iterdir()}
            served = device.startswith("/dev/pts/") and any(one.endswith("/ptmx") for one in opened)
            if device in opened and not served and not _of_this_process(int(folder.name)):
                found[int(folder.name)] = (folder / "comm").read_text().strip()
    return found


def _of_this_process(number: int) -> bool:
    """Whether a process is this one, or was begun by it."""
    while number not in (0, os.getpid()):
        # The name before the parent's number may hold blanks and brackets.
        number = int(Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[1])
    return number != 0


def claim(descriptor: int) -> None:
    """Let the kernel refuse whoever opens this port from now on, root apart."""
    if sys.platform != "win32":
        fcntl.ioctl(descriptor, termios.TIOCEXCL)


def release(descriptor: int, owner: int) -> None:
    """Take `claim` and pyserial's lock back, which a forked child would hold on to.

    Args:
        descriptor: Of the port.
        owner: Process that opened it; in another one, a child of it, nothing happens.
    """
    if sys.platform != "win32" and os.getpid() == owner:
        with suppress(OSError):  # a line that is broken is nobody's
            fcntl.ioctl(descriptor, termios.TIOCNXCL)
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_UN)
