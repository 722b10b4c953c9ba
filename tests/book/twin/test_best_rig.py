"""The evolution strategy, on lines."""

import numpy as np

from book.twin.best_rig import BOUND, evolved, loss
from book.twin.smoother import Ensemble
from tests.book.twin.lines import lines


def _start(problem, count=32):
    x = np.random.default_rng(1).normal(size=(count, problem.slopes.shape[1]))
    return Ensemble(x, problem.off(x))


def test_it_finds_the_rig_that_meets_all():
    problem = lines([[2.0, 1.0], [1.0, -1.0]], [1.0, 0.5])
    best = evolved(problem, _start(problem), generations=60, rigs=12)
    np.testing.assert_allclose(best.x[0], np.linalg.solve(problem.slopes, [1.0, 0.5]), atol=1e-3)
    assert (np.diff(loss(problem, best.off)) >= 0).all()


def test_what_cannot_be_met_does_not_draw_the_rest_along():
    """Two say 0 and one says 40: least squares would take the mean, 13."""
    problem = lines([[10.0], [10.0], [10.0]], [0.0, 0.0, 40.0])
    best = evolved(problem, _start(problem), generations=40, rigs=12)
    assert abs(best.off[0, 0]) < 0.1
    assert loss(problem, best.off)[0] < BOUND**2


def test_what_was_cut_goes_on_where_it_stopped(tmp_path):
    make = lambda: lines([[2.0, 1.0], [1.0, -1.0]], [1.0, 0.5])  # noqa: E731
    start = _start(make())
    want = evolved(make(), start, generations=12, rigs=8)
    evolved(make(), start, generations=5, rigs=8, kept=tmp_path / "state")
    again = make()
    found = evolved(again, start, generations=12, rigs=8, kept=tmp_path / "state")
    assert len(again.calls) == 7
    np.testing.assert_array_equal(want.x, found.x)


def test_a_rig_that_is_known_is_where_it_goes_on_and_is_not_lost():
    problem = lines([[2.0, 1.0], [1.0, -1.0]], [1.0, 0.5])
    known = np.linalg.solve(problem.slopes, [1.01, 0.5])
    before = loss(problem, problem.off(known[None]))[0]
    best = evolved(problem, _start(problem), generations=0, known=known)
    np.testing.assert_array_equal(best.x, known[None])
    later = evolved(problem, _start(problem), generations=40, rigs=12, known=known)
    assert loss(problem, later.off)[0] < before
