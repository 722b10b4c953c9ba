"""The smallest set of targets to drop, against all sets by brute force."""

from dataclasses import replace
from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import linprog

from book.twin.tension import HOLDS, fewest, program, pulls
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


def test_what_a_target_costs_is_seen_when_it_is_left_out():
    """Three agree, one pulls away; that one costs them, none of them costs the others."""
    problem = lines([[3.0, 0.0], [3.0, 0.0], [3.0, 0.0], [0.0, 3.0]], [0.0, 0.0, 3.0, 0.5])
    problem = replace(problem, targets=tuple(SimpleNamespace(id=f"{k}") for k in range(4)))
    found = {one.left_out: one for one in pulls(problem, np.array([0.3, 0.1]))}
    assert max(found.values(), key=lambda one: one.costs).left_out == "2"
    assert found["2"].costs > 0
