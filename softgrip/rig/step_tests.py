"""Step tests in open loop, Section 5.4: how they are made, and the mean of several runs."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from softgrip.materials.arrays import Floats, check_positive
from softgrip.rig.log_runs import read_alike
from softgrip.rig.parameters import PumpParameters, RigParameters, Spread
from softgrip.rig.plant import SimulatedRig

PERIOD = 0.025
"""Sampling period, s (Section 3.4)."""
DURATION = 6.0
"""Of a test, s (assumed)."""


@dataclass(frozen=True)
class StepTest:
    """Several runs of one step and their mean, SI.

    Attributes
    ----------
    time
        s, shape (N,).
    pressures, angles
        Gauge pressure, Pa, and angle, rad, of each run, shape (runs, N).
    """

    time: Floats
    pressures: Floats
    angles: Floats

    @property
    def pressure(self) -> Floats:
        """Mean over the runs, Pa, shape (N,)."""
        return np.asarray(self.pressures.mean(axis=0))

    @property
    def angle(self) -> Floats:
        """Mean over the runs, rad, shape (N,)."""
        return np.asarray(self.angles.mean(axis=0))


def read_step_test(paths: Sequence[Path | str]) -> StepTest:
    """Read the runs of one step from their logs.

    Parameters
    ----------
    paths
        Logs that start at rest and at atmospheric pressure, with the same times; at least one.

    Raises
    ------
    DataFileError
        As of `read_alike`.
    """
    logs = read_alike(paths)
    return StepTest(
        logs[0]["time"], *(np.stack([log[name] for log in logs]) for name in ("pressure", "angle"))
    )


def step_commands(plunger: float) -> Floats:
    """Return the motor speeds, rad/s, that push to a place of the plunger as fast as can be.

    Parameters
    ----------
    plunger
        Travel, m, > 0 and within the stroke.
    """
    check_positive(plunger=plunger)
    pump = PumpParameters()
    # What ramping up loses, ramping down after the command adds, if the speed is reached: then the
    # place is met exactly.
    ramp = ceil(pump.speed_limit / pump.acceleration_limit / PERIOD)
    pushing = max(ramp, ceil(plunger / (pump.advance * pump.speed_limit * PERIOD)))
    commands = np.zeros(round(DURATION / PERIOD))
    commands[:pushing] = plunger / (pump.advance * pushing * PERIOD)
    return commands


def simulate_step_test(rig: RigParameters, plunger: float, *, runs: int, seed: int) -> StepTest:
    """Simulate a step and return what is true of it, without sensors, their noise and range.

    Parameters
    ----------
    rig
        Its parameters.
    plunger
        Travel of the plunger, m.
    runs, seed
        As of `SimulatedRig`.
    """
    driven = SimulatedRig(rig, runs=runs, seed=seed, period=PERIOD)
    _, truth = driven.open_loop(step_commands(plunger))
    return StepTest(np.asarray(truth.time), truth.pressure.T, truth.angle.T)


def travel_to(rig: RigParameters, angle: float) -> float:
    """Return the travel of the plunger, m, with which the rig without spread ends at an angle, rad.

    Parameters
    ----------
    rig
        Its parameters.
    angle
        At the end of the test, rad, > 0, within what the stroke reaches.
    """
    alike = replace(rig, spread=Spread())

    def beyond(plunger: float) -> float:
        return float(simulate_step_test(alike, plunger, runs=1, seed=0).angle[-1] - angle)

    return float(brentq(beyond, 1e-5, 0.8 * PumpParameters().stroke, xtol=1e-7))
