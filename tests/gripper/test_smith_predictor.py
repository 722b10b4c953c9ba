"""The loop with the delay in its model: against the loop without, and with a wrong delay."""

import numpy as np
import pytest

from softgrip.gripper.delayed_batch import LinearLaws, run_late
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FILTERS, equal_targets
from softgrip.gripper.shaping_filter import filter_state_space, low_pass
from softgrip.gripper.smith_predictor import smith_matrices

INVERSE = mean_inverse(PRINTED)
FAST, SLOW = (filter_state_space(*FILTERS[name]) for name in ("4.8/s", "2/s"))


@pytest.mark.parametrize("periods", [0, 1, 3])
@pytest.mark.parametrize("feedback", [None, low_pass(1.5)])
def test_delays_of_whole_periods_are_those_of_the_printed_loop(periods, feedback):
    late = DelayedGripper(PRINTED, (0.1 * periods,) * 2)
    runs = [
        run_gripper(
            PRINTED, InternalModelController(matrices, equal_targets()), duration=4.0, noise=0.03,
            delay_samples=1, points=1,
        ).angles
        for matrices in (
            smith_matrices(late, INVERSE, FAST, feedback_filter=feedback),
            controller_matrices(
                PRINTED, INVERSE, FAST, feedback_filter=feedback, delay_samples=periods
            ),
        )
    ]  # fmt: skip
    assert runs[0] == pytest.approx(runs[1], abs=1e-10)


def run(matrices, delay, duration=10.0):
    """Return angles of the printed fingers, late, and commands; no noise and no limit."""
    law = LinearLaws([matrices], equal_targets()[None])
    noise = np.zeros((1, 2, 1, round(duration / 0.1)))
    made = run_late([GripperBatch.of(PRINTED)], np.full((1, 2), delay), law, noise, limit=1e9)
    return made.angles[0, :, 0], made.commands[0, 0]


@pytest.mark.parametrize("delay", [0.05, 0.125, 0.3])
def test_a_known_delay_leaves_the_motion_as_it_is_and_makes_it_late(delay):
    late = DelayedGripper(PRINTED, (delay, delay))
    angles, commands = run(smith_matrices(late, INVERSE, FAST), delay)
    at_once, sent = run(controller_matrices(PRINTED, INVERSE, FAST), 0.0)
    shift = round(delay / 0.025)
    assert commands == pytest.approx(sent, abs=1e-8)
    assert angles[:, shift:] == pytest.approx(at_once[:, :-shift], abs=1e-8)


@pytest.mark.parametrize(("ahead", "back"), [(SLOW, None), (FAST, SLOW)])
@pytest.mark.parametrize("delay", [0.1, 0.2, 0.3])
@pytest.mark.parametrize("wrong", [0.7, 1.3])
def test_it_settles_with_a_delay_that_is_wrong_by_30_per_cent(ahead, back, delay, wrong):
    belief = DelayedGripper(PRINTED, (delay, delay)).scaled(wrong)
    angles, _ = run(smith_matrices(belief, INVERSE, ahead, feedback_filter=back), delay)
    shares = angles / equal_targets()[:, None]
    assert np.abs(shares[:, -40:] - 1).max() < 0.02


def test_the_printed_loop_does_not_settle_with_so_much_delay():
    angles, _ = run(controller_matrices(PRINTED, INVERSE, FAST), 0.3)
    assert np.abs(angles[:, -40:] / equal_targets()[:, None] - 1).max() > 0.1
