"""What is held side by side: known by its limits, and the whole rig against the linear one."""

import numpy as np
import pytest

from book.beyond.delay import full_rig
from book.beyond.delay.methods import METHODS, best_feedforward, known_targets
from book.beyond.delay.rigs import rigs
from book.beyond.delay.step_time import controllers
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import Sequences, run_late
from softgrip.gripper.delayed_plant import DelayedGripper, delayed_model
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import Gripper

ROW = rigs()[5]


def test_the_certified_optimum_of_the_outer_fingers_is_that_of_all():
    """Those that lie between them stay between them: the full program finds the same time."""
    plant = DelayedGripper(ROW.gripper(4), (0.1,) * 4)
    target = known_targets([plant])[0]
    outer = best_feedforward(plant, target)
    whole = FeedforwardProgram(
        plant.gripper, tuple(target.tolist()), limit=SPEED_LIMIT, points=4
    ).settled_by(outer.settling)
    assert whole.worst_sync == pytest.approx(outer.worst_sync, rel=0.02, abs=1e-4)


def test_delays_of_their_own_keep_even_equal_fingers_apart():
    """Fingers that are alike move as one, unless one answers later."""
    gripper = Gripper((ROW.gripper(2).mean,) * 2)
    target = known_targets([DelayedGripper(gripper, (0.0, 0.0))])[0]
    one, own, late = (
        best_feedforward(DelayedGripper(gripper, delays), target)
        for delays in ((0.1, 0.1), (0.1, 0.2), (0.2, 0.3))
    )
    assert one.worst_sync < 1e-6
    assert own.worst_sync > 0.02
    assert late.command == pytest.approx(own.command)


def test_feedforward_with_delays_by_its_own_motion():
    """What the program says of the angles is what the loop's fingers do."""
    gripper, delays = ROW.gripper(2), (0.05, 0.15)
    target = known_targets([DelayedGripper(gripper, delays)])[0]
    program = FeedforwardProgram(
        gripper, tuple(target.tolist()), limit=SPEED_LIMIT, points=4, delays=delays
    )
    best = program.settled_by(1.6)

    made = run_late(
        [GripperBatch.of(gripper)], np.array([delays]), Sequences(best.command[None]),
        np.zeros((1, 2, 1, 30)), limit=1e9,
    )  # fmt: skip
    assert made.angles[0, :, 0, 1:] == pytest.approx(best.angles, abs=1e-9)


@pytest.mark.parametrize("name", [name for name in METHODS if name != "predictive"])
def test_a_controller_of_one_run_is_the_law_of_a_batch(name):
    plant = DelayedGripper(ROW.gripper(2), (0.2, 0.2))
    targets = known_targets([plant])
    law, alone = METHODS[name]([plant], targets), controllers(plant)[name]()
    model, rng = delayed_model(plant, 0.1), np.random.default_rng(1)
    x = np.zeros(len(model.A))
    for _ in range(25):
        y = model.C @ x + 0.03 * rng.standard_normal(2)
        of_batch = law.update(y[None, None])[0, 0]
        one = np.ravel(alone.update(y[:, None]))[0]
        # Controllers of a rig round to a millionth of a rad/s, and the limit is the loop's.
        assert np.clip(one, -SPEED_LIMIT, SPEED_LIMIT) == pytest.approx(
            np.clip(of_batch, -SPEED_LIMIT, SPEED_LIMIT), abs=2e-5
        )
        x = model.A @ x + model.B * np.clip(one, -SPEED_LIMIT, SPEED_LIMIT)


def test_whole_rigs_agree_with_what_is_kept_of_them():
    """Every thirteenth rig: no farther from the kept mean than rigs scatter."""
    found = full_rig.measured("Smith, 2/s", 100, every=13).apart[:, 0] * 180 / np.pi
    kept = next(
        one for one in full_rig.KEPT.read() if (one.method, one.delay) == ("Smith, 2/s", 100)
    )
    assert found.mean() == pytest.approx(kept.apart, abs=3 * found.std() / found.size**0.5)


def test_kept_orders_of_the_whole_rig_are_those_of_the_linear_one():
    from book.beyond.delay.kept import cell

    whole = {one.method: one for one in full_rig.KEPT.read() if one.delay == 300}
    for measure in ("apart", "settling"):
        ours, linear = (
            [whole[name].__dict__[measure] for name in METHODS],
            [cell(name, measure, 300).value for name in METHODS],
        )
        assert np.corrcoef(np.argsort(np.argsort(ours)), np.argsort(np.argsort(linear)))[0, 1] > 0.5
