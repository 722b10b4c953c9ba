"""Tuning: finds optima that are known, never loses ground, runs the same twice."""

import control
import numpy as np
import pytest

from softgrip.control.loop import SPEED_LIMIT, LoopResult, run_loop
from softgrip.control.pid import PID, Gains
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.tuning import LOST, Itae, tune
from softgrip.control.ziegler_nichols import ReactionCurve, ziegler_nichols
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.errors import InvalidInputError

FULL = full_state_space(SecondOrder(2.86, 0.7, 2.4e-5), 3600.0)
START = ziegler_nichols(ReactionCurve(1.4 / 2.86, 2.4e-5 * 3600.0))
T = np.linspace(0, 5, 501)


def on_the_full_model(gains):
    pid = PID(gains, limits=(-SPEED_LIMIT, SPEED_LIMIT))
    return run_loop(StateSpacePlant(FULL), pid, 1.0, duration=5.0, limit=SPEED_LIMIT)


def bowl(gains):
    """A made-up loop whose error is least for kp = 3, ki = 0.2, kd = 5."""
    ratios = np.array([gains.kp, gains.ki, gains.kd]) / [3, 0.2, 5]
    miss = np.sum(np.log(ratios) ** 2)
    y = 1 - np.exp(-T) * (1 + miss)
    return LoopResult(T, np.ones_like(T), y, np.zeros_like(T))


def test_finds_the_bottom_of_a_bowl():
    # Its own start, measured[0], moves with the gains: judge by the error alone.
    found = tune(bowl, Gains(1.0, 1.0, 1.0), lambda r: float(np.mean(np.abs(1 - r.measured))))
    assert found.converged
    # The simplex ends at 0.003 in the logarithm.
    assert (found.gains.kp, found.gains.ki, found.gains.kd) == pytest.approx((3, 0.2, 5), rel=0.02)


def test_itae_of_a_lag_is_one():
    y = 1 - np.exp(-np.linspace(0, 30, 30001))
    result = LoopResult(np.linspace(0, 30, 30001), np.ones(30001), y, np.zeros(30001))
    assert Itae()(result) == pytest.approx(1.0, rel=1e-5)
    doubled = LoopResult(result.time, 2 * result.reference, 2 * y, result.command)
    assert Itae()(doubled) == pytest.approx(1.0, rel=1e-5)


def test_weights_count_overshoot_and_effort():
    y = np.minimum(T, 1.0) + np.where(np.abs(T - 2) < 0.001, 0.25, 0.0)
    command = np.where(np.arange(T.size) % 2, 3.0, -3.0)
    result = LoopResult(T, np.ones_like(T), y, command)
    plain = Itae(0.0)(result)
    assert Itae(2.0)(result) - plain == pytest.approx(0.5)
    assert Itae(0.0, 0.5, 6.0)(result) - plain == pytest.approx(0.5)


def test_batch_counts_by_its_mean():
    y = np.stack([1 - np.exp(-T), 1 - np.exp(-2 * T)])
    both = Itae()(LoopResult(T, np.ones_like(T), y, np.zeros_like(y)))
    single = [Itae()(LoopResult(T, np.ones_like(T), run, np.zeros_like(T))) for run in y]
    assert both == pytest.approx(np.mean(single))


def test_tuning_on_the_full_model_gains_on_ziegler_nichols():
    found = tune(on_the_full_model, START, evaluations=150)
    assert found.start == START
    assert found.history.size <= 150
    assert np.all(np.diff(found.history) <= 0)
    assert found.history[0] == Itae()(on_the_full_model(START))
    assert Itae()(on_the_full_model(found.gains)) == pytest.approx(found.history[-1])
    assert found.history[-1] < 0.5 * found.history[0]


def test_tuning_is_deterministic():
    first, second = (tune(on_the_full_model, START, evaluations=20) for _ in range(2))
    assert first.gains == second.gains
    assert first.history.size == 20
    assert not first.converged


def test_gain_of_zero_stays_zero_and_the_sign_stays():
    found = tune(on_the_full_model, Gains(20.0, 0.0, 5.0), evaluations=15)
    assert found.gains.ki == 0
    plant = control.ss([[0]], [[-1]], [[1]], 0)
    reversed_plant = tune(
        lambda g: run_loop(StateSpacePlant(plant), PID(g), 1.0, duration=3),
        Gains(-0.5),
        evaluations=15,
    )
    assert reversed_plant.gains.kp < -0.5


def test_loop_that_runs_away_counts_as_lost():
    def away(gains):
        return LoopResult(T, np.ones_like(T), np.full_like(T, np.nan), np.zeros_like(T))

    found = tune(away, Gains(1.0), lambda r: float(np.mean(r.measured)), evaluations=5)
    assert found.history[-1] == LOST


def test_loop_whose_controller_refuses_what_overflowed_counts_as_lost():
    def away(gains):
        PID(gains).update(1.0, np.inf)

    assert tune(away, Gains(1.0), evaluations=5).history[-1] == LOST


def test_nothing_to_tune():
    with pytest.raises(InvalidInputError, match="other than zero"):
        tune(on_the_full_model, Gains(0.0))


def test_no_step_has_no_itae():
    with pytest.raises(InvalidInputError, match="step"):
        Itae()(LoopResult(T, np.zeros_like(T), np.zeros_like(T), np.zeros_like(T)))
