"""From what the sensors feel to counts of the converter, and back to pressure and angle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats, Number
from softgrip.simulator.parameters import SensorParameters

Counts = NDArray[np.int64]


@dataclass(frozen=True)
class Measurement:
    """What the sensors say at one time, or, with a leading axis, at many.

    Attributes:
        time: s, a number or shape (samples,).
        pressure: Gauge, Pa, shape (..., runs).
        angle: rad, shape (..., fingers, runs).
        pressure_counts, angle_counts: What the converter gave, same shapes.
    """

    time: float | Floats
    pressure: Floats
    angle: Floats
    pressure_counts: Counts
    angle_counts: Counts


def rounded(value: Number, full: Number, sensors: SensorParameters) -> Number:
    """Return the counts of `to_counts` as floats; for the kernel, which compiles this."""
    span = sensors.high_count - sensors.low_count
    counts = np.rint(sensors.low_count + value * (span / full))
    return np.minimum(np.maximum(counts, 0.0), sensors.largest_count)


def read_back(counts: Number, full: Number, sensors: SensorParameters) -> Number:
    """Return the value that a count stands for: the line of `to_counts`, read backwards."""
    return (counts - sensors.low_count) * (full / (sensors.high_count - sensors.low_count))


def to_counts(value: Floats, full: Number, sensors: SensorParameters) -> Counts:
    """Return the counts of a sensor, rounded and cut to the converter's scale.

    Args:
        value: Output of the sensor with its noise, any unit, any shape.
        full: End of the sensor's range, same unit.
        sensors: Its scale.

    >>> to_counts(np.array([0.0, 1.0, 9.0]), 1.0, SensorParameters()).tolist()
    [102, 921, 1023]
    """
    counts: Counts = rounded(value, full, sensors).astype(np.int64)
    return counts


def from_counts(counts: Counts, full: Number, sensors: SensorParameters) -> Floats:
    """Return `read_back` of counts."""
    value: Floats = read_back(counts.astype(np.float64), full, sensors)
    return value


def measure(
    time: float | Floats, pressure: Floats, angle: Floats, noise: Floats, sensors: SensorParameters
) -> Measurement:
    """Convert what the sensors feel.

    Args:
        time: s.
        pressure, angle: Outputs of the lags, Pa gauge and rad, shape (..., runs) and
            (fingers, ..., runs).
        noise: Standard normal numbers, shape (1 + fingers, ..., runs): of the pressure and of
            each angle.
        sensors: Their parameters.
    """
    felt_pressure = np.minimum(pressure, sensors.pressure_range)
    felt_angle = np.minimum(angle, sensors.angle_range)
    pressure_counts = to_counts(
        felt_pressure + sensors.pressure_noise * noise[0], sensors.pressure_range, sensors
    )
    angle_counts = to_counts(
        felt_angle + sensors.angle_noise * noise[1:], sensors.angle_range, sensors
    )
    return Measurement(
        time,
        from_counts(pressure_counts, sensors.pressure_range, sensors),
        from_counts(angle_counts, sensors.angle_range, sensors),
        pressure_counts,
        angle_counts,
    )
