"""Keeping a serial port to one program, as far as the system lets one.

pyserial's lock, a ``flock``, binds only programs that ask for it. What is done here beside it binds
the others too: who has the port already is looked up, and who comes later is refused by the kernel.
"""

import os
import sys
from contextlib import suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl
    import termios


def holders(port: str) -> dict[int, str]:
    """Return the other programs that have a port open: names by process number.

    Parameters
    ----------
    port
        Path of a device, or of a link to it.

    Returns
    -------
    dict
        Empty where there is no ``/proc``, as on Windows and macOS. Programs of other users are
        seen by root alone. Children of this process are not counted, since a fork inherits what is
        open; nor is who serves a pseudo-terminal, having both its ends.
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

    Parameters
    ----------
    descriptor
        Of the port.
    owner
        Process that opened it; in another one, a child of it, nothing happens.
    """
    if sys.platform != "win32" and os.getpid() == owner:
        with suppress(OSError):  # a line that is broken is nobody's
            fcntl.ioctl(descriptor, termios.TIOCNXCL)
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_UN)
