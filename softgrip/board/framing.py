"""Frames on the line: a checksum against errors, and a byte that only ends frames.

A frame is id, sequence number, payload and their CRC-16/CCITT-FALSE (little-endian), stuffed by
COBS (Cheshire and Baker, 1999) so that no byte is 0, and a 0 at its end.
"""

from binascii import crc_hqx
from dataclasses import dataclass

from cobs import cobs

from softgrip.board.protocol import MESSAGES

LARGEST = 4 + max(message.layout.size for message in MESSAGES)
"""Bytes of the longest frame before it is stuffed."""


@dataclass(frozen=True)
class Frame:
    """What a frame holds: id and sequence number, each a byte, and the payload."""

    id: int
    sequence: int
    payload: bytes = b""


def checksum(data: bytes) -> int:
    """Return the CRC-16/CCITT-FALSE.

    The check value of the catalogue of CRC algorithms:

    >>> hex(checksum(b"123456789"))
    '0x29b1'
    """
    return crc_hqx(data, 0xFFFF)


def encode(frame: Frame) -> bytes:
    """Return a frame as it goes over the line, with its 0.

    >>> encode(Frame(3, 0)).hex(" ")
    '02 03 03 5c 48 00'
    """
    data = bytes((frame.id, frame.sequence)) + frame.payload
    return bytes(cobs.encode(data + checksum(data).to_bytes(2, "little"))) + b"\0"


class FrameReader:
    """Finds the frames in what comes over the line, piece by piece.

    Attributes:
        good: Frames found.
        bad: Frames thrown away: cut, too long, not stuffed as they should be, or with a wrong
            checksum.
        lost: Bytes thrown away with them, without their 0.

    >>> reader, line = FrameReader(), encode(Frame(3, 0)) + b"noise" + encode(Frame(4, 1))
    >>> reader.feed(line[:3]), reader.feed(line[3:]), reader.bad
    ([], [Frame(id=3, sequence=0, payload=b'')], 1)
    """

    def __init__(self) -> None:
        self.good, self.bad, self.lost = 0, 0, 0
        self._begun = bytearray()
        self._skipped = 0

    def feed(self, data: bytes) -> list[Frame]:
        """Return the frames that end in the data; what is begun is kept for the next call."""
        *ended, rest = data.split(b"\0")
        found = []
        for part in ended:
            self._add(part)
            found += self._finish()
        self._add(rest)
        return found

    def _add(self, part: bytes) -> None:
        # A line that never sends a 0 must not fill the memory: beyond the longest frame, only
        # the number of bytes is kept.
        room = max(0, LARGEST + 2 - len(self._begun))
        self._begun += part[:room]
        self._skipped += len(part) - len(part[:room])

    def _finish(self) -> list[Frame]:
        data, skipped = bytes(self._begun), self._skipped
        self._begun.clear()
        self._skipped = 0
        if not data:
            return []  # two 0 in a row: nothing between them
        frame = None if skipped else decode(data)
        if frame is None:
            self.bad += 1
            self.lost += len(data) + skipped
            return []
        self.good += 1
        return [frame]


def decode(stuffed: bytes) -> Frame | None:
    """Return the frame of its bytes without the 0, or None if it is damaged."""
    try:
        data = bytes(cobs.decode(stuffed))
    except cobs.DecodeError:
        return None
    if not 4 <= len(data) <= LARGEST or checksum(data[:-2]) != int.from_bytes(data[-2:], "little"):
        return None
    return Frame(data[0], data[1], data[2:-2])
