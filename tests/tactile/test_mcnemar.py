"""McNemar's test against statsmodels, and what the printed counts leave open."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from statsmodels.stats.contingency_tables import mcnemar as by_statsmodels

from softgrip.errors import InvalidInputError
from softgrip.tactile.mcnemar import McNemar, mcnemar, overlaps

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


def test_bad_input_is_refused():
    with pytest.raises(InvalidInputError, match="one shape"):
        mcnemar([True], [True, False])
    with pytest.raises(InvalidInputError, match="numbers >= 0"):
        McNemar(-1, 2)
    with pytest.raises(InvalidInputError, match=r"numbers in \[0, 3\]"):
        overlaps(4, 1, 3)
