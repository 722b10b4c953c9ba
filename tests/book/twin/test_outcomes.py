"""The kept rigs, and what is said of them."""

import numpy as np
import pytest

from book.twin.fitted import best_rig, ensemble, nearest, rounded
from book.twin.misfit import chosen, misfit
from book.twin.outcomes import KEPT, judged
from book.twin.pictures import percents
from book.twin.problem import error_of
from book.twin.recipes import ALL
from book.twin.space import space
from book.twin.targets import targets

OUTCOMES = KEPT.read()


def test_every_kept_rig_lies_in_the_declared_space():
    low, high = np.array([(one.low, one.high) for one in space().values()]).T
    for rigs in (best_rig()[None], ensemble(), nearest()):
        assert ((rigs >= low) & (rigs <= high)).all()
        np.testing.assert_array_equal(rounded(rigs), rigs)
    assert len(ensemble()) >= 200
    assert len(np.unique(ensemble(), axis=0)) == len(ensemble())


def test_the_kept_numbers_are_those_of_the_kept_rigs():
    """Of the best rig, and of the one nearest to some target: to the digits that are kept."""
    wanted = chosen(ALL)
    k = next(k for k, one in enumerate(OUTCOMES) if one.word == "alone")
    off = misfit(np.array([best_rig(), nearest()[k]]), experiments=ALL, jobs=1)
    values = [t.given(o) for t, o in zip(wanted, off[0], strict=True)]
    np.testing.assert_allclose([one.best for one in OUTCOMES], values, rtol=1e-4, atol=1e-6)
    near = wanted[k].given(off[1, k])
    assert OUTCOMES[k].nearest == pytest.approx(near, rel=1e-4)


def test_most_deviations_fell_to_a_few_percent():
    """What the fit is for: 5 % in the median, and two thirds within a tenth."""
    best, before = percents("best"), percents("before")
    assert np.median(best) < 5 < np.median(before)
    assert np.mean(best <= 10) > 2 / 3 > 2 * np.mean(before <= 10)


def test_a_word_says_what_was_found():
    target = next(one for one in targets() if one.relation == "=")
    error = error_of(target)
    many = np.array([0.0, 0.0, 3 * error])
    assert judged(target, 9.0, 0.5 * error, 3 * error + 0 * many, 0.0).word == "together"
    assert judged(target, 9.0, 2 * error, many, 0.0).word == "together"
    assert judged(target, 9.0, 2 * error, many[::-1] + 2 * error, 0.9 * error).word == "alone"
    assert judged(target, 9.0, 2 * error, many + 2 * error, -1.1 * error).word == "out of reach"


def test_a_rig_that_is_nearest_is_no_farther_than_any_other():
    for one, target in zip(OUTCOMES, chosen(ALL), strict=True):
        off = abs(one.nearest - target.value)
        assert off <= abs(one.best - target.value) + 1e-4 * abs(target.value), one.id


def test_a_value_on_the_wrong_side_of_a_bound_is_told_there():
    lower = next(one for one in targets() if one.relation == ">")
    several = np.array([0.0, 1.0, 4.0])
    one = judged(lower, 2.0, 0.0, several, 1.0)
    assert one.before == pytest.approx(lower.value - 2 * lower.tolerance)
    assert one.low < one.middle < one.high <= lower.value


def test_every_print_is_judged():
    assert [one.id for one in OUTCOMES] == [one.id for one in targets()]
    assert len(nearest()) == len(targets())
