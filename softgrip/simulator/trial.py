"""A log as evidence on the rig that made it: what was commanded, felt, and can be believed."""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.errors import DataFileError
from softgrip.logs.fingers import column, fingers_of
from softgrip.logs.gaps import even_clock, gaps_of
from softgrip.logs.pump import LONGEST, pump_of
from softgrip.logs.reader import read_log
from softgrip.logs.schema import Log
from softgrip.provenance import Provenance
from softgrip.pump.flow import Pump
from softgrip.simulator.parameters import SensorParameters

LEAST_ROWS = 40
START_ROWS = 4
"""At the start, whose mean pressure is that of the start."""
LARGEST_START = 4000.0
"""Pa, gauge: a homed rig that has lost, or sucked in, 4 % of its air. A finger that begins under
more was bent before the first row, for a time that the log does not tell."""
HELD_BACK = "held back"
"""In the event of a row whose command the rig did not obey: it stood still instead."""
MOST_CUT = 0.5
"""Share of the rows at an end of the converter's scale above which a channel tells nothing."""


@dataclass(frozen=True)
class Trial:
    """What a log says of a rig.

    Attributes:
        name, digest, provenance: Of the log's file.
        pump: That it names.
        period: Of its clock, s.
        commands: Motor speeds on an even clock, rad/s, shape (samples,).
        at: Where its rows stand on that clock, in samples, shape (rows,).
        measured: Pressure, Pa, and the angle of each finger, rad, shape (1 + fingers, rows).
        believed: Which of these count, same shape.
        rounding: Root mean square of the converter's rounding, shape (1 + fingers,).
        noise: The same of all noise from row to row, the rounding among it; infinite for a channel
            that tells nothing.
        plunger: Travel at the start, m.
        clamped: Whether the tube is shut at the finger, so that no air gets into it.
        torque: On each finger from outside, N m, positive bends further.
        left_out: What of the log is not used, and why, one sentence each.
    """

    name: str
    digest: str
    provenance: Provenance
    pump: Pump
    period: float
    commands: Floats
    at: Floats
    measured: Floats
    believed: NDArray[np.bool_]
    rounding: Floats
    noise: Floats
    plunger: float = 0.0
    clamped: bool = False
    torque: float = 0.0
    left_out: tuple[str, ...] = ()

    @property
    def fingers(self) -> int:
        """Number of fingers with a sensor."""
        return len(self.measured) - 1

    @property
    def deepest(self) -> float:
        """Deepest place of the plunger, m, if the motor does as told."""
        turned = np.cumsum(self.commands) * self.period
        return float(self.plunger + turned.max() * self.pump.lead / (2 * np.pi))


def read_trial(path: Path | str, *, clamped: bool = False, torque: float = 0.0) -> Trial:
    """Read a log as evidence.

    Rows of a gap are bridged where the command is the same on both sides; else the log is used up
    to there, for what the pump did in the gap is not known. A row at an end of the converter's
    scale tells nothing of that channel.

    Args:
        path: Of a log of the gripper that begins at rest, with the plunger drawn out or where the
            key ``plunger_at_start`` of its header says.
        clamped, torque: As of `Trial`.

    Raises:
        DataFileError: If it cannot be read, is no such log, does not name its pump, has too few
            rows, a motor that stands still, or no channel to believe.
    """
    log = read_log(path)
    if log.header.set_up != "gripper":
        raise DataFileError(path, expected="a log of the gripper", got=log.header.set_up)
    rows, cut = _known_rows(log)
    if rows < LEAST_ROWS:
        got = "; ".join([f"{rows}", *cut])
        raise DataFileError(path, expected=f"{LEAST_ROWS} rows or more", got=got)
    command = _obeyed(log)[:rows]
    if not command.any():
        raise DataFileError(path, expected="a command that is not 0", got="column 'command': 0")
    names = ["pressure", *(column("angle", k) for k in range(len(fingers_of(log))))]
    measured = np.array([log[name][:rows] for name in names])
    counted = np.array([log["pressure_counts"], *fingers_of(log, "angle_counts")])[:, :rows]
    believed = (counted > 0) & (counted < SensorParameters().largest_count)
    dead = dict(_dead(names, counted, believed))
    believed[[*dead]] = False
    if clamped:
        believed[1:] = False
    if not believed.any():
        raise DataFileError(
            path, expected="a channel that tells something", got="; ".join(dead.values())
        )
    _check_start(path, measured[0], believed[0])
    clock, time = even_clock(log), log["time"][:rows]
    number, period = clock.number[:rows], clock.period
    at = np.clip((time - time[0]) / period, 0, number[-1])
    whole = np.rint(at)
    at = np.where(np.abs(at - whole) < 1e-6, whole, at)
    rounding = np.array([_step(m, c) for m, c in zip(measured, counted, strict=True)]) / 12**0.5
    noise = np.maximum([noise_of(one, at) for one in measured], rounding)
    return Trial(
        name=Path(path).name,
        digest=hashlib.sha256(Path(path).read_bytes()).hexdigest()[:12],
        provenance=log.header.provenance,
        pump=pump_of(Path(path), log),
        period=period,
        commands=command[np.searchsorted(number, np.arange(number[-1] + 1))],
        at=at,
        measured=measured,
        believed=believed,
        rounding=rounding,
        noise=np.where(believed.any(axis=1), noise, np.inf),
        plunger=_plunger(path, log),
        clamped=clamped,
        torque=torque,
        left_out=(*cut, *dead.values()),
    )


