"""Inertia and damping of the simulated gripper, from what its step tests must identify.

``python -m softgrip.simulator.gripper_calibration`` prints them; they stand, rounded, in
`gripper_parameters`. Section 6.4 says that Eq. (6.26) is the mean of models identified from steps
in open loop. A finger by Ludwick's law has no one frequency: about 45 deg small motions are half as
fast again as what a step to 45 deg identifies. So the step is simulated and identified.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from softgrip.arrays import Floats
from softgrip.control.rig_controller import CommandSequence
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import FingerDynamics
from softgrip.logs.fingers import GripperLogs, each_identified
from softgrip.simulator.drive import drive
from softgrip.simulator.gripper_parameters import (
    DAMPING,
    INERTIA,
    LEFT,
    OPEN_LOOP_ANGLES,
    RIGHT,
    TRAVEL,
    finger_of,
    printed_gripper,
)
from softgrip.simulator.parameters import PumpParameters, RigParameters
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV

OPEN_LOOP_DURATION = 6.0
"""Of a test in open loop, s (assumed)."""


def push_commands(travel: float, pump: PumpParameters, speed: float = 5 * REV) -> Floats:
    """Return the motor speeds, rad/s, that push the plunger as far as said, then none.

    Args:
        travel: m, > 0.
        pump: Which.
        speed: Not to be passed, rad/s.
    """
    periods = max(1, int(np.ceil(travel / (pump.advance * speed * PERIOD) - 1e-9)))
    return np.full(periods, np.round(travel / (pump.advance * periods * PERIOD), SPEED_DIGITS))


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


def calibrate() -> tuple[Floats, Floats, float]:
    """Return inertia, damping and the travel of the plunger in the open-loop step, SI."""
    base = printed_gripper(spread=False)

    def gripper(x: Floats) -> RigParameters:
        fingers = tuple(map(finger_of, OPEN_LOOP_ANGLES, *np.exp(x[:4]).reshape(2, 2).tolist()))
        return replace(base, fingers=fingers)

    def off(x: Floats) -> Floats:
        angles, found = step_identifies(gripper(x), float(np.exp(x[4])))
        pairs = [(one, printed) for (one,), printed in zip(found, (LEFT, RIGHT), strict=True)]
        ratios = [getattr(f, n) / getattr(w, n) for f, w in pairs for n in ("stiffness", "damping")]
        ratios.append(float(angles.mean() / np.mean(OPEN_LOOP_ANGLES)))
        return np.log(ratios)

    start = np.log([*INERTIA, *DAMPING, TRAVEL])
    found = np.exp(least_squares(off, start, diff_step=1e-3, xtol=1e-6).x)
    return found[:2], found[2:4], float(found[4])


if __name__ == "__main__":
    print(*calibrate(), sep="\n")
