"""Step tests in open loop on the simulated rig, Section 5.4."""

from dataclasses import replace
from math import ceil

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from softgrip.arrays import Floats, check_positive
from softgrip.control.pid import PERIOD
from softgrip.logs.repeated_steps import StepTest
from softgrip.simulator.compiled import drive_compiled
from softgrip.simulator.parameters import PumpParameters, RigParameters, Spread
from softgrip.simulator.simulation import Simulation

DURATION = 6.0
"""Of a test, s (assumed)."""


def step_commands(plunger: ArrayLike) -> Floats:
    """Return the motor speeds, rad/s, that push to a place of the plunger as fast as can be.

    Args:
        plunger: Travel, m, > 0 and within the stroke, any shape; an axis of periods is added.
    """
    check_positive(plunger=plunger)
    pump, travel = PumpParameters(), np.asarray(plunger, dtype=np.float64)[..., None]
    # What ramping up loses, ramping down after the command adds, if the speed is reached: then the
    # place is met exactly.
    ramp = ceil(pump.speed_limit / pump.acceleration_limit / PERIOD)
    pushing = np.maximum(ramp, np.ceil(travel / (pump.advance * pump.speed_limit * PERIOD)))
    speed = travel / (pump.advance * pushing * PERIOD)
    return np.where(np.arange(round(DURATION / PERIOD)) < pushing, speed, 0.0)


def simulate_step_test(rig: RigParameters, plunger: float, *, runs: int, seed: int) -> StepTest:
    """Simulate a step and return what is true of it, without sensors, their noise and range.

    Args:
        rig: Its parameters.
        plunger: Travel of the plunger, m.
        runs, seed: As of `Simulation`.
    """
    driven = Simulation(rig, runs=runs, seed=seed, period=PERIOD)
    made = drive_compiled(
        driven, step_commands(plunger), duration=DURATION, keep=("true_pressure", "true_angle")
    )
    assert made.true_pressure is not None
    assert made.true_angle is not None
    return StepTest(made.time[1:], made.true_pressure[:, 1:], made.true_angle[:, 0, 1:])


def travel_to(rig: RigParameters, angle: float) -> float:
    """Return the travel of the plunger, m, with which the rig without spread ends at an angle, rad.

    Args:
        rig: Its parameters.
        angle: At the end of the test, rad, > 0, within what the stroke reaches.
    """
    alike = replace(rig, spread=Spread())

    def beyond(plunger: float) -> float:
        return float(simulate_step_test(alike, plunger, runs=1, seed=0).angle[-1] - angle)

    return float(brentq(beyond, 1e-5, 0.8 * PumpParameters().stroke, xtol=1e-7))
