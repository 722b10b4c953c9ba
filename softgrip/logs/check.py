"""What a log holds, what it lacks, and which analyses and figures it can serve, in words."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softgrip.errors import SoftgripError
from softgrip.logs.gaps import gaps_of, late_start, period_of
from softgrip.logs.pushes import compare
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_CHANNELS, Log, SetUp
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import judge_step_log

PUMP = ("area", "lead")
"""Keys of a header that name the pump."""


@dataclass(frozen=True)
class Use:
    """What can be made of a log.

    Attributes:
        what: In words.
        call: Function that does it.
        columns: That it needs beside the time.
        keys: Of the header that it needs.
        figures: Of the book that show it.
        start: Whether the first row must be that of the run.
        whole: Whether no row may be missing.
        set_up: Of the log.
        attempt: What is tried with a log that lacks nothing: its rows may not serve all the same.
    """

    what: str
    call: str
    columns: tuple[str, ...]
    keys: tuple[str, ...] = ()
    figures: tuple[str, ...] = ()
    start: bool = True
    whole: bool = False
    set_up: SetUp = "gripper"
    attempt: Callable[[Path | str], object] | None = None

    def lacks(self, log: Log) -> list[str]:
        """Return what a log lacks for it, in words."""
        columns = [name for name in self.columns if name not in log.columns]
        keys = [key for key in self.keys if key not in log.header.notes]
        return [
            *([f"the columns {', '.join(columns)}"] if columns else []),
            *([f"{' and '.join(keys)} of the pump in the header"] if keys else []),
            *(["the rows of its start"] if self.start and late_start(log) else []),
            *(["the rows that are missing"] if self.whole and gaps_of(log) else []),
        ]


USES = (
    Use(
        "the response to a step", "softgrip.logs.steps.judge_step_log",
        ("angle", "reference"), (), ("Figure 4.5", "Table 3.C", "Table 4.C"),
        attempt=judge_step_log,
    ),
    Use(
        "both regulators", "book.companion.show.show", ("command", "angle", "reference"), (),
        ("Figure 3.12",),
    ),
    Use(
        "the response to a staircase", "softgrip.logs.staircase.judge_staircase",
        ("angle", "reference"), (), ("Figure 4.7",), start=False,
        attempt=judge_staircase,
    ),
    Use(
        "the capacity of pump and finger", "softgrip.logs.pushes.compare",
        ("command", "pressure", "angle"), PUMP, ("Figure 4.4",),
        attempt=compare,
    ),
    Use(
        "the finger's dynamics", "softgrip.logs.repeated_steps.read_step_test",
        ("pressure", "angle"), (), ("Figure 5.6", "Figure 5.7"), whole=True,
    ),
    Use(
        "the dynamics of two fingers", "softgrip.logs.fingers.read_runs",
        ("command", "angle", "angle_2"), (), ("Figure 6.4", "Figure 6.5", "Figure 6.7"), whole=True,
    ),
    Use(
        "acceptance against the printed numbers", "python -m softgrip.rig accept",
        ("pressure", "angle", "reference"), attempt=judge_step_log,
    ),
    Use(
        "a simulated rig fitted to yours", "python -m softgrip.rig fit",
        ("command", "pressure_counts", "pressure", "angle_counts", "angle"), PUMP, start=False,
    ),
    Use(
        "contacts of a pad", "softgrip.logs.contacts.read_contacts",
        (*PAD_CHANNELS, *(f"{name}_counts" for name in PAD_CHANNELS)), start=False,
        set_up="pad",
    ),
)  # fmt: skip
"""What is made of logs here."""


def describe(path: Path | str) -> str:
    """Say what a log holds and what it can serve, in lines.

    Raises:
        DataFileError: If it cannot be read, as of `read_log`.
    """
    log = read_log(path)
    time = log["time"]
    rate = f", {period_of(log):.6g} s apart" if time.size > 1 else ""
    lines = [
        f"{path}: {log.header.provenance}, {log.header.back_end}, {time.size} rows "
        f"from {time[0]:.6g} to {time[-1]:.6g} s{rate}",
        *(f"note  {words}" for words in log.repairs),
        *(_span(log, name) for name in log.columns if name != "time"),
    ]
    for use in (use for use in USES if use.set_up == log.header.set_up):
        shown = f" ({', '.join(use.figures)})" if use.figures else ""
        lacks = use.lacks(log)
        if lacks:
            lines.append(f"lacks  {', '.join(lacks)}, for {use.what}{shown}")
        elif refused := _refusal(use, path):
            lines.append(f"cannot serve  {use.what}{shown}: {refused}")
        else:
            lines.append(f"serves  {use.what}: {use.call}{shown}")
    return "\n".join(lines)


def _refusal(use: Use, path: Path | str) -> str:
    try:
        if use.attempt:
            use.attempt(path)
    except SoftgripError as error:
        return str(error).removeprefix(f"{path}: ")
    return ""


def _span(log: Log, name: str) -> str:
    values = log[name]
    still = ", never changes" if not np.ptp(values) else ""
    unit = log.header.unit_of(name) or "SI"
    return f"column  {name}: {values.min():.6g} to {values.max():.6g} {unit}{still}"
