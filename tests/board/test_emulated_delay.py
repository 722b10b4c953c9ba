"""The predictive controller through the emulated board, with the board's own latencies."""

import numpy as np

from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.predictive import PredictiveController, predictive_law
from softgrip.rig.connect import connect
from softgrip.units import DEG
from tests.board.emulated import needs_emulator

MODEL = Gripper((FingerDynamics(2.444, 3.433, 0.7337), FingerDynamics(2.629, 3.600, 0.6061)))
"""The book's gripper, as its logs identify it; input in rad/s."""
WANTED = 45 * DEG * np.array([1.118, 0.881])
"""Along what one pump can hold, about 45 deg."""


def driven(where):
    """Drive a gripper for 6 s with a delay of 100 ms in the model; angles of the last second."""
    plant = DelayedGripper(MODEL, (0.1, 0.1))
    law = predictive_law(plant, WANTED, limit=SPEED_LIMIT, period=PERIOD)
    controller = PredictiveController(law, digits=SPEED_DIGITS)
    seen = []
    with connect(where, seed=1) as rig:
        rig.home()
        # The board samples faster than the loop: its command is held for a whole period.
        every = max(1, round(PERIOD / rig.period))
        angle, begun = rig.measure().angle, len(seen)
        for _ in range(round(6.0 / PERIOD)):
            command = controller.update(angle)
            for _ in range(every):
                angle = rig.advance(command).angle
            seen.append(angle[:, 0])
    return np.array(seen[begun:])[-round(1.0 / PERIOD) :]


def check(last):
    """Both fingers are about their targets: the mean of a second, with a noise of 2 deg."""
    mean = last.mean(axis=0)
    assert np.mean(mean / WANTED) == np.clip(np.mean(mean / WANTED), 0.9, 1.1)
    assert np.abs(last.std(axis=0)).max() < 6 * DEG


@needs_emulator
def test_it_brings_the_emulated_gripper_to_its_targets():
    check(driven("emulated:gripper"))


def test_the_same_class_does_so_on_the_simulated_gripper():
    check(driven("simulated:gripper"))
