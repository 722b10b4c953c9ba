"""Effective number of rows, intervals, and combinations."""

import numpy as np
import pytest
from scipy.signal import lfilter

from softgrip.errors import InvalidInputError
from softgrip.simulator.fit_combinations import told_together
from softgrip.simulator.fit_estimates import Inferred, estimate
from softgrip.simulator.free_parameters import Parameter
from softgrip.simulator.inference import correlated, infer
from softgrip.simulator.trial import read_trial
from tests.simulator.rigs import design_1, printed_gripper
from tests.simulator.test_fit_problem import at, problem, shortened
from tests.simulator.test_trial import STEP


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.8])
def test_rows_of_a_first_order_process(memory):
    white = np.random.default_rng(5).standard_normal(20000)
    rows = correlated(lfilter([1.0], [1.0, -memory], white))
    # Its autocorrelation is memory**lag: 1 + 2 sum is this; the sum ends in chance.
    assert rows == pytest.approx((1 + memory) / (1 - memory), rel=0.1)


def test_a_channel_without_residuals():
    assert correlated(np.zeros(50)) == 1.0


@pytest.mark.parametrize(
    ("scale", "value", "deviation", "low", "high", "told"),
    [
        ("log", 2.0, 0.1, 2 * np.exp(-0.16449), 2 * np.exp(0.16449), True),
        ("log", 2.0, 0.4, 2 * np.exp(-0.65796), 2 * np.exp(0.65796), False),
        ("linear", 2.0, 0.5, 1.17755, 2.82245, True),
        ("linear", 2.0, 1.0, 0.3551, 3.6449, False),
        ("linear", 0.0, 1.0, 0.0, 1.6449, False),
        ("linear", 9.5, 0.5, 8.67755, 10.0, True),
    ],
)
def test_an_interval_and_whether_it_tells(scale, value, deviation, low, high, told):
    parameter = Parameter("finger.x", 0.1 if scale == "log" else 0.0, 10.0, scale, "an example")
    found = estimate(parameter, value, deviation)
    assert (found.low, found.high) == pytest.approx((low, high))
    assert (found.value, found.told) == (value, told)


def test_what_is_told_of_two_but_not_of_one():
    one = problem(design_1(), shortened(STEP, 40))
    names = [p.name for p in one.space]
    stiffness, torque = names.index("finger.stiffness"), names.index("finger.torque_per_pressure")
    covariance = np.diag(one.deviation**2)
    # Both alike to a factor of two, and their ratio to 2 %.
    covariance[np.ix_([stiffness, torque], [stiffness, torque])] = 0.48 + 0.0002 * np.eye(2)
    rig = design_1()
    found = Inferred(one, at(one, rig), covariance, (), ())
    (told,) = told_together(found)
    assert told.name == "finger.stiffness / finger.torque_per_pressure"
    assert told.value == pytest.approx(rig.finger.stiffness / rig.finger.torque_per_pressure)
    assert told.high / told.low == pytest.approx(np.exp(2 * 1.6449 * 0.02))
    assert not found.estimates[stiffness].told


def test_logs_of_other_fingers_than_the_rig():
    with pytest.raises(InvalidInputError, match=r"logs of 2 finger\(s\), got \[1\]"):
        infer([read_trial(STEP)], printed_gripper())
    with pytest.raises(InvalidInputError, match="trials"):
        infer([], design_1())
