"""The weights of Section 2.3 and the pieces they are made of; Table 2.2 against itself."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ttest_1samp

from softgrip.errors import InvalidInputError
from softgrip.tactile.force import SET, WEIGHTS, Weighing, table_2_2
from softgrip.units import GRAM_FORCE


def test_twenty_two_weights_and_zero_three_times_are_69_points():
    assert len(set(WEIGHTS)) == len(WEIGHTS) == 22
    assert 3 * (len(WEIGHTS) + 1) == 69


@pytest.mark.parametrize(
    ("pieces", "missing"), [(SET, [2.5, 4, 14, 40, 45]), ((*SET, 2, 20), [2.5])]
)
def test_weights_that_no_choice_of_pieces_makes(pieces, missing):
    """A second 2 and a second 20 leave only the half gram."""
    sums = {sum(p * use for p, use in zip(pieces, chosen, strict=True))
            for chosen in product((0, 1), repeat=len(pieces))}  # fmt: skip
    assert [w for w in WEIGHTS if w not in sums] == missing


PRINTED = {"coin": 96.0, "sliced carrot": 98.9, "tofu": 91.8, "sliced sausage": 94.9, "egg": 95.3}


@pytest.mark.parametrize("name", PRINTED)
def test_accuracies_follow_from_the_weights(name):
    assert 100 * table_2_2()[name].accuracy == pytest.approx(PRINTED[name], abs=0.05)


def test_mean_accuracy_is_the_one_of_the_text():
    assert [*table_2_2()] == [*PRINTED]
    mean = np.mean([row.accuracy for row in table_2_2().values()])
    assert 100 * mean == pytest.approx(95.4, abs=0.05)


def test_weights_are_in_newtons():
    assert table_2_2()["egg"].true == pytest.approx(0.579, abs=5e-4)


@given(seed=st.integers(0, 2**32 - 1), bias=st.floats(-2, 2))
def test_interval_and_p_are_those_of_a_sample(seed, bias):
    sample = np.random.default_rng(seed).normal(10 + bias, 1, 10)
    weighing = Weighing(float(sample.mean()), float(sample.std(ddof=1)), 10.0)
    expected = ttest_1samp(sample, 10.0)
    assert weighing.bias_p == pytest.approx(expected.pvalue, rel=1e-9)
    interval = expected.confidence_interval(0.95)
    assert weighing.interval() == pytest.approx((interval.low, interval.high), rel=1e-9)


def test_accuracy_of_one_measurement_by_drawing_many():
    row = table_2_2()["sliced sausage"]
    drawn = np.random.default_rng(0).normal(row.measured, row.deviation, 400_000)
    expected = 1 - np.mean(abs(drawn - row.true)) / row.true
    # 0.04 of the weight is the deviation of one error: four standard errors of the mean.
    assert row.accuracy_of_one == pytest.approx(expected, abs=4 * 0.04 / 400_000**0.5)


def test_one_measurement_is_never_more_accurate_than_the_mean():
    for row in table_2_2().values():
        assert row.accuracy_of_one < row.accuracy
    exact = Weighing(9.0, 0.0, 10.0)
    assert exact.accuracy_of_one == exact.accuracy == pytest.approx(0.9)


def test_only_the_sausage_is_off_by_more_than_chance():
    assert [name for name, row in table_2_2().items() if row.bias_p < 0.05] == ["sliced sausage"]


def test_bias_without_a_deviation_is_refused():
    with pytest.raises(InvalidInputError, match="deviation"):
        _ = Weighing(1.0, 0.0, 1.0).bias_p


@pytest.mark.parametrize("bad", [(1, 1, 0), (1, -1, 1), (1, 1, 1, 1), (1, 1, float("nan"))])
def test_weighing_without_sense_is_refused(bad):
    with pytest.raises(InvalidInputError, match="true"):
        Weighing(*bad)


def test_grams_do_not_matter():
    row = table_2_2()["tofu"]
    same = Weighing(16.53, 2.27, 18)
    assert row.accuracy_of_one == pytest.approx(same.accuracy_of_one)
    assert row.bias_p == pytest.approx(same.bias_p)
    assert row.measured == pytest.approx(16.53 * GRAM_FORCE)
