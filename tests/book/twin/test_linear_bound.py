"""The bound of the linear range: the one that misses its prints the least."""

import numpy as np
import pytest

from book.twin.linear_bound import NAME, Ranges, ranges, with_bound
from book.twin.misfit import chosen, misfit
from book.twin.problem import error_of
from book.twin.space import space, values

WANTED = chosen(["linear range"])
TODAY = np.array([column[0] for column in values().values()])


def test_the_least_sum_of_squares_is_taken():
    errors = np.array([error_of(one) for one in WANTED])
    # In errors: two bounds of three on two rigs.
    missed = np.array([[[3, 0, 0, 0], [1, 1, 1, 1]], [[2, 2, 0, 0], [3, 0, 0, 0]],
                       [[4, 0, 0, 0], [1, 1, 1, 0]]])  # fmt: skip
    tried = Ranges(WANTED, np.array([2.0, 5.0, 8.0]), missed * errors)
    assert tried.settled().tolist() == [5.0, 8.0]
    assert tried.nearest(0) == (1, 2.0)
    assert tried.nearest(3)[1] in (2.0, 5.0, 8.0)


def test_what_is_tried_is_what_the_experiment_gives():
    tried = ranges(TODAY[None])
    low, high = space()[NAME].low, space()[NAME].high
    assert (tried.bounds[0], tried.bounds[-1]) == pytest.approx((low, high))
    for k in (0, 40, 120):
        row = with_bound(TODAY[None], tried.bounds[k])
        off = misfit(row, experiments=["linear range"], jobs=1)
        np.testing.assert_allclose(tried.off[k], off, rtol=1e-6, atol=1e-6)


def test_nothing_else_hangs_on_the_bound():
    assert {t.experiment for t in chosen() if NAME in t.hangs_on} == set()
