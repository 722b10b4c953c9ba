"""The pump of a log: which it is, and what it has swept, over the true times of its rows."""

import warnings
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats, intervals
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.gaps import even_clock, gaps_of, period_of, places, refuse_late_start
from softgrip.logs.schema import Log
from softgrip.pump.flow import Pump
from softgrip.quantities import in_si

LONGEST = 2.0
"""Longest gap, s, over which a command that is the same before and after it is taken as held. A
board whose host hangs stops its motor by itself; a longer gap tells too little."""
START = 1500.0
"""Pa: twice the noise of the pressure sensor. A push that begins above has lost its beginning."""
SURE = 2.0
"""Standard errors by which a start must be above it."""
LEAST_ROWS = 8
LEAST_PLACES = 4
"""Volumes that differ: a parabola has three numbers, whose errors want one more."""
MOST_HIDDEN = 0.55
"""Share of the volume that is swept at low pressure of which one gap may hide the pressure. Up to
it a straight line moves the capacity by 4 % at most, up to 0.6 by 6 %: gaps anywhere in pushes."""


def pump_of(path: Path, log: Log) -> Pump:
    """Return the pump whose ``area`` and ``lead`` a log names, each with its unit.

    Raises:
        DataFileError: If the header lacks one of them, or one is no area or no length.
    """
    notes = log.header.notes
    given = [notes.get(name, "") for name in ("area", "lead")]
    try:
        if all(given):
            return Pump(
                *(
                    in_si(name, words, unit)
                    for name, words, unit in zip(("area", "lead"), given, ("m^2", "m"), strict=True)
                )
            )
        got = "area and lead of the pump: " + ", ".join(words or "none" for words in given)
    except InvalidInputError as error:
        got = str(error)
    raise DataFileError(
        path,
        expected="the pump in the header, such as area: 3.2 cm^2 and lead: 2 mm",
        got=got,
    )


def swept_volume(path: Path | str, log: Log, flow: Floats) -> Floats:
    """Return the volume swept until each row, m^3, shape (N,).

    A row tells the command that was held until its time, the first one for a period. The rows of a
    gap tell nothing: it is bridged where the command is the same on both sides.

    Args:
        path, log: What is read.
        flow: Of each row's command, m^3/s, shape (N,).

    Raises:
        DataFileError: If the command changes over a gap, the gap is longer than `LONGEST`, or rows
            are missing at the start.
    """
    refuse_late_start(path, log, "the volume swept before it")
    command = log["command"]
    if lost := [
        gap
        for gap in gaps_of(log)
        if gap.end - gap.start > LONGEST or command[gap.row] != command[gap.row + 1]
    ]:
        raise DataFileError(
            path,
            expected=f"one command over each gap, and none above {LONGEST:g} s: else the volume "
            "swept in it is not known",
            got=places(lost),
        )
    # Numbers of periods, which are exactly 1 in an even log.
    period = period_of(log)
    steps = np.concatenate([[1.0], intervals(log["time"], period)])
    return np.asarray(np.cumsum(flow * steps) * period)


def even_push(path: Path | str, log: Log, swept: Floats, below: float) -> tuple[Floats, Floats]:
    """Return swept volume, m^3, and gauge pressure, Pa, with straight lines over gaps, shape (M,).

    A fit below a pressure weighs each row; without those of a gap it would be of another part of a
    curve that bends.

    Args:
        path, log: What is read.
        swept: m^3, shape (N,), as of `swept_volume`.
        below: Gauge pressure up to which is fitted, Pa.

    Raises:
        DataFileError: If one gap hides more than `MOST_HIDDEN` of the volume swept until there.
    """
    gaps, clock = gaps_of(log), even_clock(log)
    if not gaps:
        return swept, log["pressure"]
    volume, pressure = clock.lines(swept), clock.lines(log["pressure"])
    end = float(volume[pressure < below].max(initial=0.0))
    if hidden := [
        gap
        for gap in gaps
        if swept[gap.row] < end and swept[gap.row + 1] - swept[gap.row] > MOST_HIDDEN * end
    ]:
        raise DataFileError(
            path,
            expected=f"no gap over more than {100 * MOST_HIDDEN:g} % of what is swept below "
            f"{below:g} Pa",
            got=places(hidden),
        )
    return volume, pressure


def check_start(path: Path | str, swept: Floats, pressure: Floats) -> None:
    """Refuse a push without its beginning: what it swept then would be missing throughout.

    Args:
        path: Named in the error.
        swept, pressure: m^3 and Pa (gauge) at low pressure, shape (N,).

    Raises:
        DataFileError: If there are fewer than `LEAST_ROWS` rows, or a parabola through the pressure
            begins above `START`, by more than noise makes it.
    """
    volumes = np.unique(swept).size
    if swept.size < LEAST_ROWS or volumes < LEAST_PLACES:
        raise DataFileError(
            path,
            expected=f"{LEAST_ROWS} rows of a push at low pressure, {LEAST_PLACES} volumes or more",
            got=f"{swept.size}, {volumes}",
        )
    with warnings.catch_warnings():
        warnings.simplefilter("error", np.exceptions.RankWarning)
        try:
            found, covariance = np.polyfit(swept / np.ptp(swept), pressure, 2, cov=True)
        except np.exceptions.RankWarning:
            raise DataFileError(
                path, expected="volumes of a push that are spread", got="all but a few are one"
            ) from None
    begun = float(found[-1] - SURE * covariance[-1, -1] ** 0.5)
    if begun > START:
        raise DataFileError(
            path,
            expected=f"a push from atmospheric pressure, within {START:g} Pa",
            got=f"{begun:.0f} Pa or more before the first row",
        )
