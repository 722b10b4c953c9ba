"""Intervals, counts behind printed percentages and McNemar's test: statsmodels, definitions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom
from statsmodels.stats.contingency_tables import mcnemar as by_statsmodels
from statsmodels.stats.proportion import proportion_confint

from softgrip.errors import InvalidInputError
from softgrip.tactile.accuracy import Accuracy, McNemar, counts_behind, mcnemar, overlaps

trials = st.integers(1, 700).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n)))


@given(trials, st.floats(0.5, 0.99))
def test_interval_is_that_of_statsmodels(trial, confidence):
    low, high = proportion_confint(*trial, alpha=1 - confidence, method="beta")
    # Two root searches in double precision.
    assert Accuracy(*trial).interval(confidence) == pytest.approx((low, high), abs=1e-9)


@given(trials)
def test_ends_leave_the_outcome_a_chance_of_one_in_forty(trial):
    correct, total = trial
    low, high = Accuracy(*trial).interval()
    if correct:
        assert binom.sf(correct - 1, total, low) == pytest.approx(0.025, rel=1e-6)
    if correct < total:
        assert binom.cdf(correct, total, high) == pytest.approx(0.025, rel=1e-6)


@pytest.mark.parametrize(
    ("percent", "total", "count"),
    [("96.25", 80, 77), ("92.5", 80, 74), ("96.83", 126, 122), ("95.24", 126, 120),
     ("96.43", 504, 486), ("94.84", 504, 478)],
)  # fmt: skip
def test_each_printed_percentage_has_one_count(percent, total, count):
    assert counts_behind(percent, total) == (count,)


@pytest.mark.parametrize("percent", ["96.43", "94.84"])
@pytest.mark.parametrize("total", [630, 126])
def test_printed_training_accuracies_are_not_of_other_totals(percent, total):
    assert counts_behind(percent, total) == ()


@given(trials, st.integers(0, 3))
def test_a_count_is_behind_its_own_percentage(trial, decimals):
    correct, total = trial
    assert correct in counts_behind(f"{100 * correct / total:.{decimals}f}", total)


pairs = st.lists(st.tuples(st.booleans(), st.booleans()), min_size=1, max_size=200)


@given(pairs)
def test_p_is_that_of_statsmodels(pairs):
    first, second = np.array(pairs).T
    found = mcnemar(first, second)
    table = [
        [(first & second).sum(), (first & ~second).sum()],
        [(~first & second).sum(), (~first & ~second).sum()],
    ]
    # Its exact test takes twice the smaller tail, which can be more than one.
    assert found.p_value == pytest.approx(min(1.0, by_statsmodels(table, exact=True).pvalue))


@given(pairs)
def test_overlaps_hold_the_true_one(pairs):
    first, second = np.array(pairs).T
    found = overlaps(int(first.sum()), int(second.sum()), len(pairs))
    assert mcnemar(first, second) in found
    assert all(t.only_first - t.only_second == first.sum() - second.sum() for t in found)
    assert all(t.only_first + t.only_second <= len(pairs) for t in found)


def test_printed_gain_on_the_objects_is_within_chance_whatever_the_overlap():
    """92.5 against 96.25 % of 80: by hand, at best 0 against 3, p = 2 / 2^3."""
    found = [test.p_value for test in overlaps(74, 77, 80)]
    assert len(found) == 4
    assert min(found) == pytest.approx(0.25)


def test_printed_loss_in_cross_validation_hangs_on_the_overlap():
    """96.43 against 94.84 % of 504: at best 8 against 0, p = 2 / 2^8; at worst 26 against 18."""
    found = [test.p_value for test in overlaps(486, 478, 504)]
    assert min(found) == pytest.approx(2**-7)
    assert max(found) > 0.25


def test_classifiers_that_agree_do_not_differ():
    assert McNemar(0, 0).p_value == 1.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Accuracy(0, 0), "0 <= correct <= total"),
        (lambda: Accuracy(-1, 5), "0 <= correct <= total"),
        (lambda: Accuracy(6, 5), "0 <= correct <= total"),
        (lambda: Accuracy(1, 2).interval(1.0), "confidence"),
        (lambda: counts_behind("50", 0), "total"),
        (lambda: mcnemar([True], [True, False]), "one shape"),
        (lambda: McNemar(-1, 2), "numbers >= 0"),
        (lambda: overlaps(4, 1, 3), r"numbers in \[0, 3\]"),
    ],
)
def test_bad_input_is_refused(call, message):
    with pytest.raises(InvalidInputError, match=message):
        call()
