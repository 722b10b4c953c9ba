"""Eq. (5.12) to (5.16)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from softgrip.dynamics.integrate import rk4
from softgrip.dynamics.ludwick import (
    LudwickFinger,
    acceleration,
    derivative,
    modified_moment,
    pressure_response,
    restoring_force,
    spring_constant,
    step_responses,
)
from softgrip.errors import InvalidInputError
from tests.bench.fingers import batch, plain

SIZES = {"width": 0.030, "height": 0.024}
powers = st.floats(1.0, 3.0)


def test_power_one_is_twice_the_linear_model_to_which_it_is_said_to_degrade():
    b, h, L, E = 0.030, 0.024, 0.094, 0.34e6
    linear_moment = b * h**3 / 12  # Eq. (5.11)
    linear_constant = 2 * E * linear_moment / L**2  # Eq. (5.10)
    assert modified_moment(1.0, b, h) == pytest.approx(2 * linear_moment)
    assert spring_constant(E, 1.0, b, h, L) == pytest.approx(2 * linear_constant)


@given(n=powers)
def test_section_integral_is_half_of_the_print_and_equals_chapter_3(n):
    """Eq. (5.14) is twice the integral of Ludwick's stress, b |y|^(1 + n) dy, over the section."""
    b, h = SIZES["width"], SIZES["height"]
    integral = 2 * quad(lambda y: b * (y * h) ** (1 + n) * h, 0, 0.5)[0]
    chapter_3 = 0.5 ** (1 + n) / (2 + n) * b * h ** (2 + n)  # Eq. (3.8)
    assert integral == pytest.approx(chapter_3, rel=1e-6)
    assert modified_moment(n, **SIZES) == pytest.approx(2 * integral, rel=1e-6)


@given(n=powers, force=st.floats(0.1, 10))
def test_spring_is_that_of_a_cantilever_whose_curvature_is_summed(n, force):
    """Eq. (5.13): a force at the tip, whose lever falls from L to 0, by quadrature."""
    E, L = 0.34e6, 0.094
    stiffness = E * modified_moment(n, **SIZES)
    angle = L * quad(lambda s: (force * L * (1 - s) / stiffness) ** (1 / n), 0, 1)[0]
    # The curvature falls to 0 with an infinite slope, which costs the quadrature digits.
    found = spring_constant(E, n, length=L, **SIZES)
    assert restoring_force(angle, found, n) == pytest.approx(force, rel=1e-5)


@given(n=powers, angle=st.floats(-4, 4))
def test_spring_is_odd(n, angle):
    assert restoring_force(-angle, 2.0, n) == -restoring_force(angle, 2.0, n)


@given(n=powers, angle=st.floats(0.01, 4))
def test_at_rest_the_force_is_the_static_law(n, angle):
    """Eq. (5.12)."""
    finger = LudwickFinger(0.5, 1.0, 2.0, n)
    assert acceleration(finger, angle, 0.0, 2.0 * angle**n) == pytest.approx(0.0, abs=1e-9)


@given(n=powers, mass=st.floats(0.1, 2), time=st.floats(0.1, 3))
def test_the_force_of_a_given_motion_gives_its_acceleration_back(n, mass, time):
    """Eq. (5.15) for ``theta = t**3``, by hand; divided by M_eq it is Eq. (3.11)."""
    angle, rate, second = time**3, 3 * time**2, 6 * time
    force = mass * second + 0.4 * rate + 2.0 * angle**n
    assert acceleration(LudwickFinger(mass, 0.4, 2.0, n), angle, rate, force) == pytest.approx(
        second, rel=1e-6
    )
    divided = LudwickFinger(1.0, 0.4 / mass, 2.0 / mass, n)
    assert acceleration(divided, angle, rate, force / mass) == pytest.approx(second, rel=1e-6)


def test_integrator_law_is_the_acceleration():
    rng = np.random.default_rng(0)
    finger = LudwickFinger(*rng.uniform(1, 2, (4, 5)))
    state, force = rng.normal(size=(2, 5)), rng.normal(size=5)
    slope = np.empty((2, 5))
    derivative(finger, force)(0.0, state, slope)
    np.testing.assert_array_equal(slope[0], state[1])
    np.testing.assert_allclose(slope[1], acceleration(finger, *state, force), rtol=1e-12)


