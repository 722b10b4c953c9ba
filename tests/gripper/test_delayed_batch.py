"""Many rigs at once: against the loop that runs one gripper at a time, and measures by hand."""

import numpy as np
import pytest

from softgrip.control.step_metrics import settling_time
from softgrip.errors import InvalidInputError
from softgrip.gripper.delayed_batch import (
    POINTS,
    LateMotion,
    LinearLaws,
    PredictiveLaws,
    Sequences,
    late_measures,
    run_late,
)
from softgrip.gripper.delayed_plant import DelayedGripper, delayed_model
from softgrip.gripper.gripper_batch import GripperBatch, draw_grippers
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper
from softgrip.gripper.predictive import PredictiveController, predictive_law
from softgrip.gripper.printed_loop import equal_targets
from softgrip.gripper.shaping_filter import low_pass
from softgrip.gripper.synchronization import synchronization_error

TARGETS = equal_targets()[None]


def grippers_of(batch):
    return [
        Gripper(tuple(FingerDynamics(*own) for own in zip(*rows, strict=True)))
        for rows in zip(
            batch.damping.tolist(), batch.stiffness.tolist(), batch.gain.tolist(), strict=True
        )
    ]


@pytest.mark.parametrize("periods", [0, 2])
def test_linear_laws_are_the_loop_of_one_gripper_at_a_time(periods):
    drawn = [draw_grippers(PRINTED, 3, seed=seed) for seed in (1, 2)]
    matrices = [controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass(w)) for w in (2.0, 3)]
    law = LinearLaws(matrices, np.repeat(TARGETS, 2, axis=0))
    delays = np.full((2, 2), 0.1 * periods)
    made = run_late(drawn, delays, law, np.zeros((2, 2, 3, 20)), limit=1.5)
    for rig, (batch, own) in enumerate(zip(drawn, matrices, strict=True)):
        for k, gripper in enumerate(grippers_of(batch)):
            alone = run_gripper(
                gripper, InternalModelController(own, TARGETS[0]), duration=2.0, limit=1.5,
                delay_samples=periods, points=POINTS,
            )  # fmt: skip
            assert made.angles[rig, :, k] == pytest.approx(alone.angles, abs=1e-9)
            assert made.time == pytest.approx(alone.time)


def test_predictive_laws_are_the_controller_of_many_runs():
    plant = DelayedGripper(PRINTED, (0.125, 0.2))
    made = predictive_law(plant, TARGETS[0], limit=2.0)
    noise = 0.03 * np.random.default_rng(0).standard_normal((1, 2, 3, 25))
    found = run_late(
        [GripperBatch.of(*[PRINTED] * 3)], np.array([plant.delays]), PredictiveLaws([made]), noise,
        limit=2.0,
    )  # fmt: skip
    model, loop = delayed_model(plant, 0.1), PredictiveController(made)
    x = np.zeros((len(model.A), 3))
    for k in range(25):
        command = loop.update(model.C @ x + noise[0, :, :, k])
        assert found.commands[0, :, k] == pytest.approx(command, abs=1e-9)
        x = model.A @ x + np.outer(model.B, command)


def test_each_finger_s_own_delay_makes_its_angle_late_and_nothing_else():
    commands = np.random.default_rng(1).normal(size=(1, 15))
    batch, noise = [GripperBatch.of(PRINTED)], np.zeros((1, 2, 1, 15))
    at_once, late = (
        run_late(batch, np.array([own]), Sequences(commands), noise, limit=9.0).angles[0, :, 0]
        for own in ((0.0, 0.0), (0.075, 0.2))
    )
    for k, steps in enumerate((3, 8)):
        assert late[k, steps:] == pytest.approx(at_once[k, :-steps], abs=1e-15)
        assert not late[k, :steps].any()


def test_measures_by_hand():
    time = 0.025 * np.arange(201)
    shares = np.stack([1 - np.exp(-time), 1 - np.exp(-0.9 * time)])[None, :, None]
    targets = np.array([[0.8, 1.0]])
    commands = np.array([[[1.0, -2.0, *[0.0] * 48]]])
    motion = LateMotion(time, shares * targets[..., None, None], commands, 0.1)
    found = late_measures(motion, targets)
    angles = motion.angles[0, :, 0]
    ends = angles[:, -20:].mean(axis=1)
    by_other = settling_time(time, angles, final=ends, band=0.05).max()
    assert found.settling[0, 0] == pytest.approx(by_other, abs=0.025)
    assert found.apart[0, 0] == pytest.approx(synchronization_error(angles, targets[0]).max())
    # The area above a lag's answer is its time constant, less what is still to come.
    area = np.mean([(1 - np.exp(-5.0)), (1 - np.exp(-4.5)) / 0.9])
    assert found.missed[0, 0] == pytest.approx(area, abs=0.02)
    assert found.travel[0, 0] == pytest.approx(0.3)
    assert found.error[0, 0] == pytest.approx(np.exp(-0.9 * time[-20:]).mean())


def test_what_does_not_rest_does_not_settle():
    time = 0.025 * np.arange(201)
    swings = (1 + 0.2 * np.sin(9 * time))[None, None, None].repeat(2, axis=1)
    motion = LateMotion(time, swings, np.zeros((1, 1, 50)), 0.1)
    assert np.isinf(late_measures(motion, np.ones((1, 2))).settling).all()


def test_what_does_not_fit_is_refused():
    batch, law = [GripperBatch.of(PRINTED)], Sequences(np.zeros((1, 5)))
    with pytest.raises(InvalidInputError, match="multiples"):
        run_late(batch, np.array([[0.01, 0.0]]), law, np.zeros((1, 2, 1, 5)), limit=1.0)
    with pytest.raises(InvalidInputError, match="shapes"):
        run_late(batch, np.zeros((1, 3)), law, np.zeros((1, 2, 1, 5)), limit=1.0)
