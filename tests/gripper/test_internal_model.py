"""Figure 6.3 against its blocks run one by one."""

import control
import numpy as np
import pytest
from scipy.signal import cont2discrete

from softgrip.errors import InvalidInputError
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import filtered_inverse, mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, state_space
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space, low_pass

TARGET = np.array([0.95, 1.12])
REAL = Gripper((FingerDynamics(2.9, 3.4, 7.5), FingerDynamics(2.3, 3.2, 8.0)))
H, OTHER = filter_state_space(*FAST), filter_state_space(*SLOW)
PRINTED_LOOP = controller_matrices(PRINTED, mean_inverse(PRINTED), H)


class Block:
    """A sampled state space, one step after the other."""

    def __init__(self, system, method):
        self.A, self.B, self.C, self.D, _ = cont2discrete(
            (system.A, system.B, system.C, system.D), 0.1, method
        )
        self.x = np.zeros(len(self.A))

    def output(self, u):
        return self.C @ self.x + self.D @ np.atleast_1d(u)

    def step(self, u):
        self.x = self.A @ self.x + self.B @ np.atleast_1d(u)


def blocks(inverse, ahead, back, *, limit=np.inf, delay=0, samples=30):
    """The diagram: u_c = u_ff - u_fb, y_delta = y - P u_c, on other fingers than the model's."""
    plant, model = Block(state_space(REAL), "zoh"), Block(state_space(PRINTED), "zoh")
    u_ff = Block(filtered_inverse(inverse, ahead), "bilinear")
    u_fb = Block(filtered_inverse(inverse, back), "bilinear")
    late, sent = [0.0] * delay, []
    for _ in range(samples):
        y_delta = plant.output(0) - model.output(0)
        u = float(np.clip(u_ff.output(TARGET) - u_fb.output(y_delta), -limit, limit).item())
        late.append(u)
        u_ff.step(TARGET)
        u_fb.step(y_delta)
        plant.step(u)
        model.step(late.pop(0))
        sent.append(u)
    return np.array(sent)


def run(controller, samples=30):
    plant, sent = Block(state_space(REAL), "zoh"), []
    for _ in range(samples):
        u = controller.update(plant.output(0))
        plant.step(u)
        sent.append(float(u))
    return np.array(sent)


@pytest.mark.parametrize("make", [mean_inverse, moore_penrose_inverse])
@pytest.mark.parametrize(
    ("back", "conditions"),
    [(None, {}), (OTHER, {}), (None, {"limit": 20.0}), (OTHER, {"delay": 2})],
)
def test_controller_is_the_block_diagram(make, back, conditions):
    delay, limit = conditions.get("delay", 0), conditions.get("limit", np.inf)
    matrices = controller_matrices(
        PRINTED, make(PRINTED), H, feedback_filter=back, delay_samples=delay
    )
    found = run(InternalModelController(matrices, TARGET, limit=limit))
    expected = blocks(make(PRINTED), H, back or H, **conditions)
    assert found == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_linear_matrices_give_the_same_commands():
    whole, plant = PRINTED_LOOP.linear(), Block(state_space(REAL), "zoh")
    x, found = np.zeros(whole.nstates), []
    for _ in range(20):
        inputs = np.concatenate([plant.output(0), TARGET])
        u = whole.C @ x + whole.D @ inputs
        x = whole.A @ x + whole.B @ inputs
        plant.step(u)
        found.append(u.item())
    controller = InternalModelController(PRINTED_LOOP, TARGET)
    assert found == pytest.approx(run(controller, 20))


def test_feedback_makes_up_for_an_error_within_the_image():
    """Eq. (6.23) where H is 1: both fingers a fifth stronger than the model, Delta_P = 0.2."""
    linear = PRINTED_LOOP.linear()
    z = np.exp(1e-3j * 0.1)  # 0.001 rad/s
    to_command = linear(z)
    back, ahead = to_command[:, :2], to_command[:, 2:]
    system = state_space(PRINTED)
    A, B, C, *_ = cont2discrete((system.A, system.B, system.C, system.D), 0.1, "zoh")
    P = C @ np.linalg.solve(z * np.eye(len(A)) - A, B)
    target = project(PRINTED, [1.0, 1.0]).reached
    # From targets and angles to u; without an error of the model u is u_ff.
    nominal = (ahead @ target / (1 - back @ P)[0, 0]).item()
    command = (ahead @ target / (1 - 1.2 * back @ P)[0, 0]).item()
    u_fb = nominal - command
    left, right = P[:, 0] * u_fb, 0.2 * P[:, 0] * (nominal - u_fb)
    # H is 1 but for 0.001 rad/s over its crossover of 4.8 rad/s.
    assert np.abs(left - right).max() < 1e-3 * np.abs(left).max()
    assert nominal / command == pytest.approx(1.2, rel=1e-3)


def test_a_batch_is_its_runs():
    angles = np.random.default_rng(0).normal(size=(8, 2, 3))
    together = InternalModelController(PRINTED_LOOP, TARGET, limit=30)
    found = np.array([together.update(y) for y in angles])
    assert found.shape == (8, 3)
    for k in range(3):
        together.reset()
        assert [together.update(y[:, k]) for y in angles] == pytest.approx(found[:, k])


def test_without_mismatch_it_is_the_feedforward_alone():
    """At 1 ms the sampled loop is near the continuous P H P-dagger."""
    target = project(PRINTED, [1.0, 1.0]).reached
    low = low_pass(5.0)
    matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), low, period=1e-3)
    controller = InternalModelController(matrices, target)
    found = run_gripper(PRINTED, controller, duration=2.0, points=1)
    ahead = filtered_inverse(mean_inverse(PRINTED), low)
    whole = control.series(ahead, state_space(PRINTED))
    inputs = np.repeat(target[:, None], found.time.size, axis=1)
    expected = control.forced_response(whole, found.time, inputs, squeeze=False).outputs
    # A held command is half a period late.
    assert found.angles == pytest.approx(np.asarray(expected), abs=5e-3)


def test_a_held_input_rule_misses_the_target_and_the_bilinear_one_does_not():
    target = project(PRINTED, [1.0, 1.0]).reached
    ends = {}
    for method in ("bilinear", "zoh"):
        matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), H, method=method)
        controller = InternalModelController(matrices, target)
        ends[method] = run_gripper(PRINTED, controller, duration=10.0).angles[0, -1] / target[0]
    assert ends["bilinear"] == pytest.approx(1, abs=1e-3)
    assert ends["zoh"] > 10


def test_a_model_that_knows_the_limit_never_makes_up_for_what_was_cut():
    target = project(PRINTED, [1.0, 1.0]).reached
    ends = []
    for known in (5.0, np.inf):
        controller = InternalModelController(PRINTED_LOOP, target, limit=known)
        run = run_gripper(PRINTED, controller, duration=12.0, limit=5.0)
        ends.append(run.angles[0, -1] / target[0])
    assert ends[0] < 0.5
    assert ends[1] == pytest.approx(1, abs=1e-3)


def test_impossible_arguments_are_refused():
    with pytest.raises(InvalidInputError, match="shape"):
        InternalModelController(PRINTED_LOOP, [1.0])
    with pytest.raises(InvalidInputError, match="delay"):
        controller_matrices(PRINTED, mean_inverse(PRINTED), H, delay_samples=-1)
    with pytest.raises(InvalidInputError, match="measured"):
        InternalModelController(PRINTED_LOOP, TARGET).update(np.zeros(3))
