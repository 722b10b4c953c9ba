"""The predictive controller: against other solvers, a simulated filter, and wrong delays."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from softgrip.checks import NotFiniteError
from softgrip.errors import InvalidInputError
from softgrip.gripper.box_program import BoxPrograms
from softgrip.gripper.delayed_batch import PredictiveLaws, run_late
from softgrip.gripper.delayed_plant import DelayedGripper, delayed_model
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.predictive import PredictiveController, Weights, predictive_law
from softgrip.gripper.printed_loop import equal_targets

LIMIT = 2.0


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000))
def test_programs_in_a_box_are_those_of_bounded_least_squares(seed):
    rng = np.random.default_rng(seed)
    root, wanted = rng.normal(size=(12, 5)), 3 * rng.normal(size=(4, 12))
    found, _ = BoxPrograms.of(root.T @ root).solve(-wanted @ root, iterations=400)
    for own, goal in zip(found, wanted, strict=True):
        assert own == pytest.approx(lsq_linear(root, goal, bounds=(-1, 1)).x, abs=1e-5)


def test_programs_without_a_minimum_are_refused():
    with pytest.raises(InvalidInputError, match="H"):
        BoxPrograms.of(np.diag([1.0, 0.0]))


def law(delays=(0.2, 0.2), **changed):
    given = {"limit": LIMIT, **changed}
    return predictive_law(DelayedGripper(PRINTED, delays), equal_targets(), **given)


def test_first_command_is_that_of_a_program_written_out_move_by_move():
    """The cost summed over a simulated horizon, made least by another solver."""
    weights = Weights(horizon=0.6, together=20.0, smooth=0.1)
    made = law(weights=weights)
    # From a state on the way: some commands sent, nothing measured.
    loop = PredictiveController(made)
    for _ in range(4):
        loop.update(made.model.C @ loop._predicted)
    x0, last = loop._predicted.copy(), loop._predicted[made.model.last_command]
    goal, moves = equal_targets(), len(made.H)
    steps = moves + made.model.commands

    def residuals(shares_of_limit):
        x, rows = x0.copy(), []
        for k in range(steps):
            command = LIMIT * shares_of_limit[min(k, moves - 1)]
            x = made.model.A @ x + made.model.B * command
            s = made.model.C @ x / goal
            rows += [*(s - 1) / 2**0.5, *(s - s.mean()) * (weights.together / 2) ** 0.5]
        before = np.concatenate([[last / LIMIT], shares_of_limit[:-1]])
        return np.array([*rows, *weights.smooth**0.5 * (shares_of_limit - before)])

    nothing = residuals(np.zeros(moves))
    slopes = np.stack([residuals(own) - nothing for own in np.eye(moves)], axis=1)
    best = lsq_linear(slopes, -nothing, bounds=(-1, 1), tol=1e-14).x
    # What is measured is what is expected: the filter leaves the state as it is.
    assert loop.update(made.model.C @ x0) == pytest.approx(LIMIT * best[0], abs=1e-5)


def test_filter_s_gain_is_what_a_kalman_filter_comes_to():
    made, own = law(), Weights()
    model = made.model
    spread = np.zeros(len(model.A))
    spread[0] = (own.pump_wander * LIMIT * 0.1) ** 2
    for k, finger in enumerate(PRINTED.fingers):
        spread[2 + 2 * k] = (own.rate_wander * 0.1 * equal_targets()[k] / finger.gain) ** 2
    spread[-1] = own.offset_wander**2
    P = np.eye(len(model.A))
    for _ in range(3000):
        K = P @ model.C.T @ np.linalg.inv(model.C @ P @ model.C.T + own.noise**2 * np.eye(2))
        P = model.A @ (P - K @ model.C @ P) @ model.A.T + np.diag(spread)
    assert made.correct == pytest.approx(K, abs=1e-6)


def run(belief, real, noise=0.0, duration=8.0, gripper=PRINTED):
    made = predictive_law(DelayedGripper(PRINTED, belief), equal_targets(), limit=LIMIT)
    errors = noise * np.random.default_rng(0).standard_normal((1, 2, 1, round(duration / 0.1)))
    found = run_late(
        [GripperBatch.of(gripper)], np.array([real]), PredictiveLaws([made]), errors, limit=LIMIT
    )
    return found.angles[0, :, 0] / equal_targets()[:, None], found.commands[0, 0]


def test_a_known_delay_leaves_the_motion_as_it_is_and_makes_it_late():
    late, _ = run((0.3, 0.3), (0.3, 0.3))
    at_once, _ = run((0.0, 0.0), (0.0, 0.0))
    assert late[:, 12:] == pytest.approx(at_once[:, :-12], abs=3e-3)  # iterations, not the law


def test_no_command_keeps_fingers_together_better_than_the_certified_optimum():
    shares, commands = run((0.1, 0.1), (0.1, 0.1))
    out = np.abs(shares - 1).max(axis=0) > 0.05
    settled = 0.025 * (np.flatnonzero(out)[-1] + 1) - 0.1
    target = tuple(equal_targets().tolist())
    program = FeedforwardProgram(PRINTED, target, limit=LIMIT, band=0.05)
    least = program.settled_by(np.ceil(settled * 10) / 10).worst_sync
    apart = np.ptp(shares, axis=0).max()
    assert least - 1e-6 < apart < 2.5 * least
    assert np.abs(commands).max() <= LIMIT


@pytest.mark.parametrize("delay", [0.05, 0.1, 0.2, 0.3])
@pytest.mark.parametrize("wrong", [0.7, 1.3])
def test_it_settles_with_a_delay_that_is_wrong_by_30_per_cent(delay, wrong):
    shares, _ = run((wrong * delay,) * 2, (delay,) * 2)
    assert np.abs(shares[:, -40:] - 1).max() < 0.02


def test_fingers_other_than_the_model_s_end_about_their_targets():
    """Stiffer by a tenth and softer by a tenth: off each other for good, their mean not off."""
    first, second = PRINTED.fingers
    other = type(PRINTED)(
        (type(first)(first.damping, 1.1 * first.stiffness, first.gain),
         type(first)(second.damping, 0.9 * second.stiffness, second.gain))
    )  # fmt: skip
    shares, _ = run((0.2, 0.2), (0.2, 0.2), gripper=other, duration=20.0)
    assert shares[:, -1].mean() == pytest.approx(1, abs=0.01)
    assert np.ptp(shares[:, -1]) > 0.15


def test_one_run_and_many_agree():
    made, noise = law(), 0.03 * np.random.default_rng(4).standard_normal((30, 2))
    one, many = PredictiveController(made), PredictiveController(made)
    plant = delayed_model(DelayedGripper(PRINTED, (0.2, 0.2)), 0.1)
    x = np.zeros(len(plant.A))
    for own in noise:
        y = plant.C @ x + own
        exact, batch = one.update(y), many.update(np.stack([y, y], axis=1))
        # The many are solved by so many rounds; what they send is what their model then knows.
        assert batch == pytest.approx(np.full(2, exact), abs=0.03 * LIMIT)
        x = plant.A @ x + plant.B * exact


def test_broken_measurements_are_refused_and_change_nothing():
    loop = PredictiveController(law())
    loop.update([0.0, 0.0])
    before = loop._predicted.copy()
    with pytest.raises(NotFiniteError):
        loop.update([0.1, np.nan])
    with pytest.raises(InvalidInputError, match="measured"):
        loop.update([0.1, 0.2, 0.3])
    assert np.array_equal(loop._predicted, before)
    with pytest.raises(InvalidInputError, match="target"):
        predictive_law(DelayedGripper(PRINTED, (0.0, 0.0)), [0.5, 0.0], limit=1.0)
