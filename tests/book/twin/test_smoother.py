"""The ensemble smoother, on lines: there the answer is a normal law that is known."""

import numpy as np
import pytest

from book.twin.smoother import inflations, smoothed
from tests.book.twin.lines import lines

SLOPES = [[0.6, 0.3, 0.0], [0.0, 0.5, -0.5]]
OBSERVED = [0.6, -0.3]
# Misses of a few errors at most: beyond, they count by their logarithm.


def _exact():
    """Mean and covariance given the observations: prior I, errors 1, by the normal equations."""
    A = np.array(SLOPES)
    covariance = np.linalg.inv(A.T @ A + np.eye(3))
    return covariance @ A.T @ OBSERVED, covariance


@pytest.mark.parametrize("rounds", [1, 8])
def test_on_lines_it_gives_the_normal_law(rounds):
    """To 1/sqrt(4096) times a few, which chance leaves."""
    last = smoothed(lines(SLOPES, OBSERVED), rigs=4096, rounds=rounds)[-1]
    mean, covariance = _exact()
    np.testing.assert_allclose(last.x.mean(axis=0), mean, atol=0.08)
    np.testing.assert_allclose(np.cov(last.x.T), covariance, atol=0.08)


def test_all_rounds_together_count_the_targets_once():
    for rounds in (1, 4, 16):
        assert np.sum(1 / inflations(rounds)) == pytest.approx(1)


def test_a_target_moves_only_what_its_experiment_looks_at():
    apart = lines([[1.0, 0.0], [0.0, 1.0]], [2.0, 0.0], [0.5, np.inf])
    before, *_, after = smoothed(apart, rigs=64, rounds=8)
    np.testing.assert_array_equal(after.x[:, 1], before.x[:, 1])
    assert abs(after.x[:, 0].mean() - 1.6) < 0.3  # 4 of 5 of the way, by the prior


def test_what_was_cut_goes_on_where_it_stopped(tmp_path):
    whole = lines(SLOPES, OBSERVED)
    want = smoothed(whole, rigs=64, rounds=4)
    part = smoothed(lines(SLOPES, OBSERVED), rigs=64, rounds=4, kept=tmp_path / "rounds.npz")
    np.savez(
        tmp_path / "rounds.npz", x=[one.x for one in part[:3]], off=[one.off for one in part[:3]]
    )
    again = lines(SLOPES, OBSERVED)
    found = smoothed(again, rigs=64, rounds=4, kept=tmp_path / "rounds.npz")
    assert again.calls == [64, 64]
    for one, other in zip(want, found, strict=True):
        np.testing.assert_array_equal(one.x, other.x)
