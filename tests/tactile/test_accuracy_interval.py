"""Intervals against statsmodels and by their definition; counts behind the printed percentages."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom
from statsmodels.stats.proportion import proportion_confint

from softgrip.errors import InvalidInputError
from softgrip.tactile.accuracy_interval import Accuracy, counts_behind

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


@pytest.mark.parametrize("bad", [(0, 0), (-1, 5), (6, 5)])
def test_impossible_counts_are_refused(bad):
    with pytest.raises(InvalidInputError, match="0 <= correct <= total"):
        Accuracy(*bad)


def test_impossible_confidence_and_no_trials_are_refused():
    with pytest.raises(InvalidInputError, match="confidence"):
        Accuracy(1, 2).interval(1.0)
    with pytest.raises(InvalidInputError, match="total"):
        counts_behind("50", 0)
