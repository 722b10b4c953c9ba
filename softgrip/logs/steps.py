"""What the log of a controlled step says: settling times and steady-state error (Section 4.4)."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.ndimage import uniform_filter1d

from softgrip.arrays import Flags, Floats, check_positive, floats
from softgrip.checks import takes_numbers
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.gaps import check_even, even_clock, period_of, refuse_gaps, refuse_late_start
from softgrip.logs.reader import read_log
from softgrip.logs.schema import Log
from softgrip.units import DEG

WINDOW = 0.5
"""Over which the angle is averaged before it is judged, s, half of it on each side."""

BRIDGED = 0.25
"""Share of the window that may be missing in one place, and is bridged by a straight line. The
line has the whole noise of its two ends: over a whole window it moves settling times by half a
second."""

END = 2.0
"""Length of the end of a record that counts as its steady state, s; the last quarter
of a record of less than twice that."""
BENT = 0.1
"""Share of a constant reference, and `SURE` times the noise, by which the first angle must be off
zero for the finger to have been bent before the step."""
SURE = 4.0

SHARES, ANGLES = (0.02, 0.05), (2 * DEG, 5 * DEG)
"""Half widths of the bands in which a step is judged: shares of it, and rad."""

AVERAGING = "the mean of the angle about each row"

About = Literal["reference", "own end"]


@dataclass(frozen=True)
class StepResponse:
    """What a step response is like, each of shape () or (runs,).

    Attributes:
        settled_2_percent, settled_5_percent: Time after which the angle stays within a share of the
            step, s; infinite if it does not, or if that begins only within the last `END` of the
            record: too short to call it rest.
        settled_2_deg, settled_5_deg: The same within 2 and 5 deg.
        settled: The same within the band that was asked for.
        steady_state_error: Reference less the mean of the end, rad.
        swing: Half the distance of the least from the largest averaged angle of the end, rad.
        noise: Root mean square of what the averaging took away at the end, rad. A band below a few
            times ``noise / sqrt(samples averaged)`` is judged by chance.
    """

    settled_2_percent: Floats
    settled_5_percent: Floats
    settled_2_deg: Floats
    settled_5_deg: Floats
    settled: Floats
    steady_state_error: Floats
    swing: Floats
    noise: Floats


@takes_numbers
def smoothed(angle: ArrayLike, period: float, *, window: float = WINDOW) -> Floats:
    """Return the mean about each sample, so without a delay; beyond the ends the ends go on.

    Args:
        angle: rad, shape (N,) or (runs, N).
        period: s, > 0.
        window: s, >= 0; the odd number of samples nearest above it is taken, one for 0.
    """
    check_positive(period=period)
    if not np.ndim(angle):
        raise InvalidInputError("angle", expected="shape (N,) or (runs, N)", got=angle)
    samples = 2 * round(window / period / 2) + 1
    return np.asarray(uniform_filter1d(floats(angle=angle)[0], samples, mode="nearest"))


@takes_numbers
def judge_step(
    time: ArrayLike,
    angle: ArrayLike,
    target: float,
    *,
    initial: float = 0.0,
    about: About = "reference",
    window: float = WINDOW,
    band: float = ANGLES[-1],
    measured: Flags | bool = True,
) -> StepResponse:
    """Judge a step.

    Args:
        time: Since the step, s, shape (N,), evenly sampled.
        angle: rad, shape (N,) or (runs, N).
        target, initial: Reference after and before the step, rad.
        about: Middle of the bands: the reference, or the mean of the response's own end. A response
            that keeps an error as large as the band settles about the second alone.
        window: Of the averaging, s; 0 for a response without noise.
        band: Half width of a further band, rad, > 0.
        measured: Which samples were measured and not bridged, shape (N,): the noise is that of
            these.

    Raises:
        InvalidInputError: If the times do not increase or are uneven, or samples are missing.
    """
    t, raw = floats(time=time, angle=angle)
    check_even(t)
    if raw.shape[-1:] != t.shape or np.isinf(raw).any():
        raise InvalidInputError(
            "angle", expected=f"shape (..., {t.size}), not infinite", got=raw.shape
        )
    y = smoothed(raw, float((t[-1] - t[0]) / (t.size - 1)), window=window)
    lasted = float(t[-1] - t[0])
    end = END if lasted >= 2 * END else lasted / 4
    own = final_value(t, raw, window=end)
    middle = np.broadcast_to(target, own.shape) if about == "reference" else own
    tail = t >= t[-1] - end
    bands = [(x, False) for x in SHARES] + [(x, True) for x in (*ANGLES, band)]
    found = [
        settling_time(t, y, final=middle, initial=initial, band=width, absolute=absolute)
        for width, absolute in bands
    ]
    two_percent, five_percent, two_deg, five_deg, own_band = (
        np.where(time > t[-1] - end, np.inf, time) for time in found
    )
    return StepResponse(
        settled_2_percent=two_percent,
        settled_5_percent=five_percent,
        settled_2_deg=two_deg,
        settled_5_deg=five_deg,
        settled=own_band,
        steady_state_error=np.asarray(target - own),
        swing=np.asarray(np.ptp(y[..., tail], axis=-1) / 2),
        noise=np.asarray(np.std((raw - y)[..., tail & np.asarray(measured)], axis=-1)),
    )


def refuse_short(path: Path | str, after: float) -> None:
    """Refuse a log of a step that has no end.

    Args:
        path: What is read.
        after: How long it goes on from the step on, s.

    Raises:
        DataFileError: If that is not longer than `END`.
    """
    if not after > END:
        raise DataFileError(
            path, expected=f"a step and more than {END:g} s after it, its end", got=f"{after:g} s"
        )


def refuse_slow(path: Path | str, log: Log, *, window: float = WINDOW) -> None:
    """Refuse a log whose samples are too slow to be averaged over `window` [s].

    Raises:
        DataFileError: If it has fewer than three rows in a window.
    """
    if window and (period := period_of(log)) > window / 2:
        raise DataFileError(
            path,
            expected=f"rows {window / 2:g} s apart or less, for {AVERAGING} over {window:g} s",
            got=f"{period:g} s",
        )


@dataclass(frozen=True)
class LoggedStep:
    """The one step of a log.

    Attributes:
        begun: When, by the log's clock, s.
        initial, target: Angle before, and reference after it, rad.
        time: Since then, s, even, shape (N,).
        angle: rad, shape (N,), on straight lines from row to row.
        measured: Which samples have a row, shape (N,).
    """

    begun: float
    initial: float
    target: float
    time: Floats
    angle: Floats
    measured: Flags


def find_step(path: Path | str, *, window: float = WINDOW) -> LoggedStep:
    """Find the step of a log.

    A reference that changes once tells it. One number throughout is a step at time 0, from 0, or,
    where the finger was bent by then, from its first angle.

    Args:
        path: Of a log with a column `reference` [rad].
        window: Of the averaging that needs the rows, s.

    Raises:
        DataFileError: If the log has no reference, its reference is no single step, rows are
            missing at the start of a step at time 0, or more than `BRIDGED` of the window in one
            place, or as of `refuse_short` and `refuse_slow`.
    """
    log = read_log(path)
    if lacking := [name for name in ("reference", "angle") if name not in log.columns]:
        raise DataFileError(path, expected=f"a column {lacking[0]!r}", got=", ".join(log.columns))
    refuse_slow(path, log, window=window)
    refuse_gaps(path, log, AVERAGING, above=BRIDGED * window)
    clock = even_clock(log)
    angle, reference = clock.lines(log["angle"]), clock.nearest(log["reference"])
    changes = np.flatnonzero(np.diff(reference))
    start, begun, initial = 0, 0.0, 0.0
    if changes.size:
        start = int(changes[0]) + 1
        begun, initial = float(clock.time[start]), float(reference[0])
    else:
        refuse_late_start(path, log, "the time of the step, which a change of the reference tells")
        late = np.diff(angle[angle.size // 2 :])
        noise = float(np.std(late)) / 2**0.5 if late.size else 0.0
        if abs(angle[0]) > max(BENT * abs(reference[-1]), SURE * noise):
            initial = float(angle[0])
    if changes.size > 1 or reference[-1] == initial:
        raise DataFileError(
            path, expected="a reference with one step", got=f"{changes.size} changes"
        )
    refuse_short(path, float(clock.time[-1]) - begun)
    return LoggedStep(
        begun,
        initial,
        float(reference[-1]),
        clock.time[start:] - begun,
        angle[start:],
        clock.measured[start:],
    )


def judge_step_log(
    path: Path | str,
    *,
    about: About = "reference",
    window: float = WINDOW,
    band: float = ANGLES[-1],
) -> StepResponse:
    """Judge the step that a log holds.

    Args:
        path: Of the log; see `find_step`.
        about, window, band: As of `judge_step`.

    Raises:
        DataFileError: As of `find_step`.
    """
    step = find_step(path, window=window)
    return judge_step(
        step.time,
        step.angle,
        step.target,
        initial=step.initial,
        about=about,
        window=window,
        band=band,
        measured=step.measured,
    )