def test_power_one_gives_the_closed_second_order_response():
    wn, zeta = 2.86, 0.7
    times = np.linspace(0, 5, 501)
    law = derivative(LudwickFinger(1.0, 2 * zeta * wn, wn**2, 1.0), wn**2)
    found = rk4(law, np.zeros((2, 1)), times, 0.02)[:, 0, 0]
    wd = wn * (1 - zeta**2) ** 0.5
    decay = np.exp(-zeta * wn * times)
    true = 1 - decay * (np.cos(wd * times) + zeta * wn / wd * np.sin(wd * times))
    np.testing.assert_allclose(found, true, atol=1e-6)


def test_step_responses_agree_with_a_tight_reference_to_a_millionth():
    """Eq. (5.16) as it stands, by SciPy's integrator of eighth order."""
    given = batch(12)
    ((_, found),) = step_responses(given.finger, given.force, given.times, 0.025, runs=12)
    true = plain(given, method="DOP853", rtol=1e-11, atol=1e-12)
    assert abs(found - true).max() < 1e-6


def test_parts_of_a_batch_are_the_batch():
    given, times = batch(10), np.linspace(0, 2, 101)
    ((_, whole),) = step_responses(given.finger, given.force, times, 0.02, runs=10)
    whole = whole.copy()
    seen = 0
    parts = step_responses(given.finger, given.force, times, 0.02, runs=10, limit=3 * 8 * 101)
    for part, angle in parts:
        assert angle.shape == (101, part.stop - part.start)
        np.testing.assert_allclose(angle, whole[:, part], rtol=1e-12, atol=1e-15)
        seen += angle.shape[1]
    assert seen == 10


@pytest.mark.parametrize(
    "values", [(0.0, 1, 1, 2), (1, -1, 1, 2), (1, 1, np.nan, 2), (1, 1, 1, 0.9)]
)
def test_bad_parameters_are_refused(values):
    with pytest.raises(InvalidInputError):
        LudwickFinger(*values)


TIME = np.linspace(0, 6, 241)
PRESSURE = 7e3 * np.minimum(1, TIME / 0.3) + 300 * np.sin(5 * TIME)
F = 1.5e-5


@pytest.mark.parametrize("n", [1.0, 1.538, 2.365])
def test_agrees_with_an_independent_solver(n):
    m, c, k = 0.04, 0.14, 0.1
    found = pressure_response(LudwickFinger(m, c, k, n), TIME, PRESSURE, force_per_pressure=F)

    def law(t, y):
        return [y[1], (F * np.interp(t, TIME, PRESSURE) - c * y[1] - k * abs(y[0]) ** n) / m]

    # Its step must see every kink of the pressure.
    true = solve_ivp(law, (0, 6), [0, 0], "DOP853", TIME, rtol=1e-9, atol=1e-11, max_step=0.025)
    np.testing.assert_allclose(found, true.y[0], atol=2e-6)


def test_rests_where_the_spring_holds_the_force():
    long = np.linspace(0, 40, 1601)
    finger = LudwickFinger(0.04, 0.14, 0.1, 2.365)
    end = pressure_response(finger, long, 0 * long + 7e3, force_per_pressure=F)[-1]
    assert end == pytest.approx((F * 7e3 / 0.1) ** (1 / 2.365), rel=1e-6)


def test_batch_is_its_runs():
    powers = np.array([1.0, 2.0, 2.5])
    batch = LudwickFinger(*(np.full(3, v) for v in (0.04, 0.14, 0.1)), powers)
    together = pressure_response(batch, TIME, PRESSURE, force_per_pressure=F)
    for row, n in zip(together, powers, strict=True):
        alone = LudwickFinger(0.04, 0.14, 0.1, n)
        np.testing.assert_allclose(
            row, pressure_response(alone, TIME, PRESSURE, force_per_pressure=F), rtol=1e-12
        )


@pytest.mark.parametrize(("time", "pressure"), [([0, 1], [1]), ([0, 0], [1, 1]), ([0], [1])])
def test_bad_records_are_refused(time, pressure):
    with pytest.raises(InvalidInputError, match="time, pressure"):
        pressure_response(LudwickFinger(1, 1, 1, 2), time, pressure, force_per_pressure=1.0)
