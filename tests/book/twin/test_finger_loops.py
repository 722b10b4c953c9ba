"""Closed forms of the reaction curves, and the judgement of a step, against those of a record."""

import numpy as np
import pytest

from book.twin.finger_loops import (
    Models,
    actuator_curve,
    full_curve,
    lags,
    pid_on_models,
    settled,
)
from book.twin.identification import SecondOrders
from book.twin.laboratory import Laboratory
from book.twin.space import values
from softgrip.control.designs import unit_step
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.ziegler_nichols import integrating_reaction_curve, reaction_curve
from softgrip.dynamics.second_order import SecondOrder, full_state_space, state_space
from softgrip.logs.staircase import lag
from softgrip.logs.steps import judge_step
from softgrip.units import DEG


@pytest.mark.parametrize("damping", [0.3, 0.86, 1.0, 1.5])
def test_reaction_curves_are_those_of_the_step_responses(damping):
    finger = SecondOrder(1.65, damping, 1.5e-4)
    many = SecondOrders(*(np.array(x) for x in (1.65, damping, 1.5e-4)))
    known = reaction_curve(*unit_step(state_space(finger)))
    found = actuator_curve(many)
    # The record's slopes are those between 20001 samples.
    assert (found.delay, found.slope) == pytest.approx((known.delay, known.slope), rel=1e-4)
    known = integrating_reaction_curve(*unit_step(full_state_space(finger, 840.0)))
    found = full_curve(many, 840.0)
    # The asymptote is laid on the last quarter of ten time constants.
    assert (found.delay, found.slope) == pytest.approx((known.delay, known.slope), rel=1e-2)


def test_steps_settle_when_the_judge_of_logs_says():
    time = np.arange(0, 10, 0.025)
    chance = np.random.default_rng(1)
    angle = DEG * (60 * (1 - np.exp(-np.outer([0.5, 1.0, 2.0], time)))
                   + 2 * chance.standard_normal((3, time.size)))  # fmt: skip
    found = settled(time, angle, np.full(3, 60 * DEG), np.array([2.0, 5.0, 5.0]) * DEG)
    known = judge_step(time, angle, 60 * DEG)
    assert found[0] == known.settled_2_deg[0]
    assert found[1:] == pytest.approx(known.settled_5_deg[1:])


def test_where_no_model_was_identified_nothing_is_told():
    lab = Laboratory(values(2))
    known = (1.65, 0.86, 1.5e-4)
    lab.__dict__["finger"] = SecondOrders(*(np.array([x, np.nan]) for x in known))
    lab.__dict__["pump_gain"] = np.full(2, 840.0)
    for found in pid_on_models(lab).values():
        assert found[0] > 0
        assert np.isnan(found[1])


@pytest.mark.parametrize("pump_gain", [None, np.array([840.0, 500.0])])
def test_models_are_the_state_spaces_held_over_a_period(pump_gain):
    fingers = [SecondOrder(1.65, 0.86, 1.5e-4), SecondOrder(20.0, 1.5, 2e-5)]
    plant = Models(
        SecondOrders(*np.transpose([list(vars(f).values()) for f in fingers])), pump_gain
    )
    commands = (1.0, 1.0, -3.0, 0.0)
    found = np.array([plant.advance(np.full(2, u), 0.025) for u in commands])
    for k, finger in enumerate(fingers):
        alone = StateSpacePlant(
            state_space(finger) if pump_gain is None else full_state_space(finger, pump_gain[k])
        )
        known = [float(alone.advance(u, 0.025)) for u in commands]
        assert found[:, k] == pytest.approx(known, rel=1e-10)


def test_delays_are_those_of_single_records():
    chance = np.random.default_rng(2)
    stairs = np.repeat([0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0], 100)
    angle = np.stack([3.0 * np.roll(stairs, k) for k in (7, 31, 90)])
    angle += 0.1 * chance.standard_normal(angle.shape)
    assert lags(stairs, angle).tolist() == [lag(3.0 * stairs, y, 0.025) for y in angle]
