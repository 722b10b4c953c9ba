"""The prefilter's rule, and the polynomials of systems."""

import control
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import PRINTED, finger_state_space
from softgrip.gripper.prefilter import polynomials, prefilter

PLANTS = {
    "lag": (control.tf([1.0], [1, 1]), 3.0),
    "lag, slow": (control.tf([1.0], [1, 1]), 0.3),
    "unstable": (control.tf([2.0], [1, -1]), 3.0),
    "direct term": (control.tf([2.0, 1.0], [1, 3]), 1.0),
    "three lags": (control.ss(control.tf([6.0], [1, 6, 11, 6])), 1.0),
}


@pytest.mark.parametrize("crossover", [2.0, 4.8])
def test_a_finger_with_its_pump_gets_a_constant(crossover):
    """It falls faster than c / s on both sides, so nothing is asked for but the crossover."""
    plant = finger_state_space(PRINTED.mean)
    found = prefilter(plant, crossover)
    assert found.poles().size == 0
    assert found(1j) * abs(plant(1j * crossover).item()) == pytest.approx(1)


@pytest.mark.parametrize(("plant", "crossover"), PLANTS.values(), ids=PLANTS)
def test_the_rule_holds_on_both_sides_of_the_crossover(plant, crossover):
    W = prefilter(plant, crossover)
    w = crossover * np.geomspace(1e-3, 1e3, 301)
    gain, target = np.abs(plant(1j * w) * W(1j * w)).ravel(), crossover / w
    # The fit of the gain has an error of 0.05 RMS in its logarithm.
    assert np.all(gain[w < crossover] > 0.8 * target[w < crossover])
    assert np.all(gain[w > crossover] < 1.2 * target[w > crossover])
    assert abs(plant(1j * crossover) * W(1j * crossover)) == pytest.approx(1)
    assert W.poles().real.max() < 0
    assert W.zeros().real.max() < 0


@pytest.mark.parametrize("degree", [0, 1, 2, 3])
def test_polynomials_of_a_realization_are_those_it_was_made_of(degree):
    top, low = np.poly(-np.arange(1.0, degree + 1)) * -7.8, np.poly([-300, -2 + 1j, -2 - 1j])
    found = polynomials(control.ss(control.tf(top, low)))
    assert found[0] == pytest.approx(np.atleast_1d(top), rel=1e-6)
    assert found[1] == pytest.approx(low.real, rel=1e-6)


@pytest.mark.parametrize(
    ("system", "message"),
    [
        (control.ss([[0.0]], [[1.0, 1.0]], [[1.0]], [[0.0, 0.0]]), "one input"),
        (control.ss(0, 1, 1, 0, 0.1), "continuous"),
        (control.tf([1.0, 0, 0], [1, 1]), "proper"),
        (control.tf([0.0], [1, 1]), "not 0"),
        (control.ss(-1, 0, 1, 0), "not 0"),
    ],
)
def test_systems_that_cannot_be_shaped_are_refused(system, message):
    with pytest.raises(InvalidInputError, match=message):
        prefilter(system, 1.0)


def test_a_crossover_where_the_plant_is_silent_is_refused():
    with pytest.raises(InvalidInputError, match="gain_at_the_crossover"):
        prefilter(control.tf([1.0, 0, 4], [1, 2, 3, 4]), 2.0)
