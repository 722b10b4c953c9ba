"""Eq. (4.11)-(4.15): poles, step response, sampled response, state spaces."""

from itertools import pairwise

import control
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from softgrip.dynamics.second_order import (
    SecondOrder,
    full_state_space,
    response,
    state_space,
    step_response,
    upper_pole,
)
from softgrip.errors import InvalidInputError

TIME = np.linspace(0, 6, 121)
frequencies = st.floats(0.1, 50)
dampings = st.floats(0, 20)


def test_printed_poles_of_design_1():
    # Chapter 3 prints -1.99 +- 2.04j for 2.86 rad/s; 0.7 is printed to one digit only.
    a, b = SecondOrder(2.86, 0.7).rates
    assert a == b.conjugate()
    assert a.real == pytest.approx(1.99, abs=2.86 * 0.05)
    assert abs(a.imag) == pytest.approx(2.04, abs=0.005)


@given(frequency=frequencies, damping=dampings)
def test_rates_are_minus_the_roots_of_the_equation(frequency, damping):
    a, b = SecondOrder(frequency, damping).rates
    assert a + b == pytest.approx(2 * damping * frequency)
    assert a * b == pytest.approx(frequency**2)


@given(frequency=frequencies, damping=dampings)
def test_upper_pole_is_minus_the_fast_rate(frequency, damping):
    fast, _ = SecondOrder(frequency, damping).rates
    real, imaginary = upper_pole(frequency, damping)
    # Near a double pole the root of a difference keeps half of the digits.
    assert (real, imaginary) == pytest.approx((-fast.real, abs(fast.imag)), rel=1e-7, abs=1e-6)


@given(frequency=frequencies, damping=dampings)
def test_rates_lead_back_to_the_system(frequency, damping):
    system = SecondOrder(frequency, damping, 3.0)
    again = SecondOrder.from_rates(*system.rates, gain=3.0)
    assert again.natural_frequency == pytest.approx(frequency, rel=1e-9)
    assert again.damping_ratio == pytest.approx(damping, rel=1e-9, abs=1e-9)
    assert again.gain == 3.0


@pytest.mark.parametrize(("a", "b"), [(1.0, 4.0), (2.0, 2.0), (2 + 3j, 2 - 3j)])
def test_system_of_given_rates_solves_the_equation_with_their_sum_and_product(a, b):
    """Eq. (4.12), integrated for a force of ``a b M_eq``."""
    total, product = (a + b).real, (a * b).real
    solved = solve_ivp(
        lambda _t, y: [y[1], product * (1 - y[0]) - total * y[1]],
        *((0, 6), [0, 0]),
        t_eval=TIME,
        rtol=1e-10,
        atol=1e-12,
    )
    found = SecondOrder.from_rates(a, b)
    response = step_response(TIME, found.natural_frequency, found.damping_ratio)
    np.testing.assert_allclose(response, solved.y[0], atol=1e-8)


def test_small_rate_of_a_strongly_damped_system_keeps_its_digits():
    # zeta - sqrt(zeta**2 - 1) taken as it stands is 0 here.
    slow = SecondOrder(1.0, 1e9).rates[1]
    assert slow == pytest.approx(0.5e-9, rel=1e-12)


@pytest.mark.parametrize(
    "rates", [(1, -2), (-1, -2), (1 + 1j, 1 + 1j), (1 + 1j, 2 - 1j), (0, 1), (1, np.nan)]
)
def test_rates_that_are_no_stable_real_system(rates):
    with pytest.raises(InvalidInputError, match="conjugate pair"):
        SecondOrder.from_rates(*rates)


@pytest.mark.parametrize("parameters", [(0, 0.7), (np.nan, 0.7), (2, -0.1), (2, 0.7, 0)])
def test_parameters_out_of_range(parameters):
    with pytest.raises(InvalidInputError):
        SecondOrder(*parameters)


def test_step_response_when_underdamped():
    # The textbook form with damped frequency and phase.
    w, z = 2.86, 0.7
    damped, phase = w * np.sqrt(1 - z**2), np.arccos(z)
    expected = 1 - np.exp(-z * w * TIME) * np.sin(damped * TIME + phase) / np.sqrt(1 - z**2)
    np.testing.assert_allclose(step_response(TIME, w, z), expected, atol=1e-12)


def test_step_response_when_critically_damped():
    expected = 1 - np.exp(-2 * TIME) * (1 + 2 * TIME)
    np.testing.assert_allclose(step_response(TIME, 2.0, 1.0), expected, atol=1e-12)


def test_step_response_when_overdamped():
    """Eq. (4.11) with a = 1, b = 4: C_0 = 1, C_1 = -b / (b - a), C_2 = a / (b - a)."""
    expected = 1 - 4 / 3 * np.exp(-TIME) + 1 / 3 * np.exp(-4 * TIME)
    np.testing.assert_allclose(step_response(TIME, 2.0, 1.25), expected, atol=1e-12)


def test_step_response_passes_smoothly_through_critical_damping():
    near = step_response(TIME, 2.0, np.array([[1 - 1e-9], [1 + 1e-9], [1 - 1e-14]]))
    np.testing.assert_allclose(near, np.tile(step_response(TIME, 2.0, 1.0), (3, 1)), atol=1e-8)


