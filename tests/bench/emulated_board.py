"""Keep what the bench says of the emulated board, for the book: ``data/rig/emulated_board.csv``."""

import csv
from pathlib import Path

from book.live.emulated import COLUMNS, FILE
from softgrip.board.firmware.header import build
from softgrip.provenance import data_folder
from tests.bench.board import entries

COMMAND = "python -m tests.bench.emulated_board"


def write(path: Path) -> Path:
    """Measure, write the file and return its path."""
    rows = [(one.name, f"{one.value:.4g}", one.unit, one.wanted, one.note) for one in entries()]
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as out:
        out.write(f"# provenance: simulated\n# source: {COMMAND}\n# firmware: {build():08x}\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(rows)
    return path


if __name__ == "__main__":
    print(write(data_folder() / FILE))
