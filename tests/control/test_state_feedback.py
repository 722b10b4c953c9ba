"""The sampled regulators: with differentiator, with observer, with true states."""

import numpy as np
import pytest

from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.limited_lqr import best_within_limit, limited_loop
from softgrip.control.loop import SPEED_LIMIT, run_loop
from softgrip.control.lqr import Weights, input_gain, lqr_gain, step_response
from softgrip.control.minimum_time import minimum_settling_time
from softgrip.control.state_feedback import ObserverFeedback, StateFeedback
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.errors import InvalidInputError
from softgrip.units import DEG

FINGER, PUMP_GAIN = SecondOrder(2.86, 0.7, 1.5e-4), 980.0
FULL, SCALE = full_state_space(FINGER, PUMP_GAIN), input_gain(FINGER, PUMP_GAIN, SPEED_LIMIT)
GAIN = lqr_gain(FINGER, Weights())
REGULATORS = {
    "robust": lambda: StateFeedback(GAIN, SCALE, RobustDifferentiator(10.0)),
    "fit": lambda: StateFeedback(GAIN, SCALE, PolynomialDifferentiator(24)),
    "observer": lambda: ObserverFeedback(GAIN, FINGER, SCALE),
}


def run(name, step, duration):
    plant = StateSpacePlant(FULL)
    return run_loop(plant, REGULATORS[name](), step, duration=duration, limit=SPEED_LIMIT)


def test_without_a_limit_the_sampled_loop_is_the_linear_one():
    found = limited_loop(FINGER, PUMP_GAIN, GAIN, 0.5, limit=np.inf)
    time, exact = step_response(FINGER, Weights())
    # A hold of 25 ms is a delay of half of it: at a slope of 0.25 rad/s some 3 mrad.
    np.testing.assert_allclose(found.measured, 0.5 * np.interp(found.time, time, exact), atol=5e-3)


def test_first_command_is_the_first_gain_times_the_step():
    found = limited_loop(FINGER, PUMP_GAIN, GAIN, 0.5)
    assert found.command[0] / SPEED_LIMIT == pytest.approx(10 * 0.5 / SCALE, rel=1e-5)
    assert np.max(np.abs(limited_loop(FINGER, PUMP_GAIN, GAIN, 50.0).command)) == SPEED_LIMIT


@pytest.mark.parametrize("name", REGULATORS)
def test_every_regulator_comes_to_the_reference(name):
    found = run(name, 1.0, 12.0)
    # The explicit scheme leaves errors of jerk times 25 ms in the acceleration, noise or not.
    np.testing.assert_allclose(found.measured[-40:], 1.0, atol=0.03)


def test_observer_with_a_true_model_and_no_noise_has_the_true_states():
    found = run("observer", 1.5, 6.0)
    true = limited_loop(FINGER, PUMP_GAIN, GAIN, 1.5)
    np.testing.assert_allclose(found.measured, true.measured, atol=1e-5)


def noisy_swing(regulator, runs=100):
    """Root mean square of the true angle about its reference when at rest, each run's, rad."""
    plant = StateSpacePlant(FULL, initial=np.zeros((3, runs)), noise=2 * DEG, seed=1)
    measured, kept = plant.advance(0.0, 0.0), []
    for _ in range(600):
        speed = np.clip(regulator.update(1.0, measured), -SPEED_LIMIT, SPEED_LIMIT)
        measured = plant.advance(speed, 0.025)
        kept.append(plant.state[1])
    return np.sqrt(np.mean((np.array(kept)[300:] - 1.0) ** 2, axis=0))


def test_in_noise_the_observer_beats_the_fit_and_the_fit_the_robust_one():
    swing = {name: np.median(noisy_swing(make())) for name, make in REGULATORS.items()}
    assert swing["observer"] < swing["fit"] < swing["robust"] < 3 * DEG


