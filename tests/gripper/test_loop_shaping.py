"""Glover and McFarlane's design against its own theorem and known cases."""

import control
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.gripper import loop_shaping
from softgrip.gripper.loop_shaping import target_loop
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space

FREQUENCY = np.geomspace(1e-3, 1e4, 3000)


@pytest.mark.parametrize("gain", [0.5, 2.0, 4.8])
def test_an_integrator_has_gamma_of_root_two(gain):
    assert loop_shaping.glover_mcfarlane(control.ss(0, 1, gain, 0)).gamma == pytest.approx(2**0.5)


def test_gamma_of_a_lag_by_hand():
    """For 1/(s + 1): x^2 + 2 x = 1, x = sqrt 2 - 1, and gamma^2 = 1 + x^2."""
    found = loop_shaping.glover_mcfarlane(control.ss(-1, 1, 1, 0)).gamma
    assert found**2 == pytest.approx(1 + (2**0.5 - 1) ** 2)


@pytest.mark.parametrize("factor", [1.02, 1.1, 1.5])
def test_the_loop_keeps_within_gamma_and_none_does_better(factor):
    """The norm of [I; K] S [I, G] lies between least gamma and the factor times it."""
    design = loop_shaping.glover_mcfarlane(target_loop(4.8, 20.0), factor=factor)
    s = 1j * FREQUENCY
    G, L = design.shape(s).ravel(), design.loop(s).ravel()
    norm = np.sqrt((1 + np.abs(L / G) ** 2) * (1 + np.abs(G) ** 2)) / np.abs(1 + L)
    assert design.gamma * (1 - 1e-3) <= norm.max() <= factor * design.gamma * (1 + 1e-3)
    assert design.complementary.poles().real.max() < 0


def test_complementary_sensitivity_is_one_at_rest():
    design = loop_shaping.glover_mcfarlane(target_loop(2.0, 10.0))
    assert design.complementary(1e-9).item() == pytest.approx(1, abs=1e-6)


def test_target_loop_is_what_it_says():
    s = 1j * np.geomspace(0.1, 100, 20)
    expected = 4.8 / s * (15 / (s + 15)) ** 2
    assert target_loop(4.8, 15.0)(s).ravel() == pytest.approx(expected)


@pytest.mark.parametrize(("crossover", "printed", "inside"), [(4.8, FAST, 0.3), (2.0, SLOW, 0.2)])
def test_the_printed_filters_are_met_in_shape_and_not_in_numbers(crossover, printed, inside):
    """Near within the bandwidth, not beyond: the print has another weight or method."""
    low, w = filter_state_space(*printed), np.geomspace(0.1, 100, 100)
    _, design = loop_shaping.fit_roll_off(crossover, low, w)
    gap = np.abs(loop_shaping.magnitude_gap(design.complementary, low, w))
    assert gap[w < crossover].max() < inside
    assert gap.max() > 0.2


def test_impossible_designs_are_refused():
    with pytest.raises(InvalidInputError, match="factor"):
        loop_shaping.glover_mcfarlane(target_loop(2.0, 10.0), factor=1.0)
    with pytest.raises(InvalidInputError, match="crossover"):
        target_loop(0.0, 10.0)
