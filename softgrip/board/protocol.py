"""What the host and the rig's board say to each other: the one table of messages.

A frame (`softgrip.board.framing`) is a message's id, a sequence number and its fields,
little-endian and unpadded. The header of the firmware, ``firmware/softgrip_rig/protocol.h``, is
made from this table by ``python -m softgrip.board.firmware.header``, so that the two sides cannot
disagree unseen: HELLO carries the table's checksum, and the board refuses another one.

Sequence numbers. The host numbers its frames 0 to 255 and round again; an answer bears the number
of what it answers. HELLO sets the count. Of the others, the board carries out a frame 1 to 127
ahead of the last one (what is skipped is counted as lost), acknowledges a repeated one again
without carrying it out, and refuses an older one as stale; an emergency stop it always obeys.
"""

import struct
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from functools import cached_property
from typing import Any
from zlib import crc32

from softgrip.errors import InvalidInputError
from softgrip.logs.schema import PAD_CHANNELS

PROTOCOL_VERSION = 1
BAUD = 250_000
"""Exact on a 16 MHz board, where 115 200 is 2 % off."""
TELEMETRY_PERIOD = 0.025
"""s."""
TICK = 1e-3
"""Period of the board's clock, of its pressure samples and of its safety checks, s."""
SPEED_SCALE = 256
"""Speeds are in 1/256 step/s."""
CHANNELS = (*PAD_CHANNELS, "pressure", "flex_1", "flex_2", "spare_1", "spare_2")
"""Of the converter, A0 to A13 of the board."""

Values = dict[str, Any]
"""Of a message's fields by name: a whole number, or a tuple of them for an array."""


@dataclass(frozen=True)
class Field:
    """One number of a message, or an array of them: name, code of `struct`, unit, words."""

    name: str
    code: str
    unit: str
    words: str
    count: int = 1


@dataclass(frozen=True)
class Message:
    """A message: name, id (from the host below 128), words, fields.

    >>> turn = Message("turn", 2, "Turn.", (Field("speed", "i", "step/s", ""),))
    >>> turn.pack(speed=-2).hex(), turn.unpack(turn.pack(speed=-2))
    ('feffffff', {'speed': -2})
    """

    name: str
    id: int
    words: str
    fields: tuple[Field, ...] = ()

    @cached_property
    def layout(self) -> struct.Struct:
        """Its payload, little-endian and unpadded."""
        codes = (f"{field.count if field.count > 1 else ''}{field.code}" for field in self.fields)
        return struct.Struct("<" + "".join(codes))

    def pack(self, **values: Any) -> bytes:
        """Return the payload that holds a value for each field.

        Raises:
            InvalidInputError: If a field is missing, unknown, or its value does not fit.
        """
        names = [field.name for field in self.fields]
        if sorted(values) != sorted(names):
            raise InvalidInputError(self.name, expected=f"fields {names}", got=sorted(values))
        flat: list[int] = []
        for field in self.fields:
            value = values[field.name]
            flat.extend(value if isinstance(value, tuple) else (value,))
        try:
            return self.layout.pack(*flat)
        except struct.error as error:
            raise InvalidInputError(
                self.name, expected=f"numbers that fit {self.layout.format}", got=values
            ) from error

    def unpack(self, payload: bytes) -> Values:
        """Return the values in a payload, a tuple for an array.

        Raises:
            InvalidInputError: If the payload's length is another one.
        """
        if len(payload) != self.layout.size:
            raise InvalidInputError(
                self.name, expected=f"{self.layout.size} bytes of payload", got=len(payload)
            )
        numbers = iter(self.layout.unpack(payload))
        return {
            field.name: tuple(next(numbers) for _ in range(field.count))
            if field.count > 1
            else next(numbers)
            for field in self.fields
        }


class SetUp(IntEnum):
    """What the firmware was built for; the pad's has no pump."""

    GRIPPER = 1
    PAD = 2


class Flag(IntFlag):
    """State of the board, in each telemetry frame."""

    HOMED = 1 << 0
    MOVING = 1 << 1
    HOMING = 1 << 2
    ESTOPPED = 1 << 3  # latched
    HOST_SILENT = 1 << 4
    OVER_PRESSURE = 1 << 5
    SENSOR_RANGE = 1 << 6  # latched
    SENSOR_STUCK = 1 << 7  # latched
    POSITION_LIMIT = 1 << 8
    HOME_SWITCH = 1 << 9
    SWITCH_FAULT = 1 << 10  # latched
    GREETED = 1 << 11
    VALVE_OPEN = 1 << 12


class Reason(IntEnum):
    """Why a command was refused."""

    UNKNOWN_MESSAGE = 1
    WRONG_LENGTH = 2
    STALE = 3
    WRONG_VERSION = 4
    NOT_GREETED = 5
    ESTOPPED = 6
    NOT_HOMED = 7
    OVER_PRESSURE = 8
    SENSOR_FAULT = 9
    POSITION_LIMIT = 10
    SPEED_LIMIT = 11
    HARD_BOUND = 12
    MOVING = 13
    STILL_FAULTY = 14
    NO_PUMP = 15
    NO_VALVE = 16


