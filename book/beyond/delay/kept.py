"""What the page asks of the kept sweep, and of the logs of the simulated gripper."""

from book.beyond.delay import sweep
from book.chapter_6.controllers import OPEN_LOGS
from softgrip.logs.delays import GripperDelays, read_delays
from softgrip.provenance import data_file
from softgrip.reads import remembered


@remembered
def _cells() -> dict[tuple[str, int, int, int, str, str], sweep.Cell]:
    return {
        (one.kind, one.fingers, one.delay, one.wrong, one.method, one.measure): one
        for one in sweep.KEPT.read()
    }


def cell(
    method: str,
    measure: str,
    delay: int,
    *,
    kind: sweep.Kind = "common",
    fingers: int = 2,
    wrong: int = 0,
) -> sweep.Cell:
    """Return what the sweep found of a method, by what `sweep.Cell` holds."""
    return _cells()[kind, fingers, delay, wrong, method, measure]


@remembered
def delays_of_logs() -> GripperDelays:
    """Return the delays that the book's logs of the simulated gripper tell."""
    return read_delays([data_file(name).path for name in OPEN_LOGS])
