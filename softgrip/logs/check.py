"""What a log holds, what it lacks, and which analyses and figures it can serve, in words."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill

from softgrip.errors import SoftgripError
from softgrip.logs.gaps import gaps_of, late_start, period_of
from softgrip.logs.pushes import compare
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_CHANNELS, Log, SetUp
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import judge_step_log

WIDTH = 78
"""Characters of a line of what is said; that of a page holds as many."""
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
        "acceptance against the printed numbers", "softgrip accept",
        ("pressure", "angle", "reference"), attempt=judge_step_log,
    ),
    Use(
        "a simulated rig fitted to yours", "softgrip fit rig",
        ("command", "pressure_counts", "pressure", "angle_counts", "angle"), PUMP, start=False,
    ),
    Use(
        "contacts of a pad", "softgrip.logs.contacts.read_contacts",
        (*PAD_CHANNELS, *(f"{name}_counts" for name in PAD_CHANNELS)), start=False,
        set_up="pad",
    ),
)  # fmt: skip
"""What is made of logs here."""


@dataclass(frozen=True)
class Service:
    """Whether a log serves one of `USES`.

    Attributes:
        what, call, figures: As of `Use`.
        why_not: What it lacks, or why its rows do not serve; empty where they do.
    """

    what: str
    call: str
    figures: tuple[str, ...]
    why_not: str

    def __str__(self) -> str:
        shown = f" ({', '.join(self.figures)})" if self.figures else ""
        if not self.why_not:
            return f"serves  {self.what}{shown}:\n        {self.call}"
        return f"cannot serve  {self.what}{shown}:\n" + fill(
            self.why_not, WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 8
        )


@dataclass(frozen=True)
class Span:
    """What lies in a column: its least and largest value, in its unit."""

    name: str
    low: float
    high: float
    unit: str

    def __str__(self) -> str:
        still = ", never changes" if self.low == self.high else ""
        return f"column  {self.name}: {self.low:.6g} to {self.high:.6g} {self.unit}{still}"


@dataclass(frozen=True)
class Contents:
    """What a log holds and what it can serve; as text, in lines.

    Attributes:
        path: Of the log.
        provenance, back_end: What made it.
        rows: Their number.
        begin, end, period: Time of the first and of the last row, and between rows, s; the period
            is None for a single row.
        notes: What was done to read it, one sentence each.
        columns: All but the time.
        services: What it was asked to serve.
    """

    path: str
    provenance: str
    back_end: str
    rows: int
    begin: float
    end: float
    period: float | None
    notes: tuple[str, ...]
    columns: tuple[Span, ...]
    services: tuple[Service, ...]

    def __str__(self) -> str:
        rate = "" if self.period is None else f", {self.period:.6g} s apart"
        return "\n".join(
            [
                f"{self.path}: {self.provenance}, {self.back_end}, {self.rows} rows "
                f"from {self.begin:.6g} to {self.end:.6g} s{rate}",
                *(f"note  {words}" for words in self.notes),
                *map(str, self.columns),
                *map(str, self.services),
            ]
        )


def contents(path: Path | str) -> Contents:
    """Look what a log holds and what it can serve.

    Raises:
        DataFileError: If it cannot be read, as of `read_log`.
    """
    log = read_log(path)
    time = log["time"]
    return Contents(
        str(path),
        str(log.header.provenance),
        log.header.back_end,
        time.size,
        float(time[0]),
        float(time[-1]),
        period_of(log) if time.size > 1 else None,
        tuple(log.repairs),
        tuple(_span(log, name) for name in log.columns if name != "time"),
        tuple(
            Service(use.what, use.call, use.figures, _why_not(use, log))
            for use in USES
            if use.set_up == log.header.set_up
        ),
    )


def _why_not(use: Use, log: Log) -> str:
    if lacks := use.lacks(log):
        return f"it lacks {', '.join(lacks)}"
    try:
        if use.attempt:
            use.attempt(log.path)
    except SoftgripError as error:
        return str(error).removeprefix(f"{log.path}: ")
    return ""


def _span(log: Log, name: str) -> Span:
    values, unit = log[name], log.header.unit_of(name) or "SI"
    return Span(name, float(values.min()), float(values.max()), unit)
