"""A controller on the simulated rig."""

import numpy as np

from softgrip.control.rig_controller import CommandSequence
from softgrip.simulator.drive import drive
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, REV
from tests.simulator.rigs import printed_gripper

CALM_GRIPPER = printed_gripper(spread=False)


def test_a_controller_of_a_longer_period_is_asked_once_in_it():
    rig = Simulation(CALM_GRIPPER)
    made = drive(rig, CommandSequence([1.0, 2.0]), duration=8 * rig.period, every=3)
    assert made.command[1:, 0].tolist() == [1, 1, 1, 2, 2, 2, 0, 0]


def test_the_first_sample_is_taken_at_rest_and_a_command_is_cut():
    rig = Simulation(CALM_GRIPPER, runs=3)
    made = drive(rig, CommandSequence([9.0]), duration=2 * rig.period, limit=5.0)
    assert made.command.T.tolist() == [[0.0, 5.0, 0.0]] * 3
    assert made.time.tolist() == [0.0, rig.period, 2 * rig.period]
    assert (made.truth.angle[0] == 0).all()
    assert made.measured.angle.shape == (3, 2, 3)


def test_a_push_moves_its_finger_and_through_the_air_the_other():
    # A finger held back takes less air, so that the pressure and the other finger rise.
    commands = np.concatenate([[4.3 * REV], np.zeros(60)])
    free, pushed = (
        drive(
            Simulation(CALM_GRIPPER, period=0.1), CommandSequence(commands), duration=6.1, push=push
        ).truth
        for push in (None, lambda t: [[-1e-3 if t > 2.95 else 0.0], [0.0]])
    )
    off = (pushed.angle - free.angle)[-1, :, 0]
    np.testing.assert_array_equal(pushed.angle[:30], free.angle[:30])
    assert off[0] < -2 * DEG
    assert 0 < off[1] < 1 * DEG
    assert pushed.pressure[-1] > free.pressure[-1]
