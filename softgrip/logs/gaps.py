"""Where rows of a log are missing: its time column against the period of its header.

Telemetry gets lost, and a log then goes on after a gap. Whatever sums, differs or filters a log
must go by its times; what needs even samples bridges a short gap and refuses a long one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats
from softgrip.errors import DataFileError
from softgrip.logs.schema import Log, LogHeader

LATE = 1.5
"""Periods from a row to the next, above which rows are missing between them. A clock may be uneven
by half a period: what is late by less is late, not lost."""
PERIOD_WITHIN = 0.02
"""Of the header's period: how far the mean interval without gaps may be from it. A resonator is
good to 0.5 %."""
TICK = 1e-3
"""s: a board's clock counts whole milliseconds."""
LEAST_WHOLE = 0.1
"""Share of the intervals that must be no gaps. A host that is too busy may leave out more than half
of the rows; but where there is a gap after every row, it is the header that is wrong."""
ROUNDING = 1e-6
"""Of a period: the times are decimals, whose difference is not exactly the period."""
MOST_NAMED = 6
"""Gaps that are named one by one."""


@dataclass(frozen=True)
class Gap:
    """Rows that are missing.

    Attributes:
        row: Number of the row before them, counted from 0.
        start, end: Times of the rows before and after them, s.
        missing: How many they are.
    """

    row: int
    start: float
    end: float
    missing: int

    def __str__(self) -> str:
        rows = f"{self.missing} row{'s' if self.missing > 1 else ''}"
        return f"{rows} missing between {self.start:.6g} and {self.end:.6g} s (row {self.row + 1})"


def intervals(time: ArrayLike, period: float) -> Floats:
    """Return the time from each row to the next in periods, shape (N - 1,).

    A whole number where only the rounding of decimals parts it from one: sums over an even log are
    then exact.

    Args:
        time: s, shape (N,), increasing.
        period: s, > 0.

    >>> intervals([0.025, 0.05, 0.125, 0.151], 0.025).round(6).tolist()
    [1.0, 3.0, 1.04]
    """
    found = np.diff(np.asarray(time, dtype=np.float64)) / period
    whole = np.rint(found)
    return np.where(np.abs(found - whole) < ROUNDING, whole, found)


def find_gaps(time: ArrayLike, period: float) -> tuple[Gap, ...]:
    """Return where rows are missing; parameters as of `intervals`.

    >>> [str(gap) for gap in find_gaps([0.0, 1.0, 4.0, 5.4], 1.0)]
    ['2 rows missing between 1 and 4 s (row 2)']
    """
    t, steps = np.asarray(time, dtype=np.float64), intervals(time, period)
    return tuple(
        Gap(int(row), float(t[row]), float(t[row + 1]), round(float(steps[row])) - 1)
        for row in np.flatnonzero(steps > LATE)
    )


def check_period(path: Path | str, header: LogHeader, time: Floats) -> None:
    """Refuse rows that are another time apart than their header says.

    Raises:
        DataFileError: If the mean interval without gaps is off by more than `PERIOD_WITHIN` and the
            ticks of the clock, or fewer intervals than `LEAST_WHOLE` are without gaps.
    """
    if not header.clocked or time.size < 2:
        return
    found = np.diff(time)
    whole = found[found <= LATE * header.period]
    if whole.size >= LEAST_WHOLE * found.size:
        most = PERIOD_WITHIN * header.period + TICK / np.sqrt(whole.size)
        if abs(float(whole.mean()) - header.period) <= most:
            return
    raise DataFileError(
        path,
        expected=f"rows {header.period:g} s apart, the period of the header",
        got=f"a median of {float(np.median(found)):g} s",
    )


def gaps_of(log: Log) -> tuple[Gap, ...]:
    """Return where rows of a log are missing; nowhere in one that no clock gave."""
    return find_gaps(log["time"], log.header.period) if log.header.clocked else ()


def late_start(log: Log) -> str:
    """Return one sentence if a log does not begin with its run; else an empty one.

    The time of a log is that of its run, whose first row is at 0 or a period later. What is further
    from 0 has lost its first rows, or counts its time from elsewhere; which of both cannot be told.
    """
    if not (log.header.clocked and log["time"].size):
        return ""
    first, period = float(log["time"][0]), log.header.period
    if -ROUNDING <= first / period <= LATE:
        return ""
    return f"the first row is at {first:.6g} s, not at 0 or {period:g} s"


def refuse_late_start(path: Path | str, log: Log, why: str) -> None:
    """Refuse a log that does not begin with its run; parameters as of `refuse_gaps`.

    Raises:
        DataFileError: If its first rows are missing, or its time counts from elsewhere.
    """
    if words := late_start(log):
        raise DataFileError(
            path,
            expected=f"all rows from the start of the run on, with times since then, for {why}",
            got=words,
        )


def places(gaps: Sequence[Gap]) -> str:
    """Return one sentence on where rows are missing.

    >>> places(find_gaps([0.0, 2.0, 3.0], 1.0))
    '1 row missing between 0 and 2 s (row 1)'
    """
    more = sum(gap.missing for gap in gaps[MOST_NAMED:])
    words = [str(gap) for gap in gaps[:MOST_NAMED]]
    return "; ".join([*words, f"{more} more in {len(gaps) - MOST_NAMED} places"] if more else words)


def refuse_gaps(path: Path | str, log: Log, why: str, *, above: float = 0.0) -> None:
    """Refuse a log in which rows are missing.

    Args:
        path, log: What is read.
        why: What needs the rows, for the message.
        above: Time that may be missing in one place, s.

    Raises:
        DataFileError: If more is missing; it names the places.
    """
    period = log.header.period
    if gaps := [gap for gap in gaps_of(log) if gap.missing * period > above + ROUNDING * period]:
        allowed = f"at most {above:g} s missing in one place" if above else "all rows"
        raise DataFileError(path, expected=f"{allowed}, for {why}", got=places(gaps))


@dataclass(frozen=True)
class EvenClock:
    """A log's rows among those of an even clock.

    Attributes:
        number: Of each row that is there, from 0, shape (N,).
    """

    number: NDArray[np.intp]

    @property
    def _all(self) -> NDArray[np.intp]:
        return np.arange(self.number[-1] + 1)

    @property
    def measured(self) -> NDArray[np.bool_]:
        """Which rows of the even clock are there, shape (M,)."""
        return np.isin(self._all, self.number)

    def lines(self, values: Floats) -> Floats:
        """Return values with straight lines over the gaps, shape (M,)."""
        return np.asarray(np.interp(self._all, self.number, values))

    def nearest(self, values: Floats) -> Floats:
        """Return values that change, if they do, in the middle of a gap, shape (M,)."""
        middles = (self.number[1:] + self.number[:-1]) / 2
        return np.asarray(values[np.searchsorted(middles, self._all)])


def even_clock(log: Log) -> EvenClock:
    """Return where the rows of a log stand on an even clock."""
    steps = np.maximum(np.rint(intervals(log["time"], log.header.period)), 1)
    return EvenClock(np.concatenate([[0], np.cumsum(steps)]).astype(np.intp))
