"""A calibration measured on a rig: counts at rest beside what a gauge and a protractor say."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.board.calibration import BoardCalibration, fit_sensor
from softgrip.rig.interface import Rig
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.simulation import together

SPEED, PUSH = 10.0, 0.3
"""Of the motor, rad/s, and how long it turns between two readings, s."""
REST, LISTEN = 3.0, 1.0
"""How long the finger rests before a reading, and how long the counts are averaged, s."""
FITTED = 0.9
"""Share of a flex sensor's range up to which its line is fitted: nearer to its end noise is cut."""

Known = Callable[[], tuple[float, ArrayLike]]
"""Reads gauge and protractor: Pa, and rad of each finger."""


@dataclass(frozen=True)
class Readings:
    """What sensors and instruments said at rest.

    Attributes:
        pressure_counts, pressure: Mean counts, and Pa, shape (N,).
        angle_counts, angles: Mean counts, and rad, shape (N, fingers).
    """

    pressure_counts: Floats
    pressure: Floats
    angle_counts: Floats
    angles: Floats


def take_readings(rig: Rig, known: Known, *, count: int = 14) -> Readings:
    """Push step by step, and read sensors and instruments at rest after each.

    Args:
        rig: With its plunger at home.
        known: Asked after each step.
        count: Of readings; 14 bend the simulated finger beyond its flex sensor.

    Raises:
        CommandRefusedError: If the rig may not push.
    """
    rows = []
    for _ in range(count):
        for speed, time in ((SPEED, PUSH), (0.0, REST)):
            for _ in range(round(time / rig.period)):
                rig.advance(speed)
        seen = together([rig.advance(0.0) for _ in range(round(LISTEN / rig.period))])
        pressure, angles = known()
        counts = seen.pressure_counts.mean(), seen.angle_counts.mean(axis=(0, 2))
        rows.append((counts[0], pressure, counts[1], np.ravel(angles)))
    return Readings(*map(np.array, zip(*rows, strict=True)))


def fit_calibration(readings: Readings, board: str, name: str) -> BoardCalibration:
    """Fit the curve of each sensor, that of a flex sensor to angles in its data sheet's range.

    Args:
        readings: Of three readings or more, in the range of each sensor.
        board: Identity of the board, `rig.info.identity`.
        name: For the header of logs.

    Raises:
        InvalidInputError: If the readings fix no curve, or those of the pressure sensor no line,
            in which the board holds its limits.
    """
    end = FITTED * SensorParameters().angle_range
    fingers = zip(readings.angle_counts.T, readings.angles.T, strict=True)
    angles = tuple(fit_sensor(counts[known < end], known[known < end]) for counts, known in fingers)
    pressure = fit_sensor(readings.pressure_counts, readings.pressure, curve="line")
    return BoardCalibration(board, pressure, angles, name)
