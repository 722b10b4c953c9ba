"""A run on whatever is connected: driven, logged, and brought to rest whatever happens."""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats
from softgrip.board.errors import BoardError, ConnectionLostError
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.rig_controller import CommandSequence, RigController
from softgrip.errors import InvalidInputError
from softgrip.files import path_of
from softgrip.logs.fingers import column
from softgrip.logs.queued_writer import RunLog, plain
from softgrip.rig.interface import Rig
from softgrip.simulator.motor import one_speed
from softgrip.simulator.sensors import Measurement

RECONNECT_WITHIN = 10.0
"""s: long enough to put a cable back."""
LONG_RUN = 5.0
"""s: a shorter run shows no progress."""

Row = dict[str, float]
"""Of a log: values by column."""
Progress = Callable[[Row, float], None]
"""Called with a row that was logged, and the duration of the run, s."""


@dataclass(frozen=True)
class Recording:
    """How a run went.

    Attributes:
        path: Of its log.
        samples: Number of rows given to the log, the one at the start included.
        reconnections: When the line was lost and found again: times of the run, s.
        log_failure: Why rows are missing in the log; empty if none is.
    """

    path: Path
    samples: int
    reconnections: tuple[float, ...]
    log_failure: str


def show_progress(row: Row, duration: float) -> None:
    """Write a bar on the standard error stream, over the one before."""
    if duration >= LONG_RUN and (sys.stderr.isatty() or "ipykernel" in sys.modules):
        done = min(row["time"], duration)
        bar = "#" * int(30 * done / duration)
        end = "\n" if done >= duration else ""
        print(f"\r[{bar:30}] {done:.0f} of {duration:.0f} s", end=end, file=sys.stderr, flush=True)


def record(
    connection: Rig,
    controller: RigController | ArrayLike,
    duration: float,
    path: Path | str,
    *,
    reference: ArrayLike | None = None,
    limit: float = SPEED_LIMIT,
    shows: str = "",
    reconnect_within: float = RECONNECT_WITHIN,
    progress: Progress = show_progress,
) -> Recording:
    """Drive a rig, write the log, and leave the motor at rest.

    Args:
        connection: The rig, homed. It stays open.
        controller: From the angles, rad, shape (fingers, 1), to the motor speed, rad/s: a
            controller of Chapter 6, one of Chapters 3 and 4 in `rig_controller.Tracking`; or the
            speeds of each period, shape (N,).
        duration: s.
        path: Of the log, which must not exist.
        reference: For the log, rad, a number or shape (fingers,), or (N, fingers), one row a
            sample, the last of which is held; None in open loop.
        limit: The command is cut to it, rad/s.
        shows: What the log shows, one line.
        reconnect_within: How long a lost line is waited for, s. The board by itself stops the motor
            meanwhile.
        progress: Told of each period.

    Returns:
        Recording: Of a run that lasted to its end.

    Raises:
        BoardError: If a line stays lost, a command is refused, or a replayed log is over. The log
            is closed and its last row says it; the same holds for whatever a controller raises, and
            for Ctrl-C.
        InvalidInputError: If the path exists, or an argument is out of range.
    """
    check_positive(duration=duration, limit=limit, reconnect_within=reconnect_within)
    control = controller if hasattr(controller, "update") else CommandSequence(controller)
    header = connection.header()
    header = replace(header, notes={**header.notes, **({"shows": shows} if shows else {})})
    followed = reference_rows(reference, connection.fingers)
    units = more_columns(connection.fingers, reference=reference is not None)
    lost: list[float] = []
    samples = 1
    seen = connection.measure()
    start = float(seen.time)
    with RunLog(path_of(path), header, more=units) as log:
        try:
            log.write(event=plain(connection.take_event()), **log_row(0.0, 0.0, seen, followed[0]))
            while float(seen.time) - start < duration - connection.period / 2:
                command = float(np.clip(one_speed(control.update(seen.angle)), -limit, limit))
                try:
                    seen = connection.advance(command)
                except ConnectionLostError as error:
                    lost.append(float(seen.time) - start)
                    log.note(str(error))
                    connection.reconnect(reconnect_within)
                    # Until then the board held nothing: its own watchdog had stopped the motor.
                    command, seen = 0.0, connection.measure()
                    log.note("line found again")
                time = float(seen.time) - start
                wanted = followed[min(samples, len(followed) - 1)]
                row = log_row(time, command, seen, wanted)
                log.write(event=plain(connection.take_event()), **row)
                samples += 1
                progress(row, duration)
        finally:
            try:
                connection.stop()
            except (
                BoardError
            ) as error:  # a board that does not hear has stopped the motor by itself
                log.note(f"the stop was not heard: {error}")
    return Recording(path_of(path), samples, tuple(lost), log.failure)


def reference_rows(reference: ArrayLike | None, fingers: int) -> Floats:
    """Return the reference of a log as of `record`, shape (N, fingers); (1, 0) if there is none."""
    if reference is None:
        return np.empty((1, 0))
    rows = np.atleast_2d(floats(reference=reference)[0])
    if rows.ndim != 2 or rows.shape[1] not in (1, fingers) or rows.size == 0:
        raise InvalidInputError(
            "reference", expected=f"a number or shape (N, {fingers})", got=rows.shape
        )
    return np.broadcast_to(rows, (len(rows), fingers))


def more_columns(fingers: int, *, reference: bool) -> dict[str, str]:
    """Return the columns of a log beside those that all have, with their units."""
    units: dict[str, str] = {}
    for finger in range(1, fingers):
        units |= {column("angle_counts", finger): "count", column("angle", finger): "rad"}
    if reference:
        units |= {column("reference", finger): "rad" for finger in range(fingers)}
    return units


def log_row(time: float, command: float, seen: Measurement, reference: Floats) -> Row:
    """Return the row of a log.

    Args:
        time: Since the start, s.
        command: Held until then, rad/s.
        seen: Of one run, at that time.
        reference: rad, shape (fingers,), or empty if there is none.
    """
    row = {
        "time": round(time, 9),
        "command": command,
        "pressure_counts": int(seen.pressure_counts[0]),
        "pressure": float(seen.pressure[0]),
    }
    for finger, (angle, counts) in enumerate(zip(seen.angle, seen.angle_counts, strict=True)):
        row |= {column("angle", finger): float(angle[0])}
        row |= {column("angle_counts", finger): int(counts[0])}
    return row | {column("reference", k): float(angle) for k, angle in enumerate(reference)}
