"""What the firmware did on the emulated board, from a kept file."""

import csv

import pandas as pd

from softgrip.provenance import data_file
from softgrip.rig.firmware.header import build

FILE = "rig/emulated_board.csv"
COLUMNS = ("what", "value", "unit", "wanted", "how")


def emulated_table() -> pd.DataFrame:
    """Tabulate what was measured on the emulated board; no real board was tried."""
    with data_file(FILE).path.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    table = pd.DataFrame(rows[1:], columns=rows[0])
    return table.assign(what=table["what"].str.removeprefix("board, "))


def measured_firmware() -> str:
    """Return which firmware that was, in words."""
    text = data_file(FILE).path.read_text(encoding="utf-8")
    kept = next(line.partition(":")[2].strip() for line in text.splitlines() if "firmware:" in line)
    now = f"{build():08x}"
    return f"build {kept}" + (
        ", the present one" if kept == now else f"; the sources are by now build {now}"
    )
