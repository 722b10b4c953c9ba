"""What of the firmware is made from tables in Python: three headers, and tables of its README.

``protocol.h`` is made from `softgrip.board.protocol`, ``config.h`` and ``pins.h`` from
`softgrip.board.firmware.config`.
"""

import re
from collections.abc import Iterable, Sequence
from enum import IntEnum, IntFlag
from pathlib import Path
from zlib import crc32

from softgrip.board import protocol
from softgrip.board.firmware.config import (
    AT_START,
    CONSTANTS,
    HARD,
    LEAST,
    PINS,
    SET_UP,
    TABLES,
    VALVE,
    limits_in_words,
)
from softgrip.board.framing import LARGEST
from softgrip.board.protocol import LIMITS, Message

SKETCH = Path(__file__).parent / "softgrip_rig"
HEADER = SKETCH / "protocol.h"
README = SKETCH.parent / "README.md"
COMMAND = "python -m softgrip.board.firmware.header"

TYPES = {"B": "uint8_t", "H": "uint16_t", "I": "uint32_t", "h": "int16_t", "i": "int32_t"}


def build() -> int:
    """Return the checksum of the firmware's sources, the table among them."""
    sources = sorted(path for path in SKETCH.iterdir() if path.suffix in (".ino", ".cpp", ".h"))
    text = b"".join(path.read_bytes() for path in sources if path != HEADER)
    return crc32(text, protocol.TABLE)


def _constants(kind: type[IntEnum] | type[IntFlag]) -> str:
    lines = (f"  {kind.__name__}_{one.name} = {int(one)}," for one in kind)
    return f"enum {kind.__name__} : uint16_t {{\n" + "\n".join(lines) + "\n};"


def _struct(message: Message) -> str:
    lines = []
    for one in message.fields:
        size = f"[{one.count}]" if one.count > 1 else ""
        unit = f"{one.unit}; " if one.unit else ""
        lines.append(f"  {TYPES[one.code]} {one.name}{size};  // {unit}{one.words}")
    name = "".join(part.capitalize() for part in message.name.split("_"))
    head = f"// {message.words}\nconst uint8_t ID_{message.name.upper()} = {message.id};"
    if not lines:
        return head
    size = f'static_assert(sizeof({name}) == {message.layout.size}, "as in Python");'
    body = "\n".join(lines)
    return f"{head}\nstruct __attribute__((packed)) {name} {{\n{body}\n}};\n{size}"


def _head(source: str) -> list[str]:
    return [f"// Made from {source} by: {COMMAND}", "// Do not edit.", "#pragma once"]


def protocol_header() -> str:
    """Return the text of ``protocol.h``."""
    parts = [
        *_head("softgrip/board/protocol.py"),
        "#include <stdint.h>",
        "",
        f"const uint8_t PROTOCOL_VERSION = {protocol.PROTOCOL_VERSION};",
        f"const uint32_t PROTOCOL_TABLE = {protocol.TABLE:#010x};",
        f"const uint32_t BUILD = {build():#010x};",
        f"const uint32_t BAUD = {protocol.BAUD};",
        f"const uint16_t TICKS_PER_SECOND = {round(1 / protocol.TICK)};",
        f"const uint8_t TICKS_PER_FRAME = {round(protocol.TELEMETRY_PERIOD / protocol.TICK)};",
        f"const int16_t SPEED_SCALE = {protocol.SPEED_SCALE};",
        f"const uint8_t CHANNELS = {len(protocol.CHANNELS)};",
        f"const uint8_t CHANNEL_PRESSURE = {protocol.CHANNELS.index('pressure')};",
        f"const uint8_t LARGEST_FRAME = {LARGEST};  // before it is stuffed",
        "",
        *(_constants(kind) for kind in (protocol.SetUp, protocol.Flag, protocol.Reason)),
        "",
        *(_struct(message) for message in protocol.MESSAGES),
    ]
    return "\n".join(parts) + "\n"


def config_header() -> str:
    """Return the text of ``config.h``, whose set-up and valve a compiler's option may change."""
    parts = [
        *_head("softgrip/board/firmware/config.py"),
        '#include "protocol.h"',
        "",
        "#ifndef SET_UP",
        f"#define SET_UP SetUp_{SET_UP.name}",
        "#endif",
        "#ifndef VALVE",
        f"#define VALVE {VALVE:d}",
        "#endif",
        "",
        "const bool HAS_PUMP = SET_UP == SetUp_GRIPPER;",
        "const bool HAS_VALVE = VALVE;",
        "",
        *(
            f"const SetLimits {name} = {{{', '.join(str(limits[one.name]) for one in LIMITS)}}};"
            f"  // {', '.join(limits_in_words(limits))}"
            for name, limits in (("HARD", HARD), ("LEAST", LEAST), ("AT_START", AT_START))
        ),
        "",
        *(
            f"const {one.type} {name} = {one.value};  // {one.words}"
            for name, one in CONSTANTS.items()
        ),
    ]
    return "\n".join(parts) + "\n"


def pins_header() -> str:
    """Return the text of ``pins.h``."""
    parts = [
        *_head("softgrip/board/firmware/config.py"),
        "#include <avr/io.h>",
        "",
        *(f"const uint8_t {name} = _BV({pin.bit});  // {pin.number}" for name, pin in PINS.items()),
    ]
    return "\n".join(parts) + "\n"


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table as Markdown."""
    lines = (head, ["---"] * len(head), *rows)
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def readme() -> str:
    """Return the text of the README, each of its tables made anew."""
    text = README.read_text(encoding="utf-8")
    for title, table in TABLES.items():
        found = re.compile(rf"(?<=^## {title}\n\n)(\|.*\n)+", re.MULTILINE)
        text = found.sub(markdown(*table) + "\n", text)
    return text


# In this order: the checksum in protocol.h is that of the others.
MADE = {
    SKETCH / "config.h": config_header,
    SKETCH / "pins.h": pins_header,
    HEADER: protocol_header,
    README: readme,
}


def main() -> None:
    """Write the files."""
    for path, make in MADE.items():
        path.write_text(make(), encoding="utf-8")
        print(f"wrote {path}")


if __name__ == "__main__":
    main()
