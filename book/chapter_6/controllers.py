"""The controllers of Chapter 6 for the simulated gripper, designed on its own logs."""

from dataclasses import replace
from typing import Literal

import control
import numpy as np

from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, lqr_gain
from softgrip.control.rig_controller import CommandSequence, RigController, Tracking
from softgrip.control.state_feedback import SPEED_DIGITS, ObserverFeedback
from softgrip.dynamics.second_order import SecondOrder
from softgrip.gripper.internal_model import PERIOD, InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.optimal_feedforward import FeedforwardProgram, OptimalFeedforward
from softgrip.gripper.plant import LEFT, RIGHT, Gripper
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.logs.fingers import identified_gripper, read_runs
from softgrip.provenance import data_file
from softgrip.reads import remembered
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.simulator.gripper_steps import push_commands
from softgrip.units import DEG

WANTED = 45 * DEG
"""rad: what Section 6.4 asks of both fingers."""
OPEN_LOGS = tuple(f"simulated/gripper-open-{run}.csv" for run in range(1, 8))

Name = Literal["open loop", "4.8/s", "2/s", "LQR", "LQR faster", "optimal feedforward"]
"""The scheme of Figure 6.3 goes by its filter, one of `FILTERS`."""
WEIGHTS = {"LQR": Weights(), "LQR faster": Weights(p=1000.0, q=(1.0, 0.03, 0.0))}
"""Of the regulators: those of Eq. (3.29), and those of Chapter 3's faster one."""


@remembered
def own_model() -> Gripper:
    """Return P(s) as the gripper's logs in open loop identify it, input in rad/s."""
    return identified_gripper(read_runs([data_file(name).path for name in OPEN_LOGS]))


def printed_model() -> Gripper:
    """Return Eq. (6.26), left finger first, with the mean of the identified gains.

    The unit of its command is not printed, so that its own gain cannot be used.
    """
    gain = own_model().mean.gain
    return Gripper(tuple(replace(finger, gain=gain) for finger in (LEFT, RIGHT)))


def target_angles(model: Gripper) -> Floats:
    """Return what of `WANTED` for each finger one pump can hold, Eq. (6.24), rad."""
    return project(model, [WANTED] * len(model.fingers)).reached


@remembered
def best_command(model: Gripper) -> OptimalFeedforward:
    """Return the commands within the motor's limit that settle the model as early as any can.

    Of these, the ones that keep the fingers together best.
    """
    target = tuple(target_angles(model).tolist())
    return next(FeedforwardProgram(model, target, limit=SPEED_LIMIT).trade_off())


def open_loop_commands(speed: float | None = None) -> Floats:
    """Return the commands of the step in open loop, rad/s; at the speed of the fast one if None."""
    fast = choice("gripper_speed") if speed is None else speed
    return push_commands(choice("gripper_travel"), printed_gripper().pump, fast)


def gripper_controller(
    name: Name, *, model: Gripper | None = None, limit: float = np.inf
) -> RigController:
    """Return a controller that goes for the `target_angles` of its model.

    Args:
        name: Which.
        model: Known to the controller; `own_model` if None.
        limit: Of the motor, rad/s, as far as the scheme of Figure 6.3 knows of it.
    """
    if name == "open loop":
        return CommandSequence(open_loop_commands())
    known = own_model() if model is None else model
    if name == "optimal feedforward":
        return CommandSequence(np.round(best_command(known).command, SPEED_DIGITS))
    if name in FILTERS:
        low_pass = filter_state_space(*FILTERS[name])
        matrices = controller_matrices(known, mean_inverse(known), low_pass, period=PERIOD)
        return InternalModelController(
            matrices, target_angles(known), limit=limit, digits=SPEED_DIGITS
        )
    mean = known.mean
    w = mean.natural_frequency
    finger = SecondOrder(w, mean.damping / (2 * w))
    regulator = ObserverFeedback(
        lqr_gain(finger, WEIGHTS[name]), finger, mean.gain * SPEED_LIMIT, period=PERIOD
    )
    return Tracking(regulator, target_angles(known).mean())


def feedback_of(controller: RigController, fingers: int) -> control.StateSpace | None:
    """Return a controller from the angles [rad] to the motor speed [rad/s], without its limit.

    Args:
        controller: Which.
        fingers: Number of angles.

    Returns:
        StateSpace or None: One input a finger, sampled at `PERIOD`; None if it looks at no angle.
    """
    match controller:
        case InternalModelController():
            whole = controller.matrices.linear()
            return control.ss(whole.A, whole.B[:, :fingers], whole.C, whole.D[:, :fingers], PERIOD)
        case Tracking(controller=ObserverFeedback() as regulator):
            each = np.full((1, fingers), 1 / fingers)
            of_mean = regulator.linear()
            return control.ss(of_mean.A, of_mean.B @ each, of_mean.C, of_mean.D @ each, PERIOD)
        case _:
            return None
