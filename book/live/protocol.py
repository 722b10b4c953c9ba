"""What the pages tell of board and protocol, made from the tables that host and firmware share."""

from enum import IntEnum, IntFlag
from struct import calcsize

import pandas as pd

from book.companion.markdown import Markdown, as_markdown
from softgrip.board import protocol
from softgrip.board.firmware.header import README, TYPES
from softgrip.board.framing import LARGEST
from softgrip.board.protocol import MESSAGES, in_words

FRAME = 2 + 2 + 1 + 1
"""Bytes of a frame beside its payload: id, number; CRC; the byte of COBS; the 0 at the end."""
TELEMETRY_BYTES = protocol.TELEMETRY.layout.size + FRAME
"""Of a telemetry frame on the line."""
BITS = 10
"""Of a byte on the line, 8N1: a start bit and a stop bit beside the eight."""
HOST_IDS = 128
"""The host's messages have ids below."""


def readme_section(title: str) -> Markdown:
    """Return a section of the firmware's description, without its title."""
    _, _, text = README.read_text(encoding="utf-8").partition(f"\n## {title}\n")
    return Markdown(text.partition("\n## ")[0].strip())


def message_table() -> pd.DataFrame:
    """Tabulate all messages: who says them, and how long they are on the line."""
    return pd.DataFrame(
        {
            "message": f"`{one.name.upper()}`",
            "id": one.id,
            "from": "host" if one.id < HOST_IDS else "board",
            "payload (bytes)": one.layout.size,
            "frame (bytes)": one.layout.size + FRAME,
            "what it does": one.words,
        }
        for one in MESSAGES
    )


def field_table(message: protocol.Message) -> pd.DataFrame:
    """Tabulate the fields of a message in their order on the line."""
    rows, offset = [], 0
    for field in message.fields:
        rows.append(
            {
                "byte": offset,
                "field": f"`{field.name}`",
                "type": TYPES[field.code].removesuffix("_t")
                + (f"[{field.count}]" if field.count > 1 else ""),
                "unit": field.unit,
                "what": field.words,
            }
        )
        offset += calcsize(f"<{field.count}{field.code}")
    return pd.DataFrame(rows, columns=["byte", "field", "type", "unit", "what"])


def all_fields() -> Markdown:
    """Return the fields of each message that has any, under its name."""
    parts = [
        f"**`{one.name.upper()}`** ({one.id}). {one.words}\n\n{as_markdown(field_table(one)).text}"
        for one in MESSAGES
        if one.fields
    ]
    return Markdown("\n\n".join(parts))


def bit_table(flags: type[IntFlag]) -> pd.DataFrame:
    """Tabulate the bits of flags."""
    return pd.DataFrame({"bit": one.bit_length() - 1, "name": in_words(one)} for one in flags)


def reason_table(reasons: type[IntEnum]) -> pd.DataFrame:
    """Tabulate the values of an enumeration."""
    return pd.DataFrame({"value": int(one), "name": in_words(one)} for one in reasons)


def line_table() -> pd.DataFrame:
    """Tabulate the line: version, rate, and what of it telemetry takes."""
    rate, frame = protocol.BAUD / BITS, TELEMETRY_BYTES
    rows = (
        ("protocol version", str(protocol.PROTOCOL_VERSION)),
        ("checksum of the table", f"`{protocol.TABLE:08x}`"),
        ("rate of the line", f"{protocol.BAUD} baud, 8N1: {rate / 1e3:.0f} kB/s"),
        ("longest frame before stuffing", f"{LARGEST} bytes"),
        ("a telemetry frame takes", f"{frame} bytes, {1e3 * frame / rate:.1f} ms"),
        ("telemetry takes of the line", f"{40 * frame / rate:.0%}"),
    )
    return pd.DataFrame(rows, columns=["what", "value"])
