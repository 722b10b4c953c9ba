"""What a staircase says, by hand: delays, and holds that are cut or not measured."""

import numpy as np
import pytest

from softgrip.control.staircase import staircase
from softgrip.errors import InvalidInputError
from softgrip.logs.staircase import judge_staircase, lag, mean_edge
from tests.logs.test_gaps import STAIRCASE, rewrite

PERIOD = 0.025


def edge(levels, samples, delay=0, **options):
    """Return the mean edge of levels that are held for some samples, and followed later."""
    reference = np.repeat(np.asarray(levels, float), samples)
    late = np.concatenate([np.full(delay, reference[0]), reference])[: reference.size]
    return mean_edge(np.arange(reference.size) * PERIOD, reference, late, **options)


@pytest.mark.parametrize("samples", [0, 8, 20])
def test_lag_and_mean_edge_of_a_delayed_staircase(samples):
    reference = staircase()
    late = np.concatenate([np.zeros(samples), reference])[: reference.size]
    assert lag(reference, late, PERIOD) == pytest.approx(samples * PERIOD)
    time, share = mean_edge(np.arange(reference.size) * PERIOD, reference, late)
    np.testing.assert_allclose(share, time >= samples * PERIOD - 1e-9, atol=1e-9)


def test_lag_is_sought_up_to_the_longest_in_twice_as_long_a_record():
    wave = np.sin(np.arange(30) / 4)
    assert lag(wave[10:], wave[:-10], PERIOD, longest=10 * PERIOD) == pytest.approx(10 * PERIOD)
    for bad in (wave[11:], np.ones(20)):
        with pytest.raises(InvalidInputError, match="not constant, N >= 20"):
            lag(bad, bad, PERIOD, longest=10 * PERIOD)


def test_first_and_last_hold_may_be_cut_short():
    time, share = edge([0, 1, 3, 2], [1, 10, 10, 4], delay=2)
    np.testing.assert_allclose(time, PERIOD * np.arange(10), atol=1e-12)
    np.testing.assert_allclose(share, np.arange(10) >= 2, atol=1e-12)


def test_hold_is_that_between_changes_which_were_measured():
    bridged = np.arange(28) != 4  # the row before the first change
    assert edge([0, 1, 2, 3], [5, 3, 10, 10])[1].size == 3
    assert edge([0, 1, 2, 3], [5, 3, 10, 10], measured=bridged)[1].size == 10
    assert edge([0, 1], [5, 7])[1].size == 7
    with pytest.raises(InvalidInputError, match="a hold from end to end"):
        edge([0, 1], [5, 7], measured=np.arange(12) != 5)


def test_two_samples_are_a_hold_and_one_is_a_ramp():
    np.testing.assert_array_equal(edge([0, 1, 0], 2)[1], [1, 1])
    for levels, samples, words in (([0, 1, 2, 3], 1, "a ramp"), ([1], 5, "a change, got 'none'")):
        with pytest.raises(InvalidInputError, match=words):
            edge(levels, samples)


def test_level_is_crossed_between_samples(path):
    """An angle 10.4 samples late is at 0, 60 and 100 % of a change after 9, 10 and 11 samples."""

    def late(rows):
        reference = np.array([float(row[6]) for row in rows])
        samples = np.arange(reference.size)
        angles = np.interp(samples - 10.4, samples, reference)
        return [[*row[:5], repr(float(y)), *row[6:]] for row, y in zip(rows, angles, strict=True)]

    found = judge_staircase(rewrite(path, STAIRCASE, late))
    assert found.time_to_half == pytest.approx((9 + 0.5 / 0.6) * PERIOD, rel=1e-6)
    assert found.time_to_change == pytest.approx(10.75 * PERIOD, rel=1e-6)
    assert found.lag == pytest.approx(10 * PERIOD)
    assert found.edges == 12
