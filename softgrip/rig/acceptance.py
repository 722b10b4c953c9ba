"""A rig against the dissertation: bands about its printed measurements, judged from a log.

The printed numbers are the dissertation's; the width of a band, and the criterion of settling
where none is printed, are ours. A rig that fails a band may be a good rig: it is another one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.fingers import column, fingers_of
from softgrip.logs.gaps import EvenClock, even_clock, refuse_gaps, refuse_late_start
from softgrip.logs.reader import read_log
from softgrip.logs.schema import Log
from softgrip.logs.steps import AVERAGING, BRIDGED, WINDOW, judge_step, refuse_short, refuse_slow
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.statics import FULL_PRESSURE
from softgrip.units import DEG, MPa

Experiment = Literal["lqr", "pid", "gripper"]

SETTLING: dict[Experiment, tuple[float, str]] = {
    "lqr": (0.8, "Section 3.4"),
    "pid": (2.38, "Section 4.4"),
    "gripper": (0.7, "Section 6.4"),
}
"""Printed settling time, s, and where."""
ERROR: dict[Experiment, tuple[float, str]] = {
    "lqr": (2.0, "Section 3.4"),
    "pid": (2.0, "Section 4.4"),
    "gripper": (1.0, "Section 6.4"),
}
"""Largest steady-state error, deg. That of the LQR is printed as almost zero: 2 deg are ours."""
NOISE = 2.0  # deg, root mean square (Section 6.4)
WIDTH = 0.25
"""Half width of a band, as a share of the printed number."""


@dataclass(frozen=True)
class Band:
    """A quantity of a log and the band that it should be in.

    Attributes:
        quantity, place, unit: What, where it is printed, and in which unit.
        low, high: Ends of the band, both included.
        found: What the log gives; infinite for a step that does not settle.
    """

    quantity: str
    place: str
    low: float
    high: float
    unit: str
    found: float

    @property
    def passed(self) -> bool:
        """Whether what was found is in the band."""
        return self.low <= self.found <= self.high

    def __str__(self) -> str:
        word = "pass" if self.passed else "FAIL"
        return (
            f"{word}  {self.quantity}: {self.found:.3g} {self.unit}, "
            f"band {self.low:.3g} to {self.high:.3g} ({self.place})"
        )


def sensor_bands(log: Log) -> list[Band]:
    """Judge what holds in any run: no sensor at an end of its scale, no pressure above 0.15 MPa.

    A log without counts tells nothing of the converter.
    """
    largest = SensorParameters().largest_count
    pressure = float(log["pressure"].max()) / MPa
    # Noise of the sensor may read a little above.
    bands = [
        Band("largest pressure", "Figure 3.10", 0, 1.05 * FULL_PRESSURE / MPa, "MPa", pressure)
    ]
    counted = [values for name, values in log.columns.items() if "_counts" in name]
    if not counted:
        return bands
    counts = np.concatenate(counted)
    railed = 100 * float(np.mean((counts <= 0) | (counts >= largest)))
    return [Band("samples at an end of the converter", "own limit", 0, 0, "%", railed), *bands]


def finger_bands(log: Log, clock: EvenClock, finger: int, experiment: Experiment) -> list[Band]:
    """Judge the step of one finger, counted from 0; the reference steps at time 0."""
    angle = log[column("angle", finger)]
    target = float(log[column("reference", finger)][-1])
    step = judge_step(
        clock.time, clock.lines(angle), target, about="own end", measured=clock.measured
    )
    # The averaging keeps a share 1/n of white noise in the mean that is taken away.
    samples = 2 * round(WINDOW / clock.period / 2) + 1
    noise = float(step.noise) / sqrt(1 - 1 / samples) / DEG
    sensor = SensorParameters()
    count = sensor.angle_range / (sensor.high_count - sensor.low_count) / DEG
    settling, place = SETTLING[experiment]
    largest, where = ERROR[experiment]
    which = f"finger {finger + 1}: "
    return [
        Band(
            which + "settled within 5 % of its own end", place,
            (1 - WIDTH) * settling, (1 + WIDTH) * settling, "s", float(step.settled_5_percent),
        ),
        Band(
            which + "steady-state error", where, 0.0, (1 + WIDTH) * largest, "deg",
            abs(float(step.steady_state_error)) / DEG,
        ),
        Band(
            # Less noise than printed is no fault, but less than that of rounding is a dead sensor.
            which + "noise of the flex sensor", "Section 6.4", count / sqrt(12),
            (1 + WIDTH) * NOISE, "deg", noise,
        ),
    ]  # fmt: skip


def judge(path: Path | str, experiment: Experiment) -> tuple[Band, ...]:
    """Judge the log of a step.

    Args:
        path: Of a log with a reference for each finger, one number from the first row on.
        experiment: What was run: the LQR of Chapter 3, the PID on the full model of Chapter 4, or
            the scheme of Chapter 6 with the faster H(s).

    Raises:
        InvalidInputError: If there is no such experiment.
        DataFileError: If the log cannot be read, has no such reference, or misses rows at the
            start, or too many in one place.
    """
    if experiment not in get_args(Experiment):
        raise InvalidInputError(
            "experiment", expected=f"one of {get_args(Experiment)}", got=experiment
        )
    log = read_log(path)
    if log.header.set_up != "gripper":
        raise DataFileError(path, expected="a log of the gripper", got=log.header.set_up)
    fingers, references = len(fingers_of(log)), fingers_of(log, "reference")
    if not fingers or len(references) != fingers or np.ptp(references, axis=1).any():
        raise DataFileError(
            path,
            expected="an angle and a constant reference for each finger",
            got=", ".join(log.columns),
        )
    refuse_late_start(path, log, "the time of the step")
    refuse_short(path, float(log["time"][-1]))
    refuse_slow(path, log)
    refuse_gaps(path, log, AVERAGING, above=BRIDGED * WINDOW)
    clock = even_clock(log)
    bands = sensor_bands(log)
    for finger in range(fingers):
        bands += finger_bands(log, clock, finger, experiment)
    return tuple(bands)


def report(bands: Sequence[Band]) -> str:
    """Return a line for each band, and a line that counts them."""
    passed = sum(band.passed for band in bands)
    return "\n".join([*map(str, bands), f"{passed} of {len(bands)} bands passed"])
