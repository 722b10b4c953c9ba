"""A log of the pad, on a board or simulated: its nine channels, as they come at 40 Hz."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from softgrip.arrays import check_positive
from softgrip.board.driver import Board
from softgrip.board.protocol import TELEMETRY_PERIOD
from softgrip.board.session import Telemetry
from softgrip.errors import InvalidInputError
from softgrip.files import path_of
from softgrip.logs.contacts import PRESS, REST, WEIGHT
from softgrip.logs.queued_writer import RunLog, plain
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.record import Progress, Recording, Row, show_progress
from softgrip.rig.simulated_pad import SimulatedPad
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.tactile.contacts import ELEMENTS

BOARD = PadParameters()
"""Whose converter the board has."""
PadSource = Board | SimulatedPad
"""What a pad is heard through; a board of either set-up samples its channels."""
Step = tuple[str, float]
"""What is done with the pad, as an event of `softgrip.logs.contacts`, and for how long, s."""


def calibration_steps(seconds: float = 2.5) -> list[Step]:
    """Return the steps that a log begins with: the pad at rest, then each element alone."""
    return [(words, seconds) for words in (REST, *(f"{PRESS}{k + 1}" for k in range(ELEMENTS)))]


def weight_steps(weights: Sequence[float], seconds: float = 2.5) -> list[Step]:
    """Return steps with known weights, gram-force.

    >>> weight_steps([5, 20])
    [('weight: 5 gf', 2.5), ('weight: 20 gf', 2.5)]
    """
    return [(f"{WEIGHT}{weight:g} gf", seconds) for weight in weights]


def record_pad(
    rig: PadSource,
    steps: float | Sequence[Step],
    path: Path | str,
    *,
    shows: str = "",
    say: Callable[[str], None] = print,
    progress: Progress = show_progress,
) -> Recording:
    """Write down what the pad says while it is touched; nothing moves.

    Args:
        rig: Where it is heard.
        steps: What is done, one after the other: the words of each stand as an event where it
            begins. Or s, > 0, of which nothing is said yet: `read_contacts` takes the words as
            labels.
        path: Of the log, which must not exist.
        shows: What the log shows, one line. Forces of contacts are not known, and stand as 0 in it.
        say: Told the words when a step begins, so that who is at the pad knows what to do.
        progress: Told of each sample.

    Raises:
        BoardError: If the line is lost. The log is closed and its last row says it.
        InvalidInputError: If no pad can be heard there, the path exists, or a duration is out of
            range.
    """
    if not isinstance(rig, PadSource):
        raise InvalidInputError("rig", expected="a Board or a SimulatedPad", got=rig)
    given: Sequence[Step] = steps if isinstance(steps, Sequence) else [("", steps)]
    for _, seconds in given:
        check_positive(duration=seconds)
    duration = sum(seconds for _, seconds in given)
    notes = {"shows": plain(shows)} if shows else {}
    header = replace(rig.header(), set_up="pad", period=TELEMETRY_PERIOD, notes=notes)
    start, samples, end = None, 0, 0.0
    with RunLog(path_of(path), header) as log:
        for words, seconds in given:
            if words:
                say(words)
            time, end, event = -1.0, end + seconds, words
            while time <= end - TELEMETRY_PERIOD / 2:
                told = rig.listen()
                start = told.time if start is None else start
                time = told.time - start
                event = "; ".join(filter(None, (plain(event), plain(rig.take_event()))))
                row = _row(told, time)
                log.write(event=event, **row)
                event, samples = "", samples + 1
                progress(row, duration)
    return Recording(path_of(path), samples, (), log.failure)


def _row(told: Telemetry, time: float) -> Row:
    counts = dict(zip(PAD_CHANNELS, told.channels, strict=False))
    return {
        "time": round(time, 9),
        "command": 0.0,
        **{f"{name}_counts": count for name, count in counts.items()},
        **{name: count * BOARD.supply / BOARD.levels for name, count in counts.items()},
    }
