"""Settling time, overshoot, rise time and steady-state error, against closed forms."""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.step_metrics import (
    final_value,
    overshoot,
    rise_time,
    settling_time,
    step_metrics,
)
from softgrip.dynamics.second_order import step_response
from softgrip.errors import InvalidInputError

TIME = np.arange(0, 10, 0.001)
LAG = 1 - np.exp(-TIME)


@pytest.mark.parametrize("band", [0.02, 0.05, 0.1])
def test_first_order_settles_after_the_logarithm_of_the_band(band):
    assert settling_time(TIME, LAG, final=1.0, band=band) == pytest.approx(-np.log(band), abs=1e-5)


def test_first_order_rises_in_log_9():
    assert rise_time(TIME, LAG, target=1.0) == pytest.approx(np.log(9), abs=1e-5)


@pytest.mark.parametrize("damping", [0.3, 0.5, 0.7])
def test_second_order_overshoot(damping):
    y = step_response(TIME, 2.86, damping)
    expected = np.exp(-np.pi * damping / np.sqrt(1 - damping**2))
    assert overshoot(y, target=1.0) == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("damping", [0.2, 0.7, 1.3])
def test_agrees_with_the_control_library(damping):
    system = control.ss([[0, 1], [-4, -4 * damping]], [[0], [4]], [[1, 0]], 0)
    info = control.step_info(system, T=np.arange(0, 30, 0.001))
    t = np.arange(0, 30, 0.001)
    found = step_metrics(t, step_response(t, 2.0, damping), target=1.0)
    # The library gives a sample, not the crossing between two.
    assert found.settling_time == pytest.approx(info["SettlingTime"], abs=2e-3)
    assert found.rise_time == pytest.approx(info["RiseTime"], abs=2e-3)
    assert 100 * found.overshoot == pytest.approx(info["Overshoot"], abs=1e-3)


@given(scale=st.floats(0.01, 100), shift=st.floats(-10, 10), sign=st.sampled_from([-1, 1]))
def test_measures_do_not_depend_on_where_and_how_far(scale, shift, sign):
    y = step_response(TIME[::10], 2.86, 0.5)
    change = sign * scale
    one = step_metrics(TIME[::10], y, target=1.0)
    other = step_metrics(TIME[::10], shift + change * y, target=shift + change, initial=shift)
    assert other.settling_time == pytest.approx(float(one.settling_time), abs=1e-6)
    assert other.overshoot == pytest.approx(float(one.overshoot), abs=1e-9)
    assert other.rise_time == pytest.approx(float(one.rise_time), abs=1e-6)
    assert other.steady_state_error == pytest.approx(change * float(one.steady_state_error))


def test_absolute_band_is_in_the_unit_of_the_output():
    found = settling_time(TIME, 50 * LAG, final=50.0, band=1.0, absolute=True)
    assert found == settling_time(TIME, 50 * LAG, final=50.0, band=0.02)


def test_response_that_keeps_an_error_settles_about_its_own_end_only():
    y = 0.9 * LAG
    assert settling_time(TIME, y, final=1.0, band=0.05) == np.inf
    end = final_value(TIME, y)
    assert settling_time(TIME, y, final=end, band=0.05) == pytest.approx(np.log(20), abs=1e-2)
    assert step_metrics(TIME, y, target=1.0).steady_state_error == pytest.approx(0.1, abs=1e-4)


def test_late_excursion_counts():
    y = np.where(np.abs(TIME - 7.0) < 0.1, 0.5, LAG)
    assert settling_time(TIME, y, final=1.0) == pytest.approx(7.1, abs=2e-3)


def test_never_outside_never_settled_not_a_number():
    runs = np.array([np.ones_like(TIME), np.sin(9 * TIME), np.where(TIME == 2, np.nan, LAG)])
    found = settling_time(TIME, runs, final=1.0)
    np.testing.assert_array_equal(found, [0.0, np.inf, np.nan])


def test_rise_not_reached_and_no_change():
    assert rise_time(TIME, 0.5 * LAG, target=1.0) == np.inf
    assert np.isnan(rise_time(TIME, LAG, target=0.0))
    assert np.isnan(overshoot(LAG, target=0.0))


def test_no_overshoot_is_zero():
    assert overshoot(LAG, target=1.0) == 0


def test_runs_with_their_own_targets():
    targets = np.array([1.0, -2.0, 30.0])
    runs = step_metrics(TIME, targets[:, None] * LAG, target=targets)
    one = step_metrics(TIME, LAG, target=1.0)
    assert runs.settling_time == pytest.approx(np.full(3, float(one.settling_time)))
    assert runs.rise_time.shape == runs.overshoot.shape == (3,)


@pytest.mark.parametrize(
    ("time", "output"), [([0, 1], [1, 2, 3]), ([0], [1]), ([0, 0], [1, 1]), ([1, 0], [1, 1])]
)
def test_records_that_are_none(time, output):
    with pytest.raises(InvalidInputError):
        settling_time(time, output, final=1.0)


def test_options_out_of_range():
    with pytest.raises(InvalidInputError, match="band"):
        settling_time(TIME, LAG, final=1.0, band=0.0)
    with pytest.raises(InvalidInputError, match="start"):
        rise_time(TIME, LAG, target=1.0, start=0.9, end=0.1)
