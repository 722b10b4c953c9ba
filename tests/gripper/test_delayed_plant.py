"""Fingers that answer late: against steps so fine that nothing is exact, and limit cases."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.gripper.delayed_plant import (
    DelayedGripper,
    delayed_direction,
    delayed_model,
    delayed_outside_share,
)
from softgrip.gripper.plant import PRINTED, sampled, state_space
from softgrip.gripper.reach import outside_share

PERIOD = 0.1


def by_small_steps(finger, delay, commands, step=2e-4):
    """Integrate a finger by the midpoint rule, the command late by a delay; angles at samples."""
    pump = angle = rate = 0.0
    found = []
    for k in range(len(commands)):
        found.append(finger.gain * angle)
        for j in range(round(PERIOD / step)):
            since = k * PERIOD + (j + 0.5) * step - delay
            command = commands[int(since / PERIOD)] if since >= 0 else 0.0
            half = step / 2
            push = pump - finger.stiffness * angle - finger.damping * rate
            middle = angle + half * rate, rate + half * push, pump + half * command
            angle += step * middle[1]
            rate += step * (middle[2] - finger.stiffness * middle[0] - finger.damping * middle[1])
            pump += step * command
    return np.array(found)


def answers(model, commands):
    x, found = np.zeros(len(model.A)), []
    for command in commands:
        found.append(model.C @ x)
        x = model.A @ x + model.B * command
    return np.array(found)


@pytest.mark.parametrize("delays", [(0.0, 0.04), (0.13, 0.27), (0.1, 0.3)])
def test_model_is_what_small_steps_give(delays):
    commands = np.random.default_rng(1).normal(size=25)
    found = answers(delayed_model(DelayedGripper(PRINTED, delays), PERIOD), commands)
    for k, finger in enumerate(PRINTED.fingers):
        # The midpoint rule is off by the square of its step.
        assert found[:, k] == pytest.approx(by_small_steps(finger, delays[k], commands), abs=2e-7)
    assert np.abs(found).max() > 0.3


def test_without_delay_it_is_the_sampled_plant():
    A, B, C, _ = sampled(state_space(PRINTED), PERIOD)
    model = delayed_model(DelayedGripper(PRINTED, (0.0, 0.0)), PERIOD)
    assert model.A[:5, :5] == pytest.approx(A, abs=1e-12)
    assert model.B[:5] == pytest.approx(B[:, 0], abs=1e-12)
    assert model.C[:, :5] == pytest.approx(C)


@settings(max_examples=25, deadline=None)
@given(st.floats(0, 0.45), st.integers(1, 4))
def test_a_common_delay_of_periods_more_is_the_same_answer_later(delay, more):
    commands = np.random.default_rng(2).normal(size=30)
    early, late = (
        answers(delayed_model(DelayedGripper(PRINTED, (own, own)), PERIOD), commands)
        for own in (delay, delay + more * PERIOD)
    )
    assert late[more:] == pytest.approx(early[:-more], abs=1e-9)


def test_commands_that_are_kept_besides_change_nothing():
    plant = DelayedGripper(PRINTED, (0.13, 0.02))
    commands = np.random.default_rng(3).normal(size=20)
    few, many = (answers(delayed_model(plant, PERIOD, commands=n), commands) for n in (1, 6))
    assert many == pytest.approx(few, abs=1e-12)


@given(st.floats(0, 1), st.floats(0, 20))
@settings(max_examples=50, deadline=None)
def test_a_common_delay_puts_nothing_out_of_reach(delay, frequency):
    target = [0.9, 1.1]
    late = delayed_outside_share(DelayedGripper(PRINTED, (delay, delay)), target, frequency)
    assert late == pytest.approx(outside_share(PRINTED, target, frequency), abs=1e-9)


def test_a_difference_of_delays_does_and_equal_fingers_say_how_much():
    """Of fingers that are alike, swinging in step, |sin(w difference / 2)| is out of reach."""
    alike = type(PRINTED)((PRINTED.mean, PRINTED.mean))
    w = np.array([0.5, 2.0, 5.0])
    found = delayed_outside_share(DelayedGripper(alike, (0.1, 0.3)), [1.0, 1.0], w)
    assert found == pytest.approx(np.abs(np.sin(w * 0.2 / 2)), abs=1e-12)


def test_direction_is_that_of_the_model_s_own_transfer():
    """By the sampled model at a frequency far below the sampling's, where a hold does little."""
    plant, w, T = DelayedGripper(PRINTED, (0.3, 0.1)), 1.5, 0.002
    model = delayed_model(plant, T)
    z = np.exp(1j * w * T)
    column = model.C @ np.linalg.solve(z * np.eye(len(model.A)) - model.A, model.B)
    ours = delayed_direction(plant, w)
    assert abs(np.vdot(ours, column / np.linalg.norm(column))) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("delays", [(0.1,), (0.1, -0.1), (0.1, np.nan)])
def test_impossible_delays_are_refused(delays):
    with pytest.raises(InvalidInputError, match="delays"):
        DelayedGripper(PRINTED, delays)
