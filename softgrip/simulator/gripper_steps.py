"""The gripper's steps in open loop, Section 6.4: a push of the plunger, and what it identifies."""

import numpy as np

from softgrip.arrays import Floats, Number
from softgrip.control.rig_controller import CommandSequence
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import FingerDynamics
from softgrip.logs.fingers import GripperLogs, each_identified
from softgrip.simulator.drive import drive
from softgrip.simulator.parameters import PumpParameters, RigParameters
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV

OPEN_LOOP_DURATION = 6.0
"""Of a test in open loop, s (assumed)."""


def push_commands(travel: Number, pump: PumpParameters, speed: Number = 5 * REV) -> Floats:
    """Return the motor speeds, rad/s, that push the plunger as far as said, then none.

    Args:
        travel: m, > 0, a number or shape (pushes,).
        pump: Which.
        speed: Not to be passed, rad/s, as `travel`.

    Returns:
        ndarray: Shape (periods,) or (pushes, periods), as long as the longest push.
    """
    way = np.asarray(travel / (pump.advance * PERIOD))[..., None]
    periods = np.maximum(1, np.ceil(way / np.asarray(speed)[..., None] - 1e-9))
    speeds = np.round(way / periods, SPEED_DIGITS)
    return np.where(np.arange(periods.max()) < periods, speeds, 0.0)


def step_identifies(
    parameters: RigParameters,
    travel: float,
    *,
    runs: int = 1,
    seed: int = 0,
    speed: float = 5 * REV,
) -> tuple[Floats, list[list[FingerDynamics]]]:
    """Simulate open-loop steps and identify each finger, without the sensors' noise.

    A push that is slower than the finger identifies nothing, or not in all runs.

    Returns:
        tuple: Angles at the end, rad, shape (fingers, runs), and the elements, their input in
            rad/s, ``found[finger][run]``.
    """
    commands = push_commands(travel, parameters.pump, speed)
    rig = Simulation(parameters, runs=runs, seed=seed, period=PERIOD)
    # The six seconds of the fast push, longer by what a slow one takes.
    duration = OPEN_LOOP_DURATION + PERIOD * (commands.size - 2)
    run = drive(rig, CommandSequence(commands), duration=duration)
    angles = run.truth.angle
    logs = GripperLogs(run.time, run.command.T, angles.transpose(2, 1, 0), np.zeros(0), ())
    return angles[-1], each_identified(logs)
