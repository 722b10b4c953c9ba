"""The simulated force layer: limits by hand, memory against its closed form."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.simulator import force_layer
from softgrip.simulator.force_layer import ForceLayer
from softgrip.units import GRAM_FORCE

LAYER = ForceLayer()


def test_resistance_falls_from_one_end_to_the_other():
    ends = 1 / force_layer.conductance(np.array([0.0, 1e3]), 0.0, LAYER)
    assert ends == pytest.approx([20e3, 5e3])
    assert (np.diff(force_layer.conductance(np.linspace(0, 1, 50), 0.0, LAYER)) > 0).all()


def test_bridge_is_balanced_at_rest_and_kirchhoff_holds():
    found = force_layer.bridge_voltage(np.array([1 / 20e3, 1 / 5e3]), LAYER)
    # Two dividers of 5 V: 1.5 k below 5 k against 1.5 k below 20 k.
    assert found == pytest.approx([0, 5 * (1.5 / 6.5 - 1.5 / 21.5)], abs=1e-12)


def test_largest_voltage_leaves_a_fifth_of_the_scale():
    assert force_layer.layer_voltage(np.array([1e3]), 0.0, LAYER)[0] == pytest.approx(4.0, abs=0.05)


def test_a_gram_force_is_about_a_count_at_the_end_of_the_range():
    # What soft_force is calibrated to: a check of the calibration, no finding.
    force = np.array([0.7 - GRAM_FORCE, 0.7])
    counts = np.diff(force_layer.layer_voltage(force, 0.0, LAYER))[0] / 5 * 1023
    assert counts == pytest.approx(1, abs=0.1)


def test_memory_is_that_of_two_lags():
    period, held = 0.05, 0.3
    force = np.full(400, held)
    time = period * np.arange(400)
    lagging = sum(
        part * np.exp(-time / lag) for part, lag in zip(LAYER.memory, LAYER.lag, strict=True)
    )
    np.testing.assert_allclose(
        force_layer.felt_force(force, period, LAYER), held * (1 - lagging), rtol=1e-12
    )


def test_finer_samples_of_a_held_force_change_nothing():
    coarse = force_layer.felt_force(np.repeat([0.1, 0.5, 0.0], 20), 0.1, LAYER)
    fine = force_layer.felt_force(np.repeat([0.1, 0.5, 0.0], 40), 0.05, LAYER)
    np.testing.assert_allclose(fine[::2], coarse, rtol=1e-12, atol=1e-15)


@given(peak=st.floats(0.05, 0.7))
def test_unloading_feels_more_than_loading(peak):
    ramp = np.linspace(0, peak, 100)
    felt = force_layer.felt_force(np.concatenate([ramp, ramp[::-1]]), 0.05, LAYER)
    assert (felt[100:][::-1][1:-1] > felt[:100][1:-1]).all()


def test_without_memory_there_is_no_hysteresis():
    bare = replace(LAYER, memory=(0.0, 0.0))
    force = np.linspace(0, 0.7, 50)
    np.testing.assert_array_equal(force_layer.felt_force(force, 0.05, bare), force)


def test_drift_adds_and_multiplies():
    at_rest, later = (
        force_layer.conductance(np.array([0.2]), 0.0, LAYER),
        force_layer.conductance(np.array([0.2]), 2.0, LAYER),
    )
    assert later / at_rest == pytest.approx(1 + 2 * LAYER.gain_drift)
    only = replace(LAYER, gain_drift=0.0)
    grown = force_layer.layer_voltage(np.array([0.2]), 2.0, only) - force_layer.layer_voltage(
        np.array([0.2]), 0.0, only
    )
    assert grown == pytest.approx(2 * LAYER.offset_drift)


def test_counts_are_whole_cut_and_read_backwards():
    voltage = np.array([-1.0, 0.0, 2.5, 9.0])
    counts = force_layer.read_counts(voltage, np.zeros(4), LAYER)
    assert counts.tolist() == [0, 0, 512, 1023]
    assert abs(force_layer.volts(counts, LAYER)[2] - 2.5) <= 2.5 / 1023
    assert force_layer.volts(counts, LAYER)[3] == 5.0
