"""Glover and McFarlane's design against its own theorem and known cases."""

import control
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.gripper.loop_shaping import coprime_margin, glover_mcfarlane, least_gamma

FREQUENCY = np.geomspace(1e-3, 1e4, 3000)
PLANTS = {
    "finger and pump": control.tf([5.0], [1, 2.5, 3.2, 0]),
    "unstable": control.tf([1.0], [1, -1]),
    "direct term": control.tf([2.0, 1.0], [1, 3]),
    "unstable, direct term": control.tf([1.0, 1.0], [1, -2]),
}


@pytest.mark.parametrize("gain", [0.5, 2.0, 4.8])
def test_an_integrator_has_gamma_of_root_two(gain):
    assert least_gamma(control.ss(0, 1, gain, 0)) == pytest.approx(2**0.5)


def test_gamma_of_a_lag_by_hand():
    """For 1/(s + 1): x^2 + 2 x = 1, x = sqrt 2 - 1, and gamma^2 = 1 + x^2."""
    found = least_gamma(control.ss(-1, 1, 1, 0))
    assert found**2 == pytest.approx(1 + (2**0.5 - 1) ** 2)


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS)
@pytest.mark.parametrize("factor", [1.02, 1.1, 1.5])
def test_the_loop_keeps_within_gamma_and_none_does_better(plant, factor):
    """The norm of [I; K] S [I, G] lies between least gamma and the factor times it."""
    design = glover_mcfarlane(control.ss(plant), factor=factor)
    s = 1j * FREQUENCY
    G, L = design.shape(s).ravel(), design.loop(s).ravel()
    norm = np.sqrt((1 + np.abs(L / G) ** 2) * (1 + np.abs(G) ** 2)) / np.abs(1 + L)
    assert design.gamma * (1 - 1e-3) <= norm.max() <= factor * design.gamma * (1 + 1e-3)
    assert design.complementary.poles().real.max() < 0


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS)
def test_margin_by_the_norm_is_that_of_the_frequency_response(plant):
    design = glover_mcfarlane(control.ss(plant))
    s = 1j * FREQUENCY
    G, K = plant(s), design.controller(s)
    gain = np.sqrt((1 + np.abs(K) ** 2) * (1 + np.abs(G) ** 2)) / np.abs(1 + G * K)
    assert coprime_margin(plant, design.controller) == pytest.approx(1 / gain.max(), rel=1e-4)


def test_no_controller_has_a_larger_margin_than_the_bound():
    random, plant = np.random.default_rng(6), PLANTS["finger and pump"]
    bound = 1 / least_gamma(control.ss(plant))
    margins = []
    for gain, zero, pole in np.exp(random.uniform(-3, 4, (200, 3))):
        margins.append(coprime_margin(plant, control.tf([gain, gain * zero], [1, pole])))
    assert 0.5 * bound < max(margins) <= bound
    assert min(margins) == 0  # some of them are unstable


def test_an_unstable_or_ill_posed_loop_has_no_margin():
    lag = control.tf([1.0], [1, 1])
    assert coprime_margin(lag, control.tf([-2.0], [1])) == 0
    assert coprime_margin(control.tf([1.0, 0], [1, 1]), control.tf([-1.0], [1])) == 0


def test_complementary_sensitivity_is_one_at_rest():
    design = glover_mcfarlane(control.ss(PLANTS["finger and pump"]))
    assert design.complementary(1e-9).item() == pytest.approx(1, abs=1e-6)


def test_impossible_designs_are_refused():
    with pytest.raises(InvalidInputError, match="factor"):
        glover_mcfarlane(control.ss(0, 1, 1, 0), factor=1.0)
    with pytest.raises(InvalidInputError, match="continuous"):
        glover_mcfarlane(control.ss(0, 1, 1, 0, 0.1))
