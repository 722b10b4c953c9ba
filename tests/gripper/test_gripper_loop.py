"""The sampled loop around the fingers: noise, pushes, the printed response."""

import control
import numpy as np
import pytest
from scipy.signal import cont2discrete

from softgrip.errors import InvalidInputError
from softgrip.gripper.gripper_loop import noise_gain, run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import filtered_inverse, mean_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, state_space
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import FAST, filter_state_space
from softgrip.gripper.synchronization import synchronization_error
from softgrip.units import DEG

TARGET = project(PRINTED, [np.pi / 3] * 2).reached
MATRICES = controller_matrices(PRINTED, mean_inverse(PRINTED), filter_state_space(*FAST))
LOOP = InternalModelController(MATRICES, TARGET)


def test_noise_gain_is_that_of_the_spectrum():
    """Without mismatch noise enters by the filter alone, and the plant follows it: Parseval."""
    system = state_space(PRINTED)
    plant = control.ss(*cont2discrete((system.A, system.B, system.C, system.D), 0.1))
    ahead = filtered_inverse(mean_inverse(PRINTED), filter_state_space(*FAST))
    back = control.ss(*cont2discrete((ahead.A, ahead.B, ahead.C, ahead.D), 0.1, "bilinear"))
    z = np.exp(1j * np.pi * (np.arange(4000) + 0.5) / 4000)
    power = np.sum(np.abs(back(z)[0]) ** 2, axis=0) * np.abs(plant(z)[:, 0]) ** 2
    expected = np.sqrt(power.mean(axis=1))
    assert noise_gain(PRINTED, LOOP.matrices) == pytest.approx(expected, rel=1e-4)


def test_noise_of_a_run_is_the_noise_gain():
    run = run_gripper(PRINTED, LOOP, duration=400.0, noise=2 * DEG, points=1)
    late = run.angles[:, 100:]
    found = np.sqrt(np.mean((late - TARGET[:, None]) ** 2, axis=1)) / DEG
    # Some 400 independent values: 4 % for one standard deviation.
    assert found == pytest.approx(2 * noise_gain(PRINTED, LOOP.matrices), rel=0.12)
    assert np.all(found > 0.5)  # printed: within 0.5 deg


def test_a_push_on_one_finger_is_shared_out_and_not_removed():
    """One pump: the mean of what the fingers ask for is met, half of the push stays on the left."""
    run = run_gripper(PRINTED, LOOP, duration=15.0, push=lambda t: (0.2, 0.0), points=2)
    error = run.angles[:, -1] - TARGET
    assert error == pytest.approx([0.1, -0.1 * 3.61 / 3.06], abs=1e-4)


def test_a_push_along_the_image_is_removed():
    along = 0.1 * TARGET
    run = run_gripper(PRINTED, LOOP, duration=15.0, push=lambda t: along, points=2)
    assert run.angles[:, -1] == pytest.approx(TARGET, abs=1e-4)


def test_a_push_that_ends_is_forgotten():
    run = run_gripper(
        PRINTED, LOOP, duration=15.0, push=lambda t: (0.2 if t < 5 else 0, 0), points=2
    )
    assert run.angles[:, -1] == pytest.approx(TARGET, abs=1e-4)


def test_the_command_asks_for_more_than_the_motor_has_and_for_044_units_in_all():
    run = run_gripper(PRINTED, LOOP, duration=10.0)
    # By hand: the pump moves until gain / stiffness times its way is the angle.
    assert run.commands.sum() * 0.1 == pytest.approx(TARGET[0] * 3.61 / 7.831, rel=1e-3)
    assert np.abs(run.commands).max() > 5 * 2 * np.pi


def test_fingers_are_apart_on_the_way_and_together_in_the_end():
    run = run_gripper(PRINTED, LOOP, duration=6.0)
    apart = synchronization_error(run.angles, TARGET) / DEG
    assert apart.max() == pytest.approx(7.3, abs=0.1)
    assert apart[-1] < 0.01


def test_a_late_command_is_late():
    runs = [run_gripper(PRINTED, LOOP, duration=1.0, delay_samples=d) for d in (0, 2)]
    assert runs[1].commands[:2] == pytest.approx(0)
    assert runs[1].commands[2] == pytest.approx(runs[0].commands[0])


def test_real_fingers_do_as_the_model_and_an_error_of_it():
    """Eq. (6.21): ``P u + Delta P u`` in two stages, Delta_i = P-tilde_i / P_i - 1 of order two."""
    real = ((2.9, 3.4, 7.5), (2.3, 3.2, 8.0))
    gripper = Gripper(tuple(FingerDynamics(*numbers) for numbers in real))
    run = run_gripper(gripper, LOOP, duration=3.0)
    held = np.append(np.repeat(run.commands, 20), run.commands[-1])
    # Held commands are ramps of the pump: linear between the points, as the solver takes them.
    pumped = np.cumsum(np.insert(held[:-1] * 0.005, 0, 0.0))
    for k, (finger, (damping, stiffness, gain)) in enumerate(
        zip(PRINTED.fingers, real, strict=True)
    ):
        own = np.array([1, finger.damping, finger.stiffness])
        model = control.tf(finger.gain, own)
        ratio = control.tf(gain / finger.gain * own, [1, damping, stiffness])
        y = control.forced_response(model, run.time, pumped).outputs
        error = control.forced_response(ratio - 1, run.time, y).outputs
        # The second stage takes y as linear between points of 5 ms.
        assert y + error == pytest.approx(run.angles[k], abs=1e-4)


def test_impossible_runs_are_refused():
    with pytest.raises(InvalidInputError, match="noise"):
        run_gripper(PRINTED, LOOP, duration=1.0, noise=-1.0)