def test_step_response_without_damping_swings_for_ever():
    np.testing.assert_allclose(step_response(TIME, 2.0, 0.0), 1 - np.cos(2 * TIME), atol=1e-12)


def test_step_response_overshoot_of_the_finger():
    # exp(-pi zeta / sqrt(1 - zeta**2)) is 4.6 % for 0.7.
    peak = step_response(np.pi / (2.86 * np.sqrt(0.51)), 2.86, 0.7)
    assert peak - 1 == pytest.approx(np.exp(-np.pi * 0.7 / np.sqrt(0.51)))


def test_negative_time_is_refused():
    with pytest.raises(InvalidInputError):
        step_response(-1.0, 1.0, 1.0)


def test_parameters_broadcast_over_runs():
    frequency, damping = np.array([[1.0], [2.0]]), np.array([[0.5], [1.5]])
    both = step_response(TIME, frequency, damping)
    np.testing.assert_array_equal(both[1], step_response(TIME, 2.0, 1.5))


@pytest.mark.parametrize("damping", [0.0, 0.3, 1.0, 3.0])
@pytest.mark.parametrize("hold", ["linear", "zero"])
def test_sampled_response_agrees_with_an_integrator(damping, hold):
    """Eq. (4.13) under a pressure that is held or ramps between samples."""
    rng = np.random.default_rng(2)
    t = np.cumsum(rng.uniform(0.02, 0.3, 30))
    p = rng.normal(size=30)

    def pressure(now):
        if hold == "linear":
            return np.interp(now, t, p)
        return p[np.searchsorted(t, now, side="right") - 1]

    y, angle = np.array([2.0 * 0.4, 0.0]), [2.0 * 0.4]
    for start, end in pairwise(t):
        # One call an interval: the solver must not step over the kinks.
        def slope(now, y, last=end - 1e-12):
            u = pressure(min(now, last))
            return [y[1], 9 * (2.0 * u - y[0]) - 6 * damping * y[1]]

        y = solve_ivp(slope, (start, end), y, rtol=1e-9, atol=1e-11).y[:, -1]
        angle.append(y[0])
    found = response(SecondOrder(3.0, damping, 2.0), t, p, initial_pressure=0.4, hold=hold)
    np.testing.assert_allclose(found, angle, atol=1e-7)


def test_sampled_response_of_runs_is_that_of_each():
    p = np.random.default_rng(3).normal(size=(4, TIME.size))
    system = SecondOrder(3.0, 0.4, 2.0)
    runs = response(system, TIME, p)
    for run, pressure in zip(runs, p, strict=True):
        np.testing.assert_allclose(run, response(system, TIME, pressure), atol=1e-12)


def test_sampled_response_to_a_held_step_is_the_closed_form():
    found = response(SecondOrder(3.0, 0.4, 2.0), TIME, np.ones_like(TIME), initial_pressure=0.0)
    np.testing.assert_allclose(found, 2.0 * step_response(TIME, 3.0, 0.4), atol=1e-12)


@pytest.mark.parametrize(
    ("time", "pressure", "hold"),
    [
        ([0, 1], [1, 2, 3], "zero"),
        ([0], [1], "zero"),
        ([0, 0], [1, 2], "zero"),
        ([0, 1], [1, 2], ""),
    ],
)
def test_sampled_response_refuses(time, pressure, hold):
    with pytest.raises(InvalidInputError):
        response(SecondOrder(1, 1), time, pressure, hold=hold)


def test_state_space_has_the_poles_and_the_static_gain():
    """Eq. (4.14): and so it has the step response in closed form."""
    finger = SecondOrder(2.86, 0.7, 2.4e-5)
    system = state_space(finger)
    np.testing.assert_allclose(np.sort(system.poles()), np.sort(-np.array(finger.rates)))
    assert system.dcgain() == pytest.approx(2.4e-5)
    found = control.forced_response(system, TIME, np.full_like(TIME, 1e5)).outputs
    np.testing.assert_allclose(found, 2.4 * step_response(TIME, 2.86, 0.7), atol=1e-9)


@given(frequency=frequencies, damping=dampings, pump=st.floats(1e2, 1e5), s=st.floats(0.1, 30))
def test_full_model_is_the_product_of_pump_and_finger(frequency, damping, pump, s):
    """Eq. (4.15) without the motor speed, which is the input."""
    assume(abs(s - frequency) > 1e-3)
    finger = SecondOrder(frequency, damping, 2.4e-5)
    denominator = (1j * s) ** 3 + 2 * damping * frequency * (1j * s) ** 2 + frequency**2 * 1j * s
    expected = pump * 2.4e-5 * frequency**2 / denominator
    assert complex(full_state_space(finger, pump)(1j * s)) == pytest.approx(expected, rel=1e-6)


def test_full_model_carries_pressure_in_pascal():
    system = full_state_space(SecondOrder(2.86, 0.7, 2.4e-5), 3000.0)
    states = control.forced_response(system, TIME, np.full_like(TIME, 10.0)).states
    np.testing.assert_allclose(states[0], 3e4 * TIME, rtol=1e-9, atol=1e-6)
    assert system.state_labels == ["pressure", "angle", "rate"]


@pytest.mark.parametrize("pump_gain", [0.0, -1.0, np.inf])
def test_full_model_needs_a_pump(pump_gain):
    with pytest.raises(InvalidInputError, match="pump_gain"):
        full_state_space(SecondOrder(1, 1), pump_gain)