def noise_of(values: Floats, at: Floats) -> float:
    """Return the root mean square of what differs from row to row as no motion does.

    From the second differences of neighbouring rows. Of these the mean size is taken, to which a
    few outliers do little.

    Args:
        values: Shape (rows,).
        at: Number of each row on an even clock, shape (rows,).

    >>> noise_of(np.array([0.0, 1.0, 2.0, 3.0, 4.0]), np.arange(5.0))
    0.0
    """
    near = np.abs(np.diff(at, 2)) + np.abs(at[2:] - at[:-2] - 2) < 1
    bends = np.abs(np.diff(values, 2))[near]
    # A second difference has six times the variance of a row.
    return float(bends.mean() * (np.pi / 2 / 6) ** 0.5) if bends.size else 0.0


def _known_rows(log: Log) -> tuple[int, tuple[str, ...]]:
    """Return up to which row it is known what the pump did, and what ends there."""
    command = log["command"]
    for gap in gaps_of(log):
        if command[gap.row] != command[gap.row + 1] or gap.end - gap.start > LONGEST:
            return gap.row + 1, (f"what follows was left out: {gap}, and what the pump did then",)
    return len(command), ()


def _obeyed(log: Log) -> Floats:
    """Return the commands that the rig did obey, rad/s, shape (rows,)."""
    command = log["command"].copy()
    refused = [time for time, words in log.events if HELD_BACK in words]
    command[np.isin(log["time"], refused) & (command > 0)] = 0.0
    return command


def _dead(
    names: list[str], counted: Floats, believed: NDArray[np.bool_]
) -> Iterator[tuple[int, str]]:
    """Yield the channels that tell nothing, and why."""
    for k, (name, counts, good) in enumerate(zip(names, counted, believed, strict=True)):
        if np.mean(~good) > MOST_CUT:
            yield k, f"column {name!r} was left out: it is at an end of the converter's scale"
        elif np.ptp(counts) == 0:
            yield k, f"column {name!r} was left out: it never changes"


def _check_start(path: Path | str, pressure: Floats, believed: NDArray[np.bool_]) -> None:
    start = float(pressure[:START_ROWS].mean())
    if believed.any() and abs(start) > LARGEST_START:
        raise DataFileError(
            path,
            expected=f"a start within {LARGEST_START:g} Pa of the atmosphere (home the plunger, "
            "with the tube open)",
            got=f"column 'pressure': {start:.0f} Pa in the first rows",
        )


def _step(values: Floats, counts: Floats) -> float:
    """Return what a step of the converter is, in the unit of the values."""
    least, most = int(np.argmin(counts)), int(np.argmax(counts))
    steps = float(counts[most] - counts[least])
    return float(values[most] - values[least]) / steps if steps else 0.0


def _plunger(path: Path | str, log: Log) -> float:
    words = log.header.notes.get("plunger_at_start", "0 m").split()
    try:
        place = float(words[0])
        if words[1:] != ["m"] or not 0 <= place < 1:
            raise ValueError(words)
    except (ValueError, IndexError):
        raise DataFileError(
            path, expected="'plunger_at_start: <number> m' in the header", got=" ".join(words)
        ) from None
    return place
