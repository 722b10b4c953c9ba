"""The largest step that can settle in time, against closed forms and the question turned round."""

import control
import numpy as np
import pytest

from softgrip.control.largest_step import largest_step
from softgrip.control.minimum_time import farthest, minimum_settling_time
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.errors import InvalidInputError

FULL = full_state_space(SecondOrder(1.65, 0.86, 1.49e-4), 980.0)


@pytest.mark.parametrize(("n", "share"), [(1, 1), (2, 1 / 4), (3, 1 / 32)])
def test_rest_to_rest_of_integrators(n, share):
    # A unit command for a time T: T, T^2 / 4, T^3 / 32 (full, back, full).
    system = control.ss(np.eye(n, k=1), np.eye(n)[:, -1:], np.eye(n)[:1], 0)
    found = largest_step(system, 3.0, 2.0, band=1e-6, period=0.025)
    # Samples alone count, so that it may come to rest up to a period later.
    assert 3.0 * 2.0**n * share <= found * (1 + 1e-5)
    assert found <= 3.0 * 2.025**n * share


@pytest.mark.parametrize("band", [0.02, 0.1])
def test_it_settles_in_this_time_and_a_larger_one_does_not(band):
    step = largest_step(FULL, 31.4, 0.8, band=band)
    slower = minimum_settling_time(FULL, 1.01 * step, 31.4, band=band * 1.01 * step)
    assert minimum_settling_time(FULL, 0.99 * step, 31.4, band=band * 0.99 * step) <= 0.8 + 1e-9
    assert slower > 0.8 + 1e-9
    assert (1 - band) * step <= farthest(FULL, 31.4, 0.8)


def test_it_is_in_proportion_to_the_limit():
    one, two = (largest_step(FULL, limit, 0.8, band=0.05) for limit in (10.0, 20.0))
    assert two == pytest.approx(2 * one, rel=1e-6)


@pytest.mark.parametrize("options", [{"time": 0.001}, {"band": 1.0}, {"limit": 0.0}])
def test_arguments_out_of_range(options):
    with pytest.raises(InvalidInputError):
        largest_step(FULL, **({"limit": 1.0, "time": 1.0, "band": 0.1} | options))