class ResetCause(IntFlag):
    """Bits of the processor's reset register, MCUSR."""

    POWER_ON = 1
    EXTERNAL = 2
    BROWN_OUT = 4
    WATCHDOG = 8
    JTAG = 16


def in_words(one: IntEnum | IntFlag) -> str:
    """Return the name of a reason, or of the flags that are up, as one says it.

    >>> in_words(Reason.NOT_HOMED), in_words(Flag.HOMED | Flag.OVER_PRESSURE)
    ('not homed', 'homed, over pressure')
    """
    parts = one if isinstance(one, IntFlag) else (one,)
    return ", ".join((part.name or "").lower().replace("_", " ") for part in parts)


def reason_in_words(number: int) -> str:
    """Return a reason in words, also one that is not known here.

    >>> reason_in_words(7), reason_in_words(99)
    ('not homed', 'reason 99')
    """
    return next((in_words(one) for one in Reason if one == number), f"reason {number}")


LIMITS = (
    Field("pressure", "H", "count", "at which pushing stops"),
    Field("position", "i", "step", "furthest into the syringe, from home"),
    Field("speed", "H", "step/s", "largest"),
    Field("acceleration", "H", "step/s^2", "largest"),
    Field("silence", "H", "ms", "of the host, after which the motor stops"),
)
"""What SET_LIMITS sets, within the hard bounds that HELLO_ANSWER tells with a prefix ``hard_``."""

_HARD = tuple(
    Field(f"hard_{one.name}", one.code, one.unit, f"bound of {one.name}") for one in LIMITS
)
_VERSION = (
    Field("version", "B", "", "of the protocol"),
    Field("table", "I", "", "checksum of this table"),
)

HELLO = Message("hello", 1, "Greet; before it the board moves nothing.", _VERSION)
SETPOINT = Message(
    "setpoint",
    2,
    "Turn at a speed until told otherwise. Refused, it brings the motor to rest, unless homing.",
    (Field("speed", "i", "1/256 step/s", "positive into the syringe"),),
)
HEARTBEAT = Message("heartbeat", 3, "The host is alive.")
ESTOP = Message("estop", 4, "Stop at once, and stay so until CLEAR.")
CLEAR = Message("clear", 5, "End an emergency stop and latched faults, if their cause is gone.")
HOME = Message("home", 6, "Find the home switch: position 0, the plunger drawn out.")
SET_LIMITS = Message("set_limits", 7, "Set the limits; at rest only.", LIMITS)
VENT = Message("vent", 8, "Open or shut the valve.", (Field("open", "B", "", "1 to open"),))
COUNTERS = Message("counters", 9, "Ask for the counters.")

HELLO_ANSWER = Message(
    "hello_answer",
    129,
    "Who the board is.",
    (
        *_VERSION,
        Field("build", "I", "", "checksum of the firmware's sources"),
        Field("set_up", "B", "", "a SetUp"),
        Field("reset_cause", "B", "", "a ResetCause"),
        Field("valve", "B", "", "1 if there is one"),
        Field("steps", "H", "step/rev", "of the motor and its driver"),
        *LIMITS,
        *_HARD,
    ),
)
ACK = Message("ack", 130, "Done.", (Field("id", "B", "", "of the message"),))
NACK = Message(
    "nack",
    131,
    "Refused.",
    (Field("id", "B", "", "of the message"), Field("reason", "B", "", "a Reason")),
)
TELEMETRY = Message(
    "telemetry",
    132,
    "What the board sees, at 40 Hz.",
    (
        Field("number", "H", "", "of the frame, round from 65535"),
        Field("time", "I", "ms", "since the reset"),
        Field("channels", "H", "count", "k < 9 read 13 - k ms ago, k > 9 14 - k", len(CHANNELS)),
        Field("position", "i", "step", "since home, or since the reset"),
        Field("speed", "i", "1/256 step/s", "of the motor"),
        Field("flags", "H", "", "of Flag"),
        Field("last", "B", "", "sequence number acknowledged last"),
    ),
)
COUNTERS_ANSWER = Message(
    "counters_answer",
    137,
    "Frames since the reset.",
    (
        Field("good", "I", "frame", "valid"),
        Field("bad", "H", "frame", "with a wrong checksum, or cut"),
        Field("overlong", "H", "frame", "longer than any message"),
        Field("lost", "H", "frame", "skipped sequence numbers"),
        Field("stale", "H", "frame", "refused as older than the last"),
        Field("dropped", "H", "frame", "of the board's own that found no room"),
    ),
)

MESSAGES = (
    *(HELLO, SETPOINT, HEARTBEAT, ESTOP, CLEAR, HOME, SET_LIMITS, VENT, COUNTERS),
    *(HELLO_ANSWER, ACK, NACK, TELEMETRY, COUNTERS_ANSWER),
)
BY_ID = {message.id: message for message in MESSAGES}
TABLE = crc32(
    repr(
        [
            *(
                (m.name, m.id, [(f.name, f.code, f.count, f.unit) for f in m.fields])
                for m in MESSAGES
            ),
            *((one.name, int(one)) for kind in (SetUp, Flag, Reason) for one in kind),
            *CHANNELS,
        ]
    ).encode()
)
"""Checksum of all of the above that the two sides must agree on; words may change."""
