"""What logs of a gripper say: identified fingers, their deviations, excited band, tracking.

Nothing here knows of the simulated rig: the same calls read the logs of a real one. A finger has
its columns ``angle``, ``angle_2``, ..., and ``reference``, ``reference_2``, ... where it has one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.dynamics.identify import Identified, identify
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.uncertainty import deviation
from softgrip.logs.repeated_steps import read_alike
from softgrip.logs.schema import Log


def column(name: str, finger: int) -> str:
    """Return the name of a finger's column, counted from 0.

    >>> column("angle", 0), column("angle", 1)
    ('angle', 'angle_2')
    """
    return name if finger == 0 else f"{name}_{finger + 1}"


def fingers_of(log: Log, name: str = "angle") -> Floats:
    """Return the columns of all fingers of a log, shape (fingers, N); none of them is (0, N)."""
    found: list[Floats] = []
    while column(name, len(found)) in log.columns:
        found.append(log[column(name, len(found))])
    return np.array(found).reshape(len(found), log["time"].size)


@dataclass(frozen=True)
class GripperLogs:
    """Several runs of one experiment, SI.

    Attributes:
        time: s, shape (N,), evenly sampled.
        commands: Motor speed held until each time, rad/s, shape (runs, N).
        angles: rad, shape (runs, fingers, N).
        references: rad, shape (fingers, N), or (0, N) in open loop.
        events: Of the first run: (time in s, words).
    """

    time: Floats
    commands: Floats
    angles: Floats
    references: Floats
    events: tuple[tuple[float, str], ...]

    @property
    def period(self) -> float:
        """Sampling period, s."""
        return float((self.time[-1] - self.time[0]) / (self.time.size - 1))

    @property
    def motor_angle(self) -> Floats:
        """What the motor has turned if it did as told, rad, shape (runs, N)."""
        return np.asarray(self.period * np.cumsum(self.commands, axis=1))


def read_runs(paths: Sequence[Path | str]) -> GripperLogs:
    """Read logs of one experiment.

    Raises:
        DataFileError: If a log has one finger only, or as of `read_alike`.
    """
    logs = read_alike(paths)
    for path, log in zip(paths, logs, strict=True):
        if len(fingers_of(log)) < 2:
            raise DataFileError(path, expected="columns angle and angle_2", got="one finger")
    return GripperLogs(
        logs[0]["time"],
        np.stack([log["command"] for log in logs]),
        np.stack([fingers_of(log) for log in logs]),
        fingers_of(logs[0], "reference"),
        logs[0].events,
    )


def identify_finger(time: Floats, motor_angle: Floats, angle: Floats) -> Identified:
    """Fit a finger of second order, from the angle of the motor [rad] to that of the finger [rad].

    The motor angle stands for the pressure, which Eq. (6.14) makes proportional to it. A count of
    the pressure sensor of Section 6.4 is a quarter of what bends a finger to pi/4. The model
    has no dead time.
    """
    return identify(time, motor_angle, angle, initial_input=0.0, dead_time=0.0)


def dynamics_of(found: Identified) -> FingerDynamics:
    """Return the element of P(s), with the input in rad/s, from an identified finger."""
    w = found.natural_frequency.value
    return FingerDynamics(2 * found.damping_ratio.value * w, w**2, found.gain.value * w**2)


def identified_gripper(logs: GripperLogs) -> Gripper:
    """Return P(s) from the mean of several runs in open loop, input in rad/s."""
    mean, motor = logs.angles.mean(axis=0), logs.motor_angle.mean(axis=0)
    return Gripper(tuple(dynamics_of(identify_finger(logs.time, motor, angle)) for angle in mean))


def each_identified(logs: GripperLogs) -> list[list[FingerDynamics]]:
    """Return what each run alone identifies, ``found[finger][run]``.

    A record that is drowned in noise determines nothing and is left out.
    """
    found: list[list[FingerDynamics]] = []
    for finger in range(logs.angles.shape[1]):
        found.append([])
        for motor, angle in zip(logs.motor_angle, logs.angles[:, finger], strict=True):
            try:
                found[-1].append(dynamics_of(identify_finger(logs.time, motor, angle)))
            except InvalidInputError:
                continue
    return found


def run_deviation(logs: GripperLogs, finger: int) -> tuple[Floats, Floats]:
    """Return `deviation` for one finger, the mean of the runs being nominal.

    The command is the same in all runs, so that the ratio of two responses is that of the angles;
    their differences from sample to sample are taken, which come to rest.

    Returns:
        tuple: Frequency, rad/s, up to half the sampling frequency, and the largest deviation, a
            share.
    """
    moved = np.diff(logs.angles[:, finger], axis=-1)
    spectra = np.fft.rfft(moved)[:, 1:]
    frequency = 2 * np.pi * np.fft.rfftfreq(moved.shape[-1], logs.period)[1:]
    return np.asarray(frequency), deviation(spectra, spectra.mean(axis=0))
