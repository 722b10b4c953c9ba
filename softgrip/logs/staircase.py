"""What the log of a controlled staircase says: time to a commanded change, and lag (Figure 4.7)."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.checks import record, takes_numbers
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.gaps import check_even, even_clock, refuse_gaps
from softgrip.logs.reader import read_log

LONGEST = 0.25
"""Longest time, s, that may be missing in one place. The angle is bridged by a straight line, and a
reference that changes is taken to do so in the middle: in the mean over n changes, which take about
a second, that is an error of half of it over n."""


@dataclass(frozen=True)
class StaircaseResponse:
    """What the response to a staircase is like.

    Attributes:
        edges: Number of changes of the reference.
        time_to_half, time_to_change: From a change of the reference until the mean response to all
            changes has covered 50 and 90 % of it, s; infinite if it does not within the shortest
            hold.
        lag: Delay at which the angle is most alike the reference, s.
        rms_error: Of angle against reference, rad.
    """

    edges: int
    time_to_half: float
    time_to_change: float
    lag: float
    rms_error: float


@takes_numbers
def lag(reference: ArrayLike, angle: ArrayLike, period: float, *, longest: float = 3.0) -> float:
    """Return the delay, s, of the largest correlation between reference and later angle.

    Args:
        reference, angle: rad, shape (N,), evenly sampled, not constant.
        period: s, > 0; the lag is a multiple of it.
        longest: Largest delay that is tried, s; it must leave half of the record.

    >>> wave = np.sin(np.arange(400) / 20)
    >>> lag(wave[10:], wave[:-10], 0.025)
    0.25
    """
    r, y = record(at_least=2, reference=reference, angle=angle)
    check_positive(period=period, longest=longest)
    most = round(longest / period)
    if r.shape != y.shape or r.ndim != 1 or 2 * most > r.size or not (np.ptp(r) and np.ptp(y)):
        raise InvalidInputError(
            "reference, angle",
            expected=f"two arrays (N,), not constant, N >= {2 * most}",
            got=(r.shape, y.shape),
        )
    # Where one of both is constant there is no correlation: such a lag is the least alike.
    with np.errstate(invalid="ignore", divide="ignore"):
        alike = [np.corrcoef(r[: r.size - k], y[k:])[0, 1] for k in range(most + 1)]
    alike = np.nan_to_num(alike, nan=-1.0).tolist()
    return int(np.argmax(alike)) * period


def mean_edge(
    time: ArrayLike, reference: ArrayLike, angle: ArrayLike, *, measured: ArrayLike = True
) -> tuple[Floats, Floats]:
    """Return time since a change, s, and the share of it covered in the mean, up to the least hold.

    Share 0 is the reference before the change, share 1 that after it; the mean over all changes
    takes most of the noise away. A loop that has not come to rest in a hold starts the next change
    from a share below 0.

    Args:
        time, reference, angle: s, rad, rad, shape (N,), evenly sampled, with at least one step in
            the reference; steps, not ramps.
        measured: Which samples were measured and not bridged, shape (N,). The length of a hold is
            that of one whose both ends are.

    Raises:
        InvalidInputError: If times are missing or uneven, there is no change or no such hold, or
            the reference is a ramp.
    """
    t, r, y = record(at_least=2, time=time, reference=reference, angle=angle)
    check_even(t)
    at = np.flatnonzero(np.diff(r)) + 1
    if at.size == 0:
        raise InvalidInputError("reference", expected="a change", got="none")
    known = np.broadcast_to(measured, r.shape)
    known = known[at - 1] & known[at]
    holds = np.diff(at)[known[:-1] & known[1:]]
    if at.size == 1 and known[0]:
        holds = np.array([r.size - at[0]])
    if holds.size == 0:
        raise InvalidInputError("measured", expected="a hold from end to end", got="none")
    shortest = int(holds.min())
    if shortest < 2:
        raise InvalidInputError("reference", expected="levels that are held", got="a ramp")
    # The end of the log may cut the last hold short, which must not shorten all others.
    whole = at[at + shortest <= r.size]
    change = r[whole] - r[whole - 1]
    rows = y[whole[:, None] + np.arange(shortest)]
    share = ((rows - r[whole - 1][:, None]) / change[:, None]).mean(axis=0)
    return t[at[0] : at[0] + shortest] - t[at[0]], share


def judge_staircase(path: Path | str) -> StaircaseResponse:
    """Judge the staircase that a log holds.

    Args:
        path: Of a log with a column `reference` [rad] that changes in steps.

    Raises:
        DataFileError: If the log has no such reference, or misses more than `LONGEST` in one place.
    """
    log = read_log(path)
    if "reference" not in log.columns:
        raise DataFileError(path, expected="a column 'reference [rad]'", got=str([*log.columns]))
    refuse_gaps(path, log, "the mean response to an edge", above=LONGEST)
    clock = even_clock(log)
    angle, reference = clock.lines(log["angle"]), clock.nearest(log["reference"])
    try:
        since, share = mean_edge(clock.time, reference, angle, measured=clock.measured)
        delay = lag(reference, angle, clock.period)
    except InvalidInputError as error:
        raise DataFileError(path, expected="a staircase", got=str(error)) from None
    return StaircaseResponse(
        edges=int(np.count_nonzero(np.diff(reference))),
        time_to_half=_first(since, share, 0.5),
        time_to_change=_first(since, share, 0.9),
        lag=delay,
        rms_error=float(np.sqrt(np.mean((log["reference"] - log["angle"]) ** 2))),
    )


def _first(since: Floats, share: Floats, level: float) -> float:
    # Noise may cross a level before the response does: the last sample below it decides.
    below = np.flatnonzero(share < level)
    if below.size == 0:
        return 0.0
    last = int(below[-1])
    if last + 1 == since.size:
        return float("inf")
    part = (level - share[last]) / (share[last + 1] - share[last])
    return float(since[last] + part * (since[last + 1] - since[last]))
