"""The generated header of the firmware: the table of `softgrip.board.protocol` in C++."""

from enum import IntEnum, IntFlag
from pathlib import Path
from zlib import crc32

from softgrip.board import protocol
from softgrip.board.framing import LARGEST
from softgrip.board.protocol import Message

SKETCH = Path(__file__).parent / "softgrip_rig"
HEADER = SKETCH / "protocol.h"

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


def header() -> str:
    """Return the header's text."""
    parts = [
        "// Made from softgrip/board/protocol.py by: python -m softgrip.board.firmware.header",
        "// Do not edit.",
        "#pragma once",
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


def main() -> None:
    """Write the header."""
    HEADER.write_text(header())
    print(f"wrote {HEADER}")


if __name__ == "__main__":
    main()
