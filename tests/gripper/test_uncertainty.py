"""Eq. (6.13) and (6.18): deviations, weights that bound them, and the excited band."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import PRINTED, FingerDynamics
from softgrip.gripper.robustness import box
from softgrip.gripper.uncertainty import (
    bounding_weight,
    deviation,
    excited_band,
    finger_response,
    parameter_bounds,
)

W = np.geomspace(0.1, 100, 120)


def family(points=3):
    nominal = PRINTED.fingers[0]
    return nominal, [gripper.fingers[0] for gripper in box(PRINTED, points=points)]


def test_deviation_of_a_single_finger_by_hand():
    """Eq. (6.18): far down only the stiffness counts, 1 / 1.059 - 1 and 1 / 0.941 - 1."""
    nominal, fingers = family()
    found = deviation([finger_response(f, 1e-4) for f in fingers], finger_response(nominal, 1e-4))
    assert found == pytest.approx(1 / 0.941 - 1, rel=1e-3)


def test_the_corners_of_the_box_are_its_worst():
    at = {}
    for points in (2, 5):
        nominal, fingers = family(points)
        at[points] = deviation(
            [finger_response(f, W) for f in fingers], finger_response(nominal, W)
        )
    assert at[2] == pytest.approx(at[5])


@pytest.mark.parametrize("order", [1, 2])
def test_weight_bounds_its_samples_and_is_stable_and_minimum_phase(order):
    nominal, fingers = family()
    bound = deviation([finger_response(f, W) for f in fingers], finger_response(nominal, W))
    weight = bounding_weight(W, bound, order=order)
    assert np.all(np.abs(weight(1j * W)).ravel() >= bound * (1 - 1e-6))
    assert weight.poles().real.max() < 0
    inverse_poles = np.linalg.eigvals(weight.A - weight.B @ weight.C / weight.D)
    assert inverse_poles.real.max() < 0
    if order == 2:  # one hump: two poles follow it closely
        assert np.all(np.abs(weight(1j * W)).ravel() <= 1.06 * bound)


@settings(max_examples=8)
@example(0.334, 1.0, 1.0)  # which is a gain alone
@given(st.floats(0.05, 0.5), st.floats(1, 5), st.floats(1, 30))
def test_weight_finds_a_lag_lead_again(low, rise, corner):
    """A bound that is itself the gain of a first-order weight is met exactly."""
    bound = low * np.abs((rise * 1j * W + corner) / (1j * W + corner))
    found = bounding_weight(W, bound, order=1)
    assert np.abs(found(1j * W)).ravel() == pytest.approx(bound, rel=1e-2)


def test_excited_band_of_two_tones():
    t = 0.01 * np.arange(2000)
    command = np.sin(6 * np.pi * t) + 0.5 * np.sin(20 * np.pi * t) + 0.1 * np.sin(60 * np.pi * t)
    assert excited_band(command, 0.01, share=0.4) == pytest.approx((6 * np.pi, 20 * np.pi))


def test_the_printed_band_reaches_beyond_what_100_ms_can_show():
    """63 rad/s is 10 Hz: the sampling rate itself, where the half of it is the most to be seen."""
    random = np.random.default_rng(0).normal(size=1000)
    assert excited_band(random, 0.1, share=0.01)[1] <= np.pi / 0.1 < 63


def test_parameter_bounds_are_about_the_mean():
    """Eq. (6.13) by hand."""
    fingers = [FingerDynamics(a, b, 1.0) for a, b in ((2.0, 3.0), (2.2, 3.3), (2.7, 3.0))]
    assert parameter_bounds(fingers) == pytest.approx((2.7 / 2.3 - 1, 3.3 / 3.1 - 1))


def test_impossible_input_is_refused():
    with pytest.raises(InvalidInputError, match="bound"):
        bounding_weight(W, np.zeros_like(W))
