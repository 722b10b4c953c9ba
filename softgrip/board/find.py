"""Finding the board by itself: ports by their USB ids, then HELLO on each."""

from collections.abc import Iterable
from dataclasses import dataclass

from serial.tools import list_ports
from serial.tools.list_ports_common import ListPortInfo

from softgrip.board.errors import BoardError, NoBoardError
from softgrip.board.link import SerialLink
from softgrip.board.session import Session

VENDORS = {0x2341: "Arduino", 0x2A03: "Arduino", 0x1A86: "CH340 of a clone", 0x0403: "FTDI"}


@dataclass(frozen=True)
class Candidate:
    """A port that may be a board: its name, what its USB ids say, and what came of HELLO."""

    port: str
    usb: str
    answer: str
    answered: bool

    def __str__(self) -> str:
        return f"{self.port} ({self.usb}): {self.answer}"


def candidates(ports: Iterable[ListPortInfo] | None = None) -> list[Candidate]:
    """Greet the board on each port of a known maker, and say what came of it.

    Opening its port resets an Arduino, whatever runs on it.

    Args:
        ports: As pyserial lists them; None for those of this computer.
    """
    found = []
    for port in list_ports.comports() if ports is None else ports:
        if port.vid not in VENDORS:
            continue
        usb = f"{VENDORS[port.vid]} {port.vid:04x}:{port.pid or 0:04x}"
        answer, answered = _greeted(port.device)
        found.append(Candidate(port.device, usb, answer, answered))
    return found


def _greeted(port: str) -> tuple[str, bool]:
    try:
        link = SerialLink(port)
    except BoardError as error:
        return str(error), False
    session = Session(link)
    try:
        return f"build {session.greet()['build']:08x}", True
    except BoardError as error:
        return str(error), False
    finally:
        session.end()
        link.close()


def find_board(ports: Iterable[ListPortInfo] | None = None) -> Candidate:
    """Return the one board that answers.

    Raises:
        NoBoardError: If none does, or more than one: which to move is not for a program to guess.
            The message lists what was found.
    """
    seen = candidates(ports)
    answered = [one for one in seen if one.answered]
    if len(answered) == 1:
        return answered[0]
    what = "; ".join(map(str, seen)) or "no USB port of a known maker"
    words = "no board answers" if not answered else "several boards answer: name the port"
    raise NoBoardError("any port", f"{words}. Found: {what}")
