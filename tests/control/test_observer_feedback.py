"""The regulator with an observer: its linear form does what its updates do."""

import numpy as np
import pytest

from softgrip.control.lqr import FINGER, Weights, lqr_gain
from softgrip.control.observer_feedback import ObserverFeedback


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
