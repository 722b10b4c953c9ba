"""Robust stability: the closed form, the poles, and what a run does."""

import control
import numpy as np
import pytest
from scipy.signal import cont2discrete

from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, state_space
from softgrip.gripper.robustness import (
    box,
    continuous_stability,
    sampled_stability,
    structured_gain,
    tolerated_uncertainty,
)
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space

H = filter_state_space(*FAST)
MEAN = mean_inverse(PRINTED)
REST = np.array([1.0, 1.0])


def test_with_the_printed_inverse_it_is_h_times_the_mean_weight():
    w = np.geomspace(0.1, 100, 30)
    weights = np.array([[0.2], [0.5]])
    found = structured_gain(PRINTED, MEAN, H, weights, w)
    assert found == pytest.approx(0.35 * np.abs(H(1j * w)).ravel())


@pytest.mark.parametrize("make", [mean_inverse, moore_penrose_inverse])
def test_it_is_the_least_perturbation_that_can_make_the_loop_singular(make):
    """Eq. (6.17): ``det(I + Delta W P H P-dagger)`` is 0 for the worst phases, not for less."""
    w, inverse = 3.0, make(PRINTED)
    s = 1j * w
    matrix = np.outer(np.ravel(state_space(PRINTED)(s)), inverse(s) * H(s).item()) * 0.5
    gain = structured_gain(PRINTED, inverse, H, np.full((2, 1), 0.5), np.array([w])).item()
    phases = np.exp(2j * np.pi * np.arange(180) / 180)
    smallest = [
        abs(np.linalg.det(np.eye(2) + np.diag([a, b]) / gain @ matrix))
        for a in phases
        for b in phases
    ]
    assert min(smallest) < 0.05
    worst = np.diag(-np.exp(-1j * np.angle(np.diag(matrix)))) / gain
    assert abs(np.linalg.det(np.eye(2) + worst @ matrix)) == pytest.approx(0, abs=1e-9)
    assert abs(np.linalg.det(np.eye(2) + 0.9 * worst @ matrix)) == pytest.approx(0.1)


def test_nominal_poles_are_those_of_filter_plant_and_model():
    found = continuous_stability(PRINTED, PRINTED, MEAN, H)
    expected = np.concatenate([H.poles(), *[state_space(PRINTED).poles()] * 2])
    expected = expected[np.abs(expected) > 1e-9]
    assert np.sort(found.poles.real) == pytest.approx(np.sort(expected.real), abs=1e-5)
    assert found.margin == pytest.approx(2.45 / 2)


def test_poles_with_other_fingers_are_the_roots_of_the_loops_polynomial():
    """Eq. (6.22) with ``u_fb = H P-dagger (y - P u)``: 1 - H + H P-dagger P-tilde = 0, by hand."""
    others = ((2.9, 3.4, 7.5), (2.3, 3.2, 8.0))
    top, low = (np.array(p) for p in FAST)
    model = [np.array([1, f.damping, f.stiffness]) for f in PRINTED.fingers]
    real = [np.array([1, damping, stiffness]) for damping, stiffness, _ in others]
    asked = [
        gain / f.gain / 2 * np.polymul(model[k], real[1 - k])
        for k, (f, (_, _, gain)) in enumerate(zip(PRINTED.fingers, others, strict=True))
    ]
    loop = np.polyadd(
        np.polymul(np.polysub(low, top), np.polymul(*real)), np.polymul(top, np.polyadd(*asked))
    )
    fingers = Gripper(tuple(FingerDynamics(*numbers) for numbers in others))
    found = continuous_stability(PRINTED, fingers, MEAN, H).poles
    # The model's own poles are there too: the inverse has zeros upon them.
    expected = np.concatenate([np.roots(loop), *[np.roots(q) for q in model]])
    assert found.size == expected.size == 14
    for pole in expected:
        assert np.abs(found - pole).min() < 1e-4 * abs(pole)


def test_nominal_sampled_margin_is_the_slowest_pole():
    found = sampled_stability(controller_matrices(PRINTED, MEAN, H), PRINTED)
    assert found.margin == pytest.approx(1 - np.exp(-0.1 * 2.45 / 2), abs=1e-6)


