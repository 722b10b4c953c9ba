"""Keep what the bench says of the emulated board, for the book: ``data/rig/emulated_board.csv``."""

from dataclasses import dataclass

from book.live.emulated import FILE
from softgrip.board.firmware.header import build
from softgrip.kept import Kept
from tests.bench.board import entries


@dataclass(frozen=True)
class Measured:
    """What was measured on the emulated board, what is wanted of it, and how it was measured."""

    what: str
    value: float
    unit: str
    wanted: str
    how: str


KEPT = Kept(
    FILE,
    Measured,
    lambda: (Measured(one.name, one.value, one.unit, one.wanted, one.note) for one in entries()),
    "python -m tests.bench.emulated_board",
    notes=lambda: f"firmware: {build():08x}",
    number=".4g",
)

if __name__ == "__main__":
    KEPT.main()
