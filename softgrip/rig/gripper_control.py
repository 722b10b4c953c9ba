"""The controllers of Chapter 6 for the simulated gripper, designed on its own logs."""

from dataclasses import replace
from functools import cache
from typing import Literal

import numpy as np

from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, lqr_gain
from softgrip.control.observer_feedback import ObserverFeedback
from softgrip.dynamics.second_order import SecondOrder
from softgrip.gripper.internal_model import InternalModelController
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.optimal_feedforward import OptimalFeedforward, trade_off
from softgrip.gripper.plant import Gripper
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space
from softgrip.materials.arrays import Floats
from softgrip.provenance import data_file
from softgrip.rig.gripper_calibration import push_commands
from softgrip.rig.gripper_loop import CommandSequence, GripperController, OnTheMean
from softgrip.rig.gripper_parameters import LEFT, RIGHT, TRAVEL, printed_gripper
from softgrip.rig.gripper_rig import PERIOD
from softgrip.rig.gripper_tests import identified_gripper, read_runs
from softgrip.units import DEG

WANTED = 45 * DEG
"""rad: what Section 6.4 asks of both fingers."""
OPEN_LOGS = tuple(f"simulated/gripper-open-{run}.csv" for run in range(1, 8))

Name = Literal["open loop", "H 4.8/s", "H 2/s", "LQR", "LQR faster", "optimal feedforward"]
FILTERS = {"H 4.8/s": FAST, "H 2/s": SLOW}
WEIGHTS = {"LQR": Weights(), "LQR faster": Weights(p=1000.0, q=(1.0, 0.03, 0.0))}
"""Of the regulators: those of Eq. (3.29), and those of Chapter 3's faster one."""


@cache
def own_model() -> Gripper:
    """Return P(s) as the gripper's logs in open loop identify it, input in rad/s."""
    return identified_gripper(read_runs([data_file(name).path for name in OPEN_LOGS]))


def printed_model() -> Gripper:
    """Return Eq. (6.26), left finger first, with the mean of the identified gains.

    The unit of its command is not printed, so that its own gain cannot be used.
    """
    gain = own_model().mean.gain
    return Gripper(tuple(replace(finger, gain=gain) for finger in (LEFT, RIGHT)))


def reachable(model: Gripper) -> Floats:
    """Return the angles nearest to `WANTED` that one pump can hold, Eq. (6.24), rad."""
    direction = model.velocity_gains
    wanted = np.full(direction.shape, WANTED)
    return np.asarray(direction * (direction @ wanted) / (direction @ direction))


@cache
def best_command(model: Gripper) -> OptimalFeedforward:
    """Return the commands within the motor's limit that settle the model as early as any can.

    Of these, the ones that keep the fingers together best.
    """
    return next(iter(trade_off(model, tuple(reachable(model).tolist()), limit=SPEED_LIMIT)))


def gripper_controller(
    name: Name, *, model: Gripper | None = None, limit: float = np.inf
) -> GripperController:
    """Return a controller, its target being what is `reachable` by the model.

    Parameters
    ----------
    name
        Which.
    model
        Known to the controller; `own_model` if None.
    limit
        Of the motor, rad/s, as far as the scheme of Figure 6.3 knows of it.
    """
    if name == "open loop":
        return CommandSequence(push_commands(TRAVEL, printed_gripper().pump))
    known = own_model() if model is None else model
    if name == "optimal feedforward":
        return CommandSequence(best_command(known).command)
    if name in FILTERS:
        return InternalModelController(
            known,
            reachable(known),
            mean_inverse(known),
            filter_state_space(*FILTERS[name]),
            period=PERIOD,
            limit=limit,
        )
    mean = known.mean
    w = mean.natural_frequency
    finger = SecondOrder(w, mean.damping / (2 * w))
    regulator = ObserverFeedback(
        lqr_gain(finger, WEIGHTS[name]), finger, mean.gain * SPEED_LIMIT, period=PERIOD
    )
    return OnTheMean(regulator, reachable(known))