def test_jerk_below_that_of_the_motion_loses_the_loop():
    # The linear response has up to 10 rad/s^3, the motor at full speed makes 38.
    lost = [
        np.mean(noisy_swing(StateFeedback(GAIN, SCALE, RobustDifferentiator(jerk))) > 10 * DEG)
        for jerk in (2.0, 5.0, 10.0, 40.0)
    ]
    assert lost[0] > 0.9 > lost[1] > 0.1
    assert lost[2:] == [0, 0]


def test_observer_forgets_a_wrong_start():
    plant = StateSpacePlant(FULL, initial=[2000.0, 0.3, 0.0])
    found = run_loop(plant, REGULATORS["observer"](), 1.0, duration=12.0, limit=SPEED_LIMIT)
    assert found.measured[-1] == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("name", REGULATORS)
def test_batch_of_steps_is_each_step(name):
    steps = np.array([0.3, 1.0])
    plant = StateSpacePlant(FULL, initial=np.zeros((3, 2)))
    batch = run_loop(plant, REGULATORS[name](), lambda _: steps, duration=2.0, limit=SPEED_LIMIT)
    for k, step in enumerate(steps):
        one = run(name, float(step), 2.0)
        np.testing.assert_allclose(batch.measured[k], one.measured, atol=1e-6)


def test_map_of_gains_is_each_gain():
    gains = np.stack([GAIN, 0.5 * GAIN], axis=-1)
    batch = limited_loop(FINGER, PUMP_GAIN, gains, 0.8)
    for k in range(2):
        one = limited_loop(FINGER, PUMP_GAIN, gains[:, k], 0.8)
        np.testing.assert_allclose(batch.measured[k], one.measured, atol=1e-6)


def test_best_weights_come_near_the_bound_and_not_below_it():
    steps = np.array([20, 60]) * DEG
    model = SecondOrder(1.65, 0.86, 1.49e-4)
    for step, best in zip(steps, best_within_limit(model, PUMP_GAIN, steps, 0.05), strict=True):
        bound = minimum_settling_time(
            full_state_space(model, PUMP_GAIN), step, SPEED_LIMIT, band=0.05 * step
        )
        # The crossing is interpolated between two samples, the bound is a sample.
        assert bound - 0.025 <= best.time < bound + 0.1
        again = limited_loop(model, PUMP_GAIN, lqr_gain(model, best.weights), step)
        assert settling_time(again.time, again.measured, final=step, band=0.05) == pytest.approx(
            best.time, abs=1e-6
        )


@pytest.mark.parametrize("gain", [[1.0, 2.0], [1.0, np.nan, 0.0], 3.0])
def test_gains_of_another_shape_are_refused(gain):
    with pytest.raises(InvalidInputError, match="gain"):
        StateFeedback(gain, 1.0, RobustDifferentiator(1.0))
    with pytest.raises(InvalidInputError, match="gain"):
        ObserverFeedback(gain, FINGER, 1.0)


def test_scales_out_of_range_are_refused():
    with pytest.raises(InvalidInputError):
        StateFeedback(GAIN, 0.0, RobustDifferentiator(1.0))
    with pytest.raises(InvalidInputError):
        ObserverFeedback(GAIN, FINGER, 1.0, noise=0.0)


def test_linear_form_gives_the_commands_of_the_updates():
    def regulator():
        return ObserverFeedback(lqr_gain(FINGER, Weights()), FINGER, 2.0, limit=1e6, period=0.1)

    system, one = regulator().linear(), regulator()
    angles = 1e-2 * np.random.default_rng(1).standard_normal(40)
    state, linear = np.zeros((3, 1)), []
    for y in angles:
        linear.append((system.C @ state + system.D * y).item())
        state = system.A @ state + system.B * y
    # Updates round to the digits in which commands are sent.
    assert [float(one.update(0.0, y)) for y in angles] == pytest.approx(linear, abs=1e-5)
    assert np.abs(linear).max() > 0.01
