"""Closed forms of the reaction curves, and the judgement of a step, against those of a record."""

import numpy as np
import pytest

from softgrip.control.designs import unit_step
from softgrip.control.ziegler_nichols import integrating_reaction_curve, reaction_curve
from softgrip.dynamics.second_order import SecondOrder, full_state_space, state_space
from softgrip.logs.steps import judge_step
from softgrip.twin.finger_loops import actuator_curve, full_curve, pid_on_models, settled
from softgrip.twin.identification import SecondOrders
from softgrip.twin.laboratory import Laboratory
from softgrip.twin.space import values
from softgrip.units import DEG


@pytest.mark.parametrize("damping", [0.3, 0.86, 1.0, 1.5])
def test_reaction_curves_are_those_of_the_step_responses(damping):
    finger = SecondOrder(1.65, damping, 1.5e-4)
    known = reaction_curve(*unit_step(state_space(finger)))
    found = actuator_curve(finger)
    # The record's slopes are those between 20001 samples.
    assert (found.delay, found.slope) == pytest.approx((known.delay, known.slope), rel=1e-4)
    known = integrating_reaction_curve(*unit_step(full_state_space(finger, 840.0)))
    found = full_curve(finger, 840.0)
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
