from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from softgrip.errors import InvalidInputError
from softgrip.tactile.drift_model import DriftSize, gain_and_offset

SIZES = st.builds(DriftSize, return_time=st.sampled_from([0.5, 4.0, inf]))
HOURS = st.floats(0, 20)


@given(SIZES, HOURS, HOURS)
def test_two_steps_are_one(size, first, second):
    (F1, Q1), (F2, Q2), (F, Q) = map(size.transition, (first, second, first + second))
    assert pytest.approx(F, abs=1e-12) == F2 @ F1
    assert pytest.approx(Q, abs=1e-12) == F2 @ Q1 @ F2.T + Q2


@pytest.mark.parametrize("return_time", [0.5, 4.0, inf])
def test_variance_is_the_integral_of_what_is_kept(return_time):
    size = DriftSize(return_time=return_time)
    summed, _ = quad(lambda ago: size.kept(ago) ** 2, 0, 3.0)
    assert size.spread(3.0) == pytest.approx(summed, rel=1e-9)


def test_gain_and_offset_are_rates_times_age_and_wanders():
    gain, offset = gain_and_offset(np.array([[0.01, 0.02, 0.1, 0.2]]), 10.0)
    assert (gain.item(), offset.item()) == pytest.approx((0.2, 0.4))


def test_scaling_scales_every_part_but_the_time():
    twice = DriftSize(return_time=3.0).scaled(2.0)
    assert twice.prior() == pytest.approx(4 * DriftSize().prior())
    assert twice.transition(1.0)[1] == pytest.approx(
        4 * DriftSize(return_time=3.0).transition(1)[1]
    )


@pytest.mark.parametrize("wrong", [{"gain_rate": -1}, {"return_time": 0}, {"offset_wander": inf}])
def test_sizes_that_are_none_are_refused(wrong):
    with pytest.raises(InvalidInputError):
        DriftSize(**wrong)
