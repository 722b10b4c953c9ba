"""The smallest set of targets to drop, against all sets by brute force."""

from dataclasses import replace
from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import linprog

from book.twin.tension import HOLDS, Dropped, against, fewest, program
from tests.book.twin.lines import lines


def _least(missed, slopes, reach):
    """Return the least number of targets to drop, trying all sets."""
    count, free = slopes.shape
    for size in range(count + 1):
        for dropped in combinations(range(count), size):
            kept = [k for k in range(count) if k not in dropped]
            A = np.vstack([slopes[kept], -slopes[kept]])
            b = np.append(HOLDS - missed[kept], HOLDS + missed[kept])
            if linprog(np.zeros(free), A, b, bounds=[(-reach, reach)] * free).status == 0:
                return size
    raise AssertionError


@pytest.mark.parametrize("seed", range(6))
def test_the_program_drops_no_more_than_must_be(seed):
    rng = np.random.default_rng(seed)
    slopes, missed = 3 * rng.normal(size=(7, 2)), 4 * rng.normal(size=7)
    step = program(missed, slopes, np.zeros(2), reach=2.0)
    given_up = np.sum(np.abs(missed + slopes @ step) > HOLDS + 1e-6)
    assert given_up == _least(missed, slopes, 2.0)


def test_two_that_pull_apart_cost_one():
    problem = lines([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [0.0, 5.0, 1.5])
    found = fewest(problem, np.array([2.5, 0.0]), rounds=8)
    assert found.dropped.sum() == 1
    assert not found.dropped[2]


def test_what_stands_in_the_way_is_named():
    """The third asks for 3 of the first variable, of which two others ask for 0; one has no part.

    They hold to 1/3 in x, where it misses by 3 - 1 = 2: by hand.
    """
    problem = lines([[3.0, 0.0], [2.0, 0.0], [3.0, 0.0], [0.0, 3.0]], [0.0, 0.0, 3.0, 0.5])
    problem = replace(problem, targets=tuple(SimpleNamespace(id=f"{k}") for k in range(4)))
    x = np.array([0.1, 0.1])
    off = problem.off(x[None])[0]
    (found,) = against(problem, Dropped(x, off, np.array([False, False, True, False])))
    assert (found.id, found.against) == ("2", "0")
    assert found.left == pytest.approx(2.0)
    assert found.really == pytest.approx(2.0)
