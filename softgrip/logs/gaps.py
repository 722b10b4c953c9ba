"""The clock of a log: its time column, against the period that its header states.

Telemetry gets lost, and a log then goes on after a gap; a row comes too early, or a clock is slow.
Whatever sums, differs or filters a log must go by its times; what needs even samples takes them
from an `EvenClock`, which bridges a short gap, and refuses a long one.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import ROUNDING, Floats, floats, intervals
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.schema import Log, LogHeader

LATE = 1.5
"""Periods from a row to the next, above which rows are missing between them. A clock may be uneven
by half a period: what is late by less is late, not lost."""
PERIOD_WITHIN = 0.02
"""Of the header's period: how far the mean interval without gaps may be from it. A resonator is
good to 0.5 %."""
EARLY = 0.5
"""Periods from a row to the next, below which one of them is not of the clock."""
EVEN = 0.1
"""Of a period: what a row may be off an even clock and still count as on it. Between two rows a
straight line stands for them, and a mean of two has less noise than a row."""
TICK = 1e-3
"""s: a board's clock counts whole milliseconds, but none whose period is not many of them."""
LEAST_WHOLE = 0.1
"""Share of the intervals that must be no gaps. A host that is too busy may leave out more than half
of the rows; but where there is a gap after every row, it is the header that is wrong."""
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


def find_gaps(time: ArrayLike, period: float) -> tuple[Gap, ...]:
    """Return where rows are missing; parameters as of `intervals`.

    >>> [str(gap) for gap in find_gaps([0.0, 1.0, 4.0, 5.4], 1.0)]
    ['2 rows missing between 1 and 4 s (row 2)']
    """
    (t,), steps = floats(time=time), intervals(time, period)
    return tuple(
        Gap(int(row), float(t[row]), float(t[row + 1]), round(float(steps[row])) - 1)
        for row in np.flatnonzero(steps > LATE)
    )


def check_even(time: Floats) -> None:
    """Refuse times, s, shape (N,), that are not evenly apart; there must be two or more.

    Raises:
        InvalidInputError: If they are fewer, some are missing, or one is more than `EVEN` of the
            median interval off an even clock.
    """
    if time.ndim != 1 or time.size < 2:
        raise InvalidInputError("time", expected="(N,), two samples or more", got=time.shape)
    period = float(np.median(np.diff(time)))
    if not period > 0:
        raise InvalidInputError("time", expected="times that increase", got=time)
    if gaps := find_gaps(time, period):
        raise InvalidInputError("time", expected="even samples", got=places(gaps))
    even = np.linspace(time[0], time[-1], time.size)
    off = float(np.abs(time - even).max())
    # Between neighbours, so that both ends of an interval may be off.
    if off > 2 * EVEN * period:
        raise InvalidInputError(
            "time", expected=f"even samples, {period:g} s apart", got=f"one {off:.3g} s off"
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
        tick = min(TICK, EVEN * header.period)
        most = PERIOD_WITHIN * header.period + tick / np.sqrt(whole.size)
        if abs(float(whole.mean()) - header.period) <= most:
            return
    raise DataFileError(
        path,
        expected=f"rows {header.period:g} s apart, the period of the header (in s)",
        got=f"a median of {float(np.median(found)):g} s",
    )


def gaps_of(log: Log) -> tuple[Gap, ...]:
    """Return where rows of a log are missing; nowhere in one that no clock gave."""
    return find_gaps(log["time"], period_of(log)) if log.header.clocked else ()


def period_of(log: Log) -> float:
    """Return the sampling period of a log's times, s.

    It is the mean interval without gaps; what the header states where that keeps step with it from
    the first row to the last, or where no clock gives the rows.
    """
    stated, found = log.header.period, np.diff(log["time"])
    whole = found[(found > EARLY * stated) & (found <= LATE * stated)]
    if not log.header.clocked or whole.size == 0:
        return stated
    mean = float(whole.mean())
    return stated if abs(mean - stated) * whole.size < EVEN * stated else mean


def uneven(log: Log) -> str:
    """Return one sentence on times that are off an even clock; an empty one if none is."""
    clock = even_clock(log)
    if clock.even or not log.header.clocked:
        return ""
    off = float(np.abs(clock.at - clock.number).max()) * clock.period
    return (
        f"times are up to {off:.3g} s off an even clock of {clock.period:.6g} s: what needs even "
        "samples has them on straight lines"
    )


def crowded(log: Log) -> str:
    """Return one sentence on rows that come early after the one before; an empty one if none."""
    steps = intervals(log["time"], log.header.period)
    rows = np.flatnonzero(steps < EARLY) if log.header.clocked else np.array([], np.intp)
    if not rows.size:
        return ""
    first, more = int(rows[0]), f", and {rows.size - 1} more" if rows.size > 1 else ""
    return (
        f"row {first + 2} comes {steps[first] * log.header.period:.3g} s after the one before, "
        f"where the period is {log.header.period:g} s{more}"
    )


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
    period = period_of(log)
    if gaps := [gap for gap in gaps_of(log) if gap.missing * period > above + ROUNDING * period]:
        allowed = f"at most {above:g} s missing in one place" if above else "all rows"
        raise DataFileError(path, expected=f"{allowed}, for {why}", got=places(gaps))


@dataclass(frozen=True)
class EvenClock:
    """An even clock, and where a log's rows are on it.

    Attributes:
        start: Time of the first row, s.
        period: s.
        at: Place of each row, in periods from the first, shape (N,), rising.
    """

    start: float
    period: float
    at: Floats

    @property
    def time(self) -> Floats:
        """Time of each sample of the clock, s, shape (M,)."""
        return np.asarray(self.start + self.period * self._all)

    @property
    def number(self) -> NDArray[np.intp]:
        """The sample that is nearest to each row, from 0, shape (N,)."""
        return np.rint(self.at).astype(np.intp)

    @property
    def _all(self) -> Floats:
        return np.arange(self.number[-1] + 1.0)

    @property
    def even(self) -> bool:
        """Whether each row is on the clock."""
        return bool((self.at == self.number).all())

    @property
    def measured(self) -> NDArray[np.bool_]:
        """Which samples of the even clock have a row within half a period, shape (M,)."""
        return np.isin(self._all, self.number)

    def lines(self, values: Floats) -> Floats:
        """Return values on straight lines from row to row, shape (M,)."""
        return np.asarray(np.interp(self._all, self.at, values))

    def nearest(self, values: Floats) -> Floats:
        """Return values of the nearest row, shape (M,): they change in the middle of a gap."""
        middles = (self.at[1:] + self.at[:-1]) / 2
        return np.asarray(values[np.searchsorted(middles, self._all)])


def even_clock(log: Log) -> EvenClock:
    """Return where the rows of a log stand on an even clock of its own period."""
    period = period_of(log)
    at = (log["time"] - log["time"][0]) / period
    number = np.rint(at)
    # Of the rows near a sample the nearest one is on it, the others are where they are.
    order = np.lexsort((np.abs(at - number), number))
    first = np.concatenate([[True], np.diff(number[order]) > 0])
    near = np.zeros(at.size, np.bool_)
    near[order] = first
    return EvenClock(
        float(log["time"][0]), period, np.where(near & (np.abs(at - number) < EVEN), number, at)
    )


def evened(log: Log) -> Log:
    """Return a log whose rows are those of its even clock; the same one if they are already."""
    clock = even_clock(log)
    if clock.even and clock.measured.all():
        return log
    columns = {name: clock.lines(values) for name, values in log.columns.items()}
    return replace(log, columns=columns | {"time": clock.time})
