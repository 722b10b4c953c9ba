"""Answers to the tasks, found again by the package's loop and by hand."""

import numpy as np
import pytest

from book.beyond.delay import tasks
from book.beyond.delay.sliders import LARGEST_ERROR, LONGEST_DELAY
from softgrip.gripper.delayed_batch import LinearLaws, run_late
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import equal_targets
from softgrip.gripper.shaping_filter import low_pass
from softgrip.gripper.smith_predictor import smith_matrices
from softgrip.gripper.synchronization import synchronization_error
from softgrip.units import DEG


def angles(error, delay=tasks.DELAY, bandwidth=tasks.BANDWIDTH):
    """Run the package's predictor, whose model is exact between points too."""
    real = delay / 1000
    belief = DelayedGripper(PRINTED, (real, real)).scaled(1 + error / 100)
    law = LinearLaws(
        [smith_matrices(belief, mean_inverse(PRINTED), low_pass(bandwidth))], equal_targets()[None]
    )
    return run_late(
        [GripperBatch.of(PRINTED)], np.full((1, 2), real), law, np.zeros((1, 2, 1, 60)), limit=1e9
    ).angles[0, :, 0]


@pytest.mark.parametrize("error", [0.0, -100.0, tasks.LESS, tasks.MORE])
def test_differences_and_overshoots_are_those_of_the_package(error):
    found = angles(error)
    apart = synchronization_error(found, equal_targets()).max() / DEG
    assert tasks.apart(error) == pytest.approx(apart, abs=1e-3)
    over = 100 * (found[0].max() / equal_targets()[0] - 1)
    assert tasks.overshoot(error) == pytest.approx(over, abs=0.01)


def test_a_right_delay_is_none_and_too_short_is_worse_than_too_long():
    assert tasks.apart(0.0) == pytest.approx(tasks.apart(0.0, delay=0.0), abs=0.05)
    assert tasks.apart(-100.0) > tasks.apart(0.0) + 0.3
    assert tasks.overshoot(tasks.LESS) > tasks.overshoot(0.0) > tasks.overshoot(tasks.MORE)


def test_positions_that_the_tasks_name_are_on_the_sliders():
    assert 0 < tasks.DELAY < LONGEST_DELAY
    assert tasks.DELAY % 25 == 0
    assert -100 < tasks.LESS < tasks.MORE <= LARGEST_ERROR


def test_behind_by_hand():
    assert tasks.behind(60.0, 40.0) == pytest.approx(2.4)
    rate = tasks.largest_rate(1.0)
    assert tasks.behind(tasks.DIFFERENCE, rate) == pytest.approx(1.0)
