"""The batch integrator: its order, its dense output, and the choice of its step."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from softgrip.arrays import chunks
from softgrip.dynamics.integrate import RungeKutta, hermite_weights, rk4, step_for
from softgrip.dynamics.ludwick import LudwickFinger, derivative
from softgrip.errors import InvalidInputError


def swing(time, state, slope):
    """Two oscillators, 2 and 3 rad/s."""
    slope[0] = state[1]
    slope[1] = -np.array([4.0, 9.0]) * state[0]


START = np.array([[1.0, 1.0], [0.0, 0.0]])


def exact(times):
    return np.cos(np.outer(times, [2.0, 3.0]))


def test_order_is_four_on_a_smooth_law():
    times = np.array([0.0, 2.0])
    off = [abs(rk4(swing, START, times, h)[-1, 0] - exact(times)[-1]).max() for h in (0.01, 0.005)]
    # The next order in the step changes 16 by a few per cent at these steps.
    assert np.log2(off[0] / off[1]) == pytest.approx(4.0, abs=0.1)


def test_dense_output_is_of_order_four_between_the_steps():
    times = np.linspace(0, 2, 1001)
    off = [abs(rk4(swing, START, times, h)[:, 0] - exact(times)).max() for h in (0.05, 0.025)]
    assert np.log2(off[0] / off[1]) == pytest.approx(4.0, abs=0.2)


def test_hermite_is_exact_on_cubics():
    s = np.linspace(0, 1, 11)
    cubic = np.polynomial.Polynomial([1.0, -2.0, 3.0, 0.5])
    slope = cubic.deriv()
    ends = np.array([cubic(0.0), slope(0.0), cubic(1.0), slope(1.0)])
    np.testing.assert_allclose(hermite_weights(s) @ ends, cubic(s), rtol=1e-14)


def test_hermite_error_is_the_textbook_bound():
    # |f''''| h^4 / 384, reached at the middle of a step of a quartic.
    ends = np.array([0.0, 0.0, 1.0, 4.0])
    assert (hermite_weights(np.array([0.5])) @ ends)[0] - 0.5**4 == pytest.approx(-24 / 384)


def test_output_times_need_not_fall_on_steps_nor_fill_every_step():
    times = np.array([0.0, 0.013, 0.4, 1.9, 2.0])
    np.testing.assert_allclose(rk4(swing, START, times, 0.01)[:, 0], exact(times), atol=1e-7)


def test_kept_rows_and_given_array_are_used():
    times = np.linspace(0, 1, 21)
    room = np.empty((21, 1, 2))
    found = rk4(swing, START, times, 0.03, keep=(1,), out=room)
    assert found is room
    whole = rk4(swing, START, times, 0.03)
    np.testing.assert_allclose(found[:, 0], whole[:, 1], rtol=1e-13, atol=1e-15)


def test_advance_ends_where_the_dense_output_ends():
    state = START.copy()
    RungeKutta(swing, (2, 2)).advance(0.0, state, 0.02, 50)
    np.testing.assert_allclose(state, rk4(swing, START, [0.0, 1.0], 0.02)[-1], rtol=1e-12)


@pytest.mark.parametrize("power", [1.2, 1.5, 2.365])
def test_order_falls_where_a_fractional_power_crosses_zero(power):
    # Released from one side the finger swings through zero, where |theta|^n has a kink in some
    # derivative: order n + 1 at best there, unless that is above four.
    law = derivative(LudwickFinger(1.0, 0.3, 8.0, power), 0.0)
    start, end = np.array([[1.0], [0.0]]), np.array([0.0, 3.0])

    def plain(_t, y):
        return [y[1], -0.3 * y[1] - 8.0 * y[0] * abs(y[0]) ** (power - 1)]

    true = solve_ivp(plain, (0, 3), [1.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-13).y[0, -1]
    steps = 0.1 / 2 ** np.arange(6)
    off = [abs(rk4(law, start, end, h)[-1, 0, 0] - true) for h in steps]
    order = -np.polyfit(np.log2(1 / steps), np.log2(off), 1)[0]
    # The place of the crossing inside a step scatters the single ratios; the trend is the order.
    assert min(power + 1, 4) - 0.6 < order < 5


@pytest.mark.parametrize("allowed", [1e-4, 1e-5])
@pytest.mark.parametrize("power", [1.2, 1.5])
def test_chosen_step_is_as_good_as_it_says_even_at_the_crossing(power, allowed):
    law = derivative(LudwickFinger(1.0, 0.3, 8.0, power), 0.0)
    times = np.linspace(0, 3, 301)

    def solve(step):
        return rk4(law, [[1.0], [0.0]], times, step, keep=(0,))

    choice = step_for(allowed, solve, first=0.2)
    assert abs(solve(choice.step) - solve(choice.step / 16)).max() <= choice.error <= allowed
    assert abs(solve(4 * choice.step) - solve(choice.step / 16)).max() > allowed


def test_a_step_that_cannot_be_reached_is_an_error():
    with pytest.raises(InvalidInputError, match=r"reaches"):
        step_for(1e-9, lambda h: np.array([h]), first=0.1, smallest=1e-3)


@pytest.mark.parametrize(
    ("state", "times", "step"),
    [([1.0], [0, 1], 0.1), ([[1.0]], [0.0], 0.1), ([[1.0]], [0, 1, 1], 0.1), ([[1.0]], [0, 1], 0)],
)
def test_bad_input_is_refused(state, times, step):
    with pytest.raises(InvalidInputError):
        rk4(swing, state, times, step)


@pytest.mark.parametrize("runs", [1, 7, 100, 10_000])
def test_chunks_cover_all_runs_within_the_limit(runs):
    parts = list(chunks(runs, 1e4, limit=5e5))
    assert [p.start for p in parts[1:]] == [p.stop for p in parts[:-1]]
    assert (parts[0].start, parts[-1].stop) == (0, runs)
    assert max(p.stop - p.start for p in parts) * 1e4 <= 5e5
