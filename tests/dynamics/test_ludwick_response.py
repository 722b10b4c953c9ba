"""Eq. (5.16) driven by a sampled pressure."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from softgrip.dynamics.ludwick import LudwickFinger
from softgrip.dynamics.ludwick_response import pressure_response
from softgrip.errors import InvalidInputError

TIME = np.linspace(0, 6, 241)
PRESSURE = 7e3 * np.minimum(1, TIME / 0.3) + 300 * np.sin(5 * TIME)
F = 1.5e-5


@pytest.mark.parametrize("n", [1.0, 1.538, 2.365])
def test_agrees_with_an_independent_solver(n):
    m, c, k = 0.04, 0.14, 0.1
    found = pressure_response(LudwickFinger(m, c, k, n), TIME, PRESSURE, force_per_pressure=F)

    def plain(t, y):
        return [y[1], (F * np.interp(t, TIME, PRESSURE) - c * y[1] - k * abs(y[0]) ** n) / m]

    # Its step must see every kink of the pressure.
    true = solve_ivp(plain, (0, 6), [0, 0], "DOP853", TIME, rtol=1e-9, atol=1e-11, max_step=0.025)
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
