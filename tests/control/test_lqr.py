"""The regulator of Section 3.4 against hand calculation, spectral factors, and its own cost."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import solve_continuous_lyapunov
from scipy.optimize import brentq

from softgrip.control import lqr
from softgrip.control.lqr import FINGER, Weights, canonical_form, closed_loop, lqr_gain
from softgrip.control.lqr_bound import closed_loop_poles
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.errors import InvalidInputError
from softgrip.pump.flow import Pump
from softgrip.pump.pressure import pressure_system

fingers = st.builds(SecondOrder, st.floats(0.5, 10), st.floats(0.05, 2))
designs = st.builds(
    lambda p, q2, q3, r: Weights(10**p, (1.0, q2, q3), r),
    st.floats(-1, 5),
    st.floats(0, 1),
    st.floats(0, 0.1),
    st.floats(0.1, 10),
)


def characteristic(finger, weights):
    loop = closed_loop(finger, weights)
    return np.real(np.poly(loop.poles()))


@given(fingers, designs)
def test_riccati_and_spectral_factor_give_one_polynomial(finger, weights):
    # Coefficients, not poles: those of a double pole are known to half the digits only.
    factor = np.real(np.poly(closed_loop_poles(finger, weights)))
    np.testing.assert_allclose(characteristic(finger, weights), factor, rtol=1e-5)


@given(fingers, designs)
def test_first_gain_is_the_root_of_the_weight(finger, weights):
    # The constant term of phi(s) phi(-s) is K_1^2 = p q_1 / R.
    assert lqr_gain(finger, weights)[0] == pytest.approx((weights.p / weights.R) ** 0.5, rel=1e-5)


def test_printed_gain_by_hand():
    """Eq. (3.30): phi = s^3 + (4.004 + k3) s^2 + (8.1796 + k2) s + 10 is the spectral factor."""
    k1, k2, k3 = lqr_gain(FINGER, Weights())
    a, b, c = 2 * 0.7 * 2.86 + k3, 2.86**2 + k2, k1
    assert c == pytest.approx(10)
    # phi(s) phi(-s), s^4 and s^2: a^2 - 2 b = (4 z^2 - 2) w^2, b^2 - 2 a c = w^4 + 30.
    assert a * a - 2 * b == pytest.approx((4 * 0.49 - 2) * 2.86**2)
    assert b * b - 2 * a * c == pytest.approx(2.86**4 + 30)


def test_no_other_gain_costs_less():
    finger, weights = FINGER, Weights()
    plant, best = canonical_form(finger), lqr_gain(finger, weights)
    start = np.array([1.0, -0.5, 2.0])

    def cost(gain):
        A = plant.A - plant.B @ gain[None, :]
        Y = solve_continuous_lyapunov(A.T, -(weights.Q + weights.R * np.outer(gain, gain)))
        return float(start @ Y @ start)

    rng = np.random.default_rng(0)
    least = cost(best)
    assert all(cost(best * (1 + 0.05 * rng.standard_normal(3))) > least for _ in range(50))


@given(fingers, st.floats(0.1, 50))
def test_a_gain_in_the_input_is_a_larger_p(finger, gain):
    plant = canonical_form(finger)
    moved, _, _ = control.lqr(plant.A, gain * plant.B, Weights().Q, 1.0)
    np.testing.assert_allclose(
        gain * moved[0], lqr_gain(finger, Weights(p=100 * gain**2)), rtol=1e-5
    )


@pytest.mark.parametrize(("band", "time"), [(0.02, 4.284), (0.05, 3.376), (0.1, 2.670)])
def test_printed_weights_do_not_settle_in_the_printed_time(band, time):
    # By partial fractions, without a time grid; the last crossing lies beyond 2 s.
    poles = closed_loop_poles(FINGER, Weights())
    shares = [
        np.prod(-np.delete(poles, k) / (p - np.delete(poles, k))) for k, p in enumerate(poles)
    ]

    def left(t):
        return abs(np.real(np.sum(shares * np.exp(poles * t)))) - band

    assert brentq(left, 2, 8) == pytest.approx(time, abs=1e-3)
    assert all(left(t) < 0 for t in np.linspace(time + 0.01, 20, 500))
    assert lqr.linear_settling_time(FINGER, Weights(), band) == pytest.approx(time, abs=1e-3)


def test_a_tenth_of_the_rate_weight_and_a_larger_p_do():
    assert lqr.linear_settling_time(FINGER, Weights(30_000.0, (1.0, 0.03, 0.0)), 0.02) < 0.8


@settings(max_examples=30)
@given(fingers, designs)
def test_linear_loop_leaves_no_error(finger, weights):
    assert lqr.step_response(finger, weights)[1][-1] == pytest.approx(1, abs=1e-3)


def test_canonical_form_is_the_full_model_in_other_states():
    """Eq. (3.26) and (3.27) with Eq. (3.28) do as the model of pump, angle and rate does."""
    finger, pump_gain, speed = SecondOrder(2.86, 0.7, 1.5e-4), 980.0, 31.4
    full, gain = full_state_space(finger, pump_gain), lqr.input_gain(finger, pump_gain, speed)
    T = lqr.derivatives_from_full_state(finger)
    other = canonical_form(finger, gain)
    np.testing.assert_allclose(T @ full.A @ np.linalg.inv(T), other.A, atol=1e-9)
    np.testing.assert_allclose(T @ full.B * speed / gain, other.B, atol=1e-12)
    np.testing.assert_allclose(full.C, other.C @ T / gain, atol=1e-12)
    for s in (0.3j, 2j, 1 + 5j):
        assert speed * full(s) == pytest.approx(other(s))


def test_numerator_by_hand():
    """Eq. (3.25) with l = 8 mm, A_s = 6.61 cm^2, C_s = 1 mL/kPa, 5 rev/s and c / M = 1e-3."""
    finger = SecondOrder(2.86, 0.7, gain=1e-3 / 2.86**2)
    pump = pressure_system(Pump(6.61e-4, 0.008), 1e-9)
    found = lqr.input_gain(finger, pump.B.item(), 10 * np.pi)
    assert found == pytest.approx(0.008 * 6.61e-4 * 5 / 1e-9 * 1e-3)
    s = 0.4 + 1.5j
    printed = found / (s**3 + 2 * 0.7 * 2.86 * s**2 + 2.86**2 * s)
    assert canonical_form(finger, found)(s) == pytest.approx(printed)


def test_printed_weights():
    """Eq. (3.29) with p = 100: a rate of 1 rad/s costs three tenths of 1 rad, acceleration none."""
    Q = Weights().Q
    np.testing.assert_array_equal(Q, [[100, 0, 0], [0, 30, 0], [0, 0, 0]])
    for state, cost in (((1, 0, 0), 100), ((0, 1, 0), 30), ((0, 0, 9), 0)):
        assert np.array(state) @ Q @ np.array(state) == pytest.approx(cost)


def test_mapping_gives_the_derivatives_of_a_motion():
    # Rate and acceleration of a simulated angle, by differences.
    finger = SecondOrder(2.0, 0.4, 1e-4)
    time = np.linspace(0, 2, 20001)
    found = control.forced_response(
        full_state_space(finger, 900.0), time, np.ones((1, time.size)), squeeze=False
    )
    angle, rate, acceleration = lqr.derivatives_from_full_state(finger) @ found.states.reshape(
        3, -1
    )
    np.testing.assert_allclose(np.gradient(angle, time)[1:-1], rate[1:-1], atol=1e-6)
    np.testing.assert_allclose(np.gradient(rate, time)[1:-1], acceleration[1:-1], atol=1e-5)


@pytest.mark.parametrize(
    "options", [{"p": 0.0}, {"R": -1.0}, {"q": (0.0, 1.0, 0.0)}, {"q": (1.0, -1.0, 0.0)}]
)
def test_weights_out_of_range(options):
    with pytest.raises(InvalidInputError):
        Weights(**options)
