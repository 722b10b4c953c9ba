"""What a log of the rig holds, whatever made it: a simulated rig, a replay, or a board.

A log says its set-up: the gripper, which needs not be said, or the tactile pad of Chapter 2.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Literal, get_args

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import Provenance

SCHEMA = "softgrip-log 1"

SetUp = Literal["gripper", "pad", "layer"]

COLUMNS = {
    "time": "s",
    "command": "rad/s",
    "pressure_counts": "count",
    "angle_counts": "count",
    "pressure": "Pa",
    "angle": "rad",
}
"""Columns of each log of the gripper, in this order, with their units; more may follow them."""

PAD_CHANNELS = (*(f"element_{k}" for k in range(1, 9)), "layer")
"""Channels of the pad: the elements of the feature-detection layer, the force layer."""

PAD_COLUMNS = {
    "time": "s",
    "command": "N",
    **{f"{channel}_counts": "count" for channel in PAD_CHANNELS},
    **dict.fromkeys(PAD_CHANNELS, "V"),
}
"""Columns of each log of the pad; the command is the force with which something is pressed."""

LAYER_COLUMNS = {"time": "s", "command": "N", "layer_counts": "count", "layer": "V"}
"""Columns of each log of the pad's force layer alone; the command is the weight that lies on it."""

SET_UPS: Mapping[SetUp, Mapping[str, str]] = {
    "gripper": COLUMNS,
    "pad": PAD_COLUMNS,
    "layer": LAYER_COLUMNS,
}
"""Columns by set-up."""

EVENT = "event"
"""The last column: words on what happened, mostly empty."""

MORE_COLUMNS = {
    "reference": "rad",
    "flow": "m^3/s",
    "torque": "N m",
    "contact_x": "m",
    "contact_y": "m",
    "contact_angle": "rad",
}
"""Columns that a log may have beside those of its set-up, with their units."""

_FINGER = re.compile(r"_\d+$")


def known_unit(name: str, columns: Mapping[str, str]) -> str | None:
    """Return the SI unit of a column beside or among some, of any finger; None if not known."""
    known = {**MORE_COLUMNS, **columns}
    return known.get(name) or known.get(_FINGER.sub("", name))


@dataclass(frozen=True)
class LogHeader:
    """What is said of a log before its first row.

    Attributes:
        provenance: simulated or logged.
        source: What made it: a command, or the name of a rig.
        back_end: simulated rig, replay, emulated board or board.
        board, firmware: Names and versions; "none" without a board.
        calibration: Name of the calibration of the sensors or of the rig.
        seed: Of chance; empty without.
        period: Sampling period as stated, s; for rows that no clock gives, the time between the
            first two. That of the rows is `softgrip.logs.gaps.period_of`.
        notes: More keys and values, of one line each.
        set_up: What was logged: gripper or pad.
    """

    provenance: Provenance
    source: str
    back_end: str
    period: float
    board: str = "none"
    firmware: str = "none"
    calibration: str = "none"
    seed: str = ""
    notes: Mapping[str, str] = field(default_factory=dict)
    set_up: SetUp = "gripper"

    def __post_init__(self) -> None:
        if self.provenance not in (Provenance.SIMULATED, Provenance.LOGGED):
            raise InvalidInputError(
                "provenance", expected="simulated or logged", got=str(self.provenance)
            )
        if self.set_up not in get_args(SetUp):
            raise InvalidInputError("set_up", expected=f"{get_args(SetUp)}", got=self.set_up)
        if not 0 < self.period < float("inf"):
            raise InvalidInputError("period", expected="a finite number > 0", got=self.period)
        own = {entry.name for entry in fields(self)} | {"schema"}
        for key, value in self.lines().items():
            if value != value.strip() or any(c in key + value for c in "\r\n") or ":" in key:
                raise InvalidInputError(key, expected="one line, not padded", got=value)
        if own & set(self.notes):
            raise InvalidInputError(
                "notes", expected=f"keys other than {sorted(own)}", got=self.notes
            )

    @property
    def clocked(self) -> bool:
        """Whether rows come by a clock; those of the force layer come when a weight lies on it."""
        return self.set_up != "layer"

    @property
    def columns(self) -> Mapping[str, str]:
        """Columns that a log of this set-up has, with their units."""
        return SET_UPS[self.set_up]

    def unit_of(self, name: str) -> str | None:
        """Return the SI unit of a column, of any finger; None for one that is not known here.

        >>> header = LogHeader(Provenance.SIMULATED, "an example", "simulated rig", 0.025)
        >>> header.unit_of("angle_2"), header.unit_of("reference"), header.unit_of("mood")
        ('rad', 'rad', None)
        """
        return known_unit(name, self.columns)

    def lines(self) -> dict[str, str]:
        """Return the header's keys and values in the order in which they are written."""
        # The logs that came before the pad do not say a set-up: they are the gripper's.
        set_up = {} if self.set_up == "gripper" else {"set_up": str(self.set_up)}
        return {
            "provenance": str(self.provenance),
            "source": self.source,
            "schema": SCHEMA,
            **set_up,
            "back_end": self.back_end,
            "board": self.board,
            "firmware": self.firmware,
            "calibration": self.calibration,
            "seed": self.seed,
            "period": repr(self.period),
            **self.notes,
        }


@dataclass(frozen=True)
class Log:
    """A log that was read.

    Attributes:
        header: What it says of itself.
        columns: Values in SI by name, each of shape (samples,).
        events: (time in s, words), in order.
        repairs: What the reader changed, or where rows are missing, one sentence each; empty if
            nothing.
        path: Of its file, for errors.
    """

    header: LogHeader
    columns: Mapping[str, Floats]
    events: tuple[tuple[float, str], ...]
    repairs: tuple[str, ...]
    path: Path

    def __getitem__(self, name: str) -> Floats:
        if name not in self.columns:
            raise DataFileError(
                self.path, expected=f"a column {name!r}", got=", ".join(map(repr, self.columns))
            )
        return self.columns[name]
