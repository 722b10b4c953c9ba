"""No p reaches the printed time: the signs of the proof against poles by the Riccati equation."""

from math import log

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from softgrip.control.lqr import FINGER, Weights, closed_loop, linear_settling_time
from softgrip.control.lqr_bound import (
    certificate,
    closed_loop_poles,
    settling_at_the_bound,
    settling_floor,
)
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError

fingers = st.builds(SecondOrder, st.floats(0.5, 10), st.floats(0.05, 2.5))
ratios = st.floats(0.02, 2)
powers = st.floats(-2, 6)


def best_settling(weights, band):
    """Return the least settling time over ten decades of p, four trials each, and its p."""
    tried = 10 ** np.linspace(-1, 9, 41)
    return min((linear_settling_time(FINGER, Weights(p, weights.q), band), p) for p in tried)


@given(fingers, powers, ratios)
def test_where_the_signs_prove_it_a_real_pole_is_above_the_bound(finger, power, q2):
    weights = Weights(10**power, (1.0, q2, 0.0))
    found = certificate(finger, weights)
    assume(found.proves)
    poles = closed_loop(finger, weights).poles()
    # Rounding turns a double real pole into a pair with an imaginary part of 1e-8 of its size.
    real = poles.real[np.abs(poles.imag) < 1e-6 * np.abs(poles)]
    assert np.any((real > found.pole_bound * (1 + 1e-6)) & (real < 0))


@given(st.floats(0.5, 10), st.floats(0, 0.999), powers, ratios)
def test_signs_prove_it_for_every_p_below_critical_damping(frequency, damping, power, q2):
    finger = SecondOrder(frequency, damping)
    assert certificate(finger, Weights(10**power, (1.0, q2, 0.0))).proves


def test_signs_are_those_of_the_polynomials():
    finger, weights = SecondOrder(2.0, 0.5), Weights(7.0, (1.0, 0.25, 0.0), 2.0)
    found = certificate(finger, weights)

    def open_loop(s):
        return s * (s * s + 2 * 0.5 * 2.0 * s + 4.0)

    assert found.pole_bound == -2.0
    assert found.at_origin == pytest.approx(3.5)
    assert found.at_bound == pytest.approx(open_loop(2.0) * open_loop(-2.0))


def test_beyond_critical_damping_the_proof_can_fail_and_says_so():
    # Open-loop poles at -0.27 and -3.73 rad/s, the bound between them.
    assert not certificate(SecondOrder(1.0, 2.0), Weights()).proves


def test_printed_pole_and_its_bound():
    assert certificate(FINGER, Weights()).pole_bound == pytest.approx(-1.826, abs=5e-4)
    assert closed_loop_poles(FINGER, Weights())[0] == pytest.approx(-1.0087, abs=1e-4)
    assert closed_loop_poles(FINGER, Weights(p=1e12))[0].real == pytest.approx(-1.8257, abs=1e-4)


@given(powers, st.floats(0.55, 0.86), st.floats(1, 6), ratios)
def test_floor_needs_and_has_a_damped_pair(power, damping, frequency, q2):
    finger, weights = SecondOrder(frequency, damping), Weights(10**power, (1.0, q2, 0.0))
    try:
        settling_floor(finger, weights, 0.1)
    except InvalidInputError:
        assume(False)
    pair = closed_loop_poles(finger, weights)[1]
    assert -pair.real / abs(pair) >= 0.5 - 1e-6


@settings(max_examples=40)
@given(st.floats(-1, 6), st.sampled_from([0.02, 0.05, 0.1]))
def test_nothing_settles_before_the_floor_and_the_floor_is_above_the_print(power, band):
    weights = Weights(p=10**power)
    floor = settling_floor(FINGER, weights, band)
    assert floor > 0.8
    assert linear_settling_time(FINGER, weights, band) > floor


@pytest.mark.parametrize("band", [0.02, 0.1])
def test_best_p_is_the_largest_and_comes_near_the_pole_alone(band):
    (time, p), limit = best_settling(Weights(), band), settling_at_the_bound(Weights(), band)
    assert limit == pytest.approx(log(1 / band) / 1.82574, rel=1e-4)
    assert limit < time < 1.02 * limit
    assert p > 1e8


def test_without_a_weight_on_the_rate_more_p_is_ever_faster():
    # Butterworth's pattern grows with p^(1/6): nothing holds it back.
    assert best_settling(Weights(q=(1.0, 0.0, 0.0)), 0.02)[0] < 0.3


@pytest.mark.parametrize("q", [(1.0, 0.0, 0.0), (1.0, 0.3, 0.1)])
def test_no_proof_without_the_weights_for_it(q):
    with pytest.raises(InvalidInputError):
        certificate(FINGER, Weights(q=q))


def test_no_floor_for_a_finger_that_swings():
    with pytest.raises(InvalidInputError):
        settling_floor(SecondOrder(2.86, 0.2), Weights(), 0.02)
