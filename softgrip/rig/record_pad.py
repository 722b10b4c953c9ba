"""A log of the pad on a board: its nine channels, as they come at 40 Hz."""

from dataclasses import replace
from pathlib import Path

from softgrip.arrays import check_positive
from softgrip.board.driver import Rig
from softgrip.board.protocol import CHANNELS, TELEMETRY_PERIOD
from softgrip.board.telemetry import Telemetry
from softgrip.logs.queued_writer import RunLog, plain
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.record import Progress, Recording, show_progress
from softgrip.simulator.pad_parameters import PadParameters


def record_pad(
    rig: Rig,
    duration: float,
    path: Path | str,
    *,
    shows: str = "",
    progress: Progress = show_progress,
) -> Recording:
    """Write down what the pad says for some seconds; nothing moves.

    Parameters
    ----------
    rig
        A board of either set-up: both sample the pad's channels.
    duration
        s, > 0.
    path
        Of the log, which must not exist.
    shows
        What touches the pad, one line. The force is not known, and stands as 0 in the log.
    progress
        Told of each sample.

    Raises
    ------
    BoardError
        If the line is lost. The log is closed and its last row says it.
    InvalidInputError
        If the path exists, or the duration is out of range.
    """
    check_positive(duration=duration)
    notes = {"shows": plain(shows)} if shows else {}
    header = replace(rig.header(), set_up="pad", period=TELEMETRY_PERIOD, notes=notes)
    told, start, samples = rig.listen(), rig.line.time, 0
    with RunLog(Path(path), header) as log:
        try:
            while True:
                time = rig.line.time - start
                log.write(event=plain(rig.take_event()), **_row(told, time))
                samples += 1
                progress(min(time, duration), duration)
                if time > duration - TELEMETRY_PERIOD / 2:
                    break
                told = rig.listen()
        except BaseException as error:
            log.note(f"ended by {type(error).__name__}: {error}")
            raise
    return Recording(Path(path), samples, (), log.failure)


def _row(told: Telemetry, time: float) -> dict[str, float]:
    board = PadParameters()
    counts = {name: told.channels[CHANNELS.index(name)] for name in PAD_CHANNELS}
    return {
        "time": round(time, 9),
        "command": 0.0,
        **{f"{name}_counts": count for name, count in counts.items()},
        **{name: count * board.supply / board.levels for name, count in counts.items()},
    }
