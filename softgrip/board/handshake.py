"""The first words between a host and a board: whether they speak the same language."""

from softgrip.board.errors import (
    CommandRefusedError,
    NoAnswerError,
    NoBoardError,
    VersionMismatchError,
)
from softgrip.board.protocol import HELLO, PROTOCOL_VERSION, TABLE, Reason
from softgrip.board.session import Session, Values
from softgrip.board.telemetry import reason_name

GREET_WITHIN = 6.0
"""s: an Arduino that was reset by the opening of its port answers after one to two."""


def greet(session: Session, *, within: float = GREET_WITHIN) -> Values:
    """Say HELLO until a board answers, and return its answer.

    Raises
    ------
    VersionMismatchError
        If the firmware was made from another table of messages.
    NoBoardError
        If nothing answers.
    """
    payload = HELLO.pack(version=PROTOCOL_VERSION, table=TABLE)
    deadline = session.link.now() + within
    told: Values = {}
    while not told:
        try:
            told = session.say(HELLO, payload, tries=1)
        except NoAnswerError:
            if session.link.now() >= deadline:
                raise NoBoardError(
                    session.port, f"no board answered in {within:g} s: is softgrip_rig flashed?"
                ) from None
        except CommandRefusedError as error:
            if error.reason != reason_name(Reason.WRONG_VERSION):
                raise
            told = {"version": -1, "table": -1}
    if (told["version"], told["table"]) != (PROTOCOL_VERSION, TABLE):
        raise VersionMismatchError(
            session.port,
            f"the firmware is not of this softgrip, which speaks protocol {PROTOCOL_VERSION} "
            f"({TABLE:08x}): flash softgrip/board/firmware/softgrip_rig/softgrip_rig.ino",
            command="hello",
        )
    return told
