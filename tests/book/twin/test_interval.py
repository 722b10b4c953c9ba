"""Intervals: how many hold, and what they lack, by hand and on a normal law."""

import numpy as np
import pytest

from book.twin.interval import CENTRAL, CLAIMED, NORMAL, Interval, coverage, intervals, widening


def test_ends_are_the_percentiles_that_are_claimed():
    x = np.random.default_rng(1).normal(size=200_000)
    # A percentile of so many is known to 0.005.
    np.testing.assert_allclose(np.percentile(x, CENTRAL), [-NORMAL, 0, NORMAL], atol=0.02)
    assert CENTRAL[2] - CENTRAL[0] == CLAIMED


def test_an_end_belongs_to_the_interval_and_a_point_holds_itself():
    assert Interval(0.0, 1.0, 2.0, 2.0).holds
    assert not Interval(0.0, 1.0, 2.0, 2.1).holds
    point = Interval(5.0, 5.0, 5.0, 5.0)
    assert point.holds
    assert point.needed == 0
    assert Interval(5.0, 5.0, 5.0, 6.0).needed == np.inf


def test_shares_and_widening_by_hand():
    """Ten about zero with sides of 1 and 2: three fail, and nine hold at four times the sides."""
    actual = np.array([0.0, 0.5, -0.5, 1.0, 1.5, 2.0, -1.0, 3.0, -4.0, 9.0])
    given = intervals(np.repeat([[-1.0], [0.0], [2.0]], 10, axis=1), actual)
    assert coverage(given) == 70
    assert widening(given) == 4
    wider = intervals(np.repeat([[-4.0], [0.0], [8.0]], 10, axis=1), actual)
    assert coverage(wider) == CLAIMED


def test_intervals_twice_too_narrow_need_twice_the_width():
    x = np.random.default_rng(2).normal(size=20_000)
    half = np.repeat([[-NORMAL / 2], [0.0], [NORMAL / 2]], x.size, axis=1)
    assert widening(intervals(half, x)) == pytest.approx(2, rel=0.03)
