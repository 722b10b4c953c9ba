"""What drives a rig."""

import numpy as np
import pytest

from softgrip.control.pid import PID, Gains
from softgrip.control.rig_controller import CommandSequence, Tracking


def test_a_sequence_is_followed_by_rest():
    sequence = CommandSequence([1.0, 2.0])
    assert [sequence.update([0.0]) for _ in range(3)] == [1.0, 2.0, 0.0]


def test_the_mean_of_the_fingers_follows_a_reference_that_is_held_at_its_end():
    moving = Tracking(PID(Gains(kp=1.0)), [0.1, 0.3])
    commands = [float(moving.update([[0.0], [0.2]])[0]) for _ in range(3)]
    assert commands == pytest.approx([0.0, 0.2, 0.2])  # reference less the mean angle, 0.1


def test_runs_follow_the_reference_each_by_itself():
    angles = np.array([[0.0, 0.1, 0.4], [0.2, 0.1, 0.2]])
    command = Tracking(PID(Gains(kp=2.0)), 0.5).update(angles)
    assert command == pytest.approx(2 * (0.5 - angles.mean(axis=0)))
