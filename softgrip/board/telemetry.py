"""What a board last said of itself, and the words for its flags and reasons."""

from dataclasses import dataclass

from softgrip.board.protocol import TELEMETRY, Flag, Reason


@dataclass(frozen=True)
class Telemetry:
    """A telemetry frame.

    Attributes
    ----------
    number
        Of the frame, round from 65535.
    time
        Since the board's reset, s.
    channels
        Counts, in the order of `protocol.CHANNELS`.
    position, speed
        In steps, and in the board's unit of speed.
    flags
        The board's state.
    """

    number: int
    time: float
    channels: tuple[int, ...]
    position: int
    speed: int
    flags: Flag

    @classmethod
    def of(cls, payload: bytes) -> "Telemetry":
        """Return the content of a frame's payload."""
        number, time, *more = TELEMETRY.layout.unpack(payload)
        position, speed, flags, _ = more[-4:]
        return cls(number, time * 1e-3, tuple(more[:-4]), position, speed, Flag(flags))


def in_words(flags: Flag) -> list[str]:
    """Return the names of the flags that are up.

    >>> in_words(Flag.HOMED | Flag.OVER_PRESSURE)
    ['homed', 'over pressure']
    """
    return [one.name.lower().replace("_", " ") for one in flags if one.name]


def reason_name(reason: int) -> str:
    """Return a reason in words.

    >>> reason_name(Reason.NOT_HOMED), reason_name(99)
    ('not homed', 'reason 99')
    """
    named = {int(one): one.name.lower().replace("_", " ") for one in Reason}
    return named.get(reason, f"reason {reason}")