@pytest.mark.parametrize("printed", [FAST, SLOW])
def test_the_loop_is_stable_at_the_corners_of_the_printed_box(printed):
    low = filter_state_space(*printed)
    matrices = controller_matrices(PRINTED, MEAN, low)
    for real in box(PRINTED, points=2):
        assert continuous_stability(PRINTED, real, MEAN, low).stable
        for delay in (0, 1, 2):
            assert sampled_stability(matrices, real, delay_samples=delay).stable


def test_a_held_input_rule_is_not():
    matrices = controller_matrices(PRINTED, MEAN, H, method="zoh")
    margins = [sampled_stability(matrices, real).margin for real in box(PRINTED, points=2)]
    assert min(margins) < 0 < max(margins)


@pytest.mark.parametrize(("period", "delay"), [(0.1, 0), (0.1, 2), (0.2, 2), (0.3, 1)])
def test_poles_tell_what_a_run_does(period, delay):
    real = Gripper((FingerDynamics(2.9, 3.4, 7.831), FingerDynamics(2.2, 3.2, 7.831)))
    matrices = controller_matrices(PRINTED, MEAN, H, period=period)
    stable = sampled_stability(matrices, real, delay_samples=delay).stable
    controller = InternalModelController(matrices, REST)
    found = run_gripper(real, controller, duration=60.0, delay_samples=delay, points=1)
    late = np.abs(np.diff(found.commands[-20:])).max()
    assert stable == bool(late < 1e-2 * np.abs(np.diff(found.commands[:20])).max())


def test_box_has_its_corners():
    found = box(PRINTED, damping=0.1, stiffness=0.2, points=2)
    assert len(found) == 16
    assert {round(g.fingers[1].damping, 9) for g in found} == {2.45 * 0.9, 2.695}
    assert {round(g.fingers[0].stiffness, 9) for g in found} == {2.888, 4.332}


def sampled(gripper):
    system = state_space(gripper)
    return cont2discrete((system.A, system.B, system.C, system.D), 0.1, "zoh")[:3]


def test_tolerated_uncertainty_of_the_scheme_is_that_of_its_filter():
    # With the printed inverse the sum is |H|, here of the bilinear rule's H at 100 ms.
    linear = controller_matrices(PRINTED, MEAN, H).linear()
    feedback = control.ss(linear.A, linear.B[:, :2], linear.C, linear.D[:, :2], 0.1)
    z = np.exp(1j * np.geomspace(1e-3, 3.1, 400))
    A, B, C = sampled(PRINTED)
    column = np.asarray(control.ss(A, B, C, 0, 0.1)(z)).reshape(2, -1)
    ahead = linear.B[:, 2:]
    target = control.ss(linear.A, ahead, linear.C, linear.D[:, 2:], 0.1)
    row = np.asarray(target(z)).reshape(2, -1)
    # u = Q (Y_d - y + P u): from Y_d to u it is Q / (1 - Q P), so Q P = T / (1 + T).
    loop = np.sum(row * column, axis=0)
    parts = row * column / (1 + loop)
    assert tolerated_uncertainty(PRINTED, feedback) == pytest.approx(
        1 / np.abs(parts).sum(axis=0).max(), rel=1e-3
    )


@pytest.mark.parametrize("gain", [0.5, 1.5])
def test_the_worst_error_of_the_tolerated_size_makes_a_loop_singular_and_real_ones_do_not(gain):
    A, B, C = sampled(PRINTED)
    feedback = control.ss([], [], [], [[-0.2 * gain, -0.4 * gain]], 0.1)
    size = tolerated_uncertainty(PRINTED, feedback)
    z = np.exp(1j * np.geomspace(1e-3, np.pi, 2000))
    column = np.asarray(control.ss(A, B, C, 0, 0.1)(z)).reshape(2, -1)
    parts = feedback.D.T * column
    rest = 1 - parts.sum(axis=0)
    k = np.argmax(np.abs(parts).sum(axis=0) / np.abs(rest))
    worst = size * np.exp(-1j * np.angle(parts[:, k])) * np.exp(1j * np.angle(rest[k]))
    assert abs(1 - np.sum(parts[:, k] * (1 + worst))) == pytest.approx(0, abs=1e-9)
    for first in (-0.99, 0.99):
        for second in (-0.99, 0.99):
            gains = np.diag([1 + first * size, 1 + second * size])
            poles = np.linalg.eigvals(A + B @ feedback.D @ gains @ C)
            assert np.abs(poles).max() < 1
