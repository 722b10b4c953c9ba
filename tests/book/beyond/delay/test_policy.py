"""The learned policy: what it sees, and that it learns on other rigs than it is judged on."""

import numpy as np
import pytest

from book.beyond.delay import policy
from book.beyond.delay.policy import PolicyLaws, costs, policies, policy_for
from book.beyond.delay.sweep import SEED
from book.chapter_6.controllers import own_model, target_angles
from softgrip.gripper.delayed_plant import DelayedGripper


def test_command_is_linear_in_what_was_seen_and_sent():
    """By hand, for two updates; the rig's own strength sets the unit."""
    known = DelayedGripper(own_model(), (0.1, 0.1))
    target = target_angles(known.gripper)
    weights = np.array([0.5, -2.0, 1.0, 0.3, 0.1, -0.2, 0.0, 0.05])
    law = PolicyLaws([weights], [known], target[None])
    unit = 1 / np.mean(known.gripper.velocity_gains / target)
    shares = np.array([[0.0, 0.0], [0.2, 0.3]])
    first, second = (law.update((own * target)[None, None])[0, 0] for own in shares)
    assert first == pytest.approx(0.5 * unit)
    drive = 0.5 * 0.75 - 2.0 * 0.25 + 1.0 * 0.25 + 0.3 * 0.1 + 0.1 * first / unit
    assert second == pytest.approx(drive * unit)


def test_kept_policies_cost_what_they_say_and_less_than_what_they_began_with():
    start = np.array([1.0, *[0.0] * 7])
    for one in (policies()[0], policies()[-1]):
        found = costs(np.stack([one.weights, start]), one.delay)
        assert found[0] == pytest.approx(one.cost, rel=1e-3)
        assert found[0] < found[1]


def test_it_does_not_learn_on_what_it_is_judged_by():
    assert policy.TRAINING_SEED != SEED
    for one in (policies()[0], policies()[-1]):
        trained, new = (
            costs(one.weights[None], one.delay, seed=seed)[0]
            for seed in (policy.TRAINING_SEED, policy.TRAINING_SEED + 1)
        )
        # On rigs drawn anew it costs much the same: it has learned a law and not a list.
        assert new == pytest.approx(trained, rel=0.2)


def test_a_delay_takes_the_policy_of_the_nearest():
    for delay, wanted in ((0.12, 0.1), (0.4, 0.3)):
        known = DelayedGripper(own_model(), (delay, delay))
        nearest = next(one for one in policies() if one.delay == wanted)
        assert np.array_equal(policy_for(known), nearest.weights)
