"""What the firmware did on the emulated board, from a kept file."""

import pandas as pd

from book.live.protocol import BITS, TELEMETRY_BYTES
from softgrip.board.firmware.header import build
from softgrip.board.protocol import BAUD
from softgrip.provenance import data_file, data_rows

FILE = "rig/emulated_board.csv"
EMULATED_BITS = BITS + 1
"""Bit times of a byte on the emulated line: simavr 1.6 counts a parity bit that 8N1 has not."""


def emulated_table() -> pd.DataFrame:
    """Tabulate what was measured on the emulated board; no real board was tried."""
    table = pd.DataFrame(data_rows(FILE))
    return table.assign(what=table["what"].str.removeprefix("board, "))


def measured_firmware() -> str:
    """Return which firmware that was, in words."""
    text = data_file(FILE).path.read_text(encoding="utf-8")
    kept = next(line.partition(":")[2].strip() for line in text.splitlines() if "firmware:" in line)
    now = f"{build():08x}"
    return f"build {kept}" + (
        ", the present one" if kept == now else f"; the sources are by now build {now}"
    )


def emulated_line() -> str:
    """Return by how much the emulated line is slower than a board's, in words."""
    emulated, real = (1e3 * TELEMETRY_BYTES * bits / BAUD for bits in (EMULATED_BITS, BITS))
    return (
        f"The emulated line is {EMULATED_BITS / BITS - 1:.0%} slower than a board's: simavr counts"
        f" a parity bit in each byte, which 8N1 has not. A telemetry frame takes {emulated:.2f} ms"
        f" on it, and {real:.2f} ms on a board. So the times above, as far as bytes are waited for,"
        " err to the long side. The rate of telemetry is the board's timer's, and depends on none"
        " of it; nor does a band of the acceptance or of the check."
    )
