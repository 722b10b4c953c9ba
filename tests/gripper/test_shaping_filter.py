"""The filters H(s): the printed ones, and SciPy's Butterworth filter."""

import numpy as np
import pytest
from scipy.signal import butter

from softgrip.errors import InvalidInputError
from softgrip.gripper.shaping_filter import (
    FAST,
    SLOW,
    bandwidth,
    filter_state_space,
    low_pass,
    plant_inside,
    rounding_margin,
)

POINTS = 1j * np.geomspace(0.01, 1000, 40)


@pytest.mark.parametrize("printed", [FAST, SLOW])
@pytest.mark.parametrize("factor", [1.0, 3.0])
def test_state_space_has_the_printed_coefficients(printed, factor):
    expected = np.polyval(printed[0], POINTS) / np.polyval(printed[1], POINTS)
    found = filter_state_space(*(np.multiply(factor, part) for part in printed))
    assert found(POINTS).ravel() == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize(("printed", "fastest"), [(FAST, 260), (SLOW, 42)])
def test_printed_filters_are_stable_low_passes_of_relative_degree_3(printed, fastest):
    found = filter_state_space(*printed)
    assert found(0).item() == pytest.approx(1)
    assert found.poles().real.max() < 0
    assert np.abs(found.poles()).max() == pytest.approx(fastest, rel=0.01)
    assert len(printed[1]) - len(printed[0]) == 3


@pytest.mark.parametrize("printed", [FAST, SLOW])
def test_bandwidth_is_3_db_down(printed):
    found = filter_state_space(*printed)
    assert abs(found(1j * bandwidth(found)).item()) == pytest.approx(2**-0.5, rel=1e-3)


@pytest.mark.parametrize("order", [3, 4, 5])
def test_low_pass_is_scipys(order):
    top, low = butter(order, 5.0, analog=True)
    expected = np.polyval(top, POINTS) / np.polyval(low, POINTS)
    assert low_pass(5.0, order)(POINTS).ravel() == pytest.approx(expected, rel=1e-6)


def test_plant_inside_finds_the_plant_that_a_filter_was_made_around():
    top = np.array([3.0, 40.0])
    loop = np.polymul([1, 2.5, 3.3, 0], np.polymul([1, 30], [1, 12, 90]))
    assert plant_inside(top, np.polyadd(loop, top)) == pytest.approx((2.5, 3.3))


def test_both_printed_filters_hold_one_plant_which_is_not_the_mean_of_the_fingers():
    """Rounding the coefficients explains what the two differ by, and not the rest."""
    found = np.array([plant_inside(*printed) for printed in (FAST, SLOW)])
    margin = np.array([rounding_margin(*printed) for printed in (FAST, SLOW)])
    assert np.all(np.abs(found[0] - found[1]) < margin.sum(axis=0))
    assert np.all(np.abs(found - (2.555, 3.335)) > margin)
    # The mean weighted by the squares of the velocity gains, as the projection weighs, is allowed.
    weights = np.array([1 / 3.61, 1 / 3.06]) ** 2
    weighted = weights @ [(2.66, 3.61), (2.45, 3.06)] / weights.sum()
    assert np.all(np.abs(found - weighted) < margin)


def test_rounding_margin_bounds_random_roundings():
    random = np.random.default_rng(1)
    middle, margin = np.array(plant_inside(*SLOW)), np.array(rounding_margin(*SLOW))
    for _ in range(50):
        last = [10 ** (np.floor(np.log10(np.array(c))) - 3) * (np.array(c) != 1) for c in SLOW]
        moved = [c + random.uniform(-0.5, 0.5, len(c)) * d for c, d in zip(SLOW, last, strict=True)]
        assert np.all(np.abs(np.array(plant_inside(*moved)) - middle) <= 1.01 * margin)


@pytest.mark.parametrize(("top", "low"), [([1, 1], [1, 2]), ([], [1, 2]), ([1], [1])])
def test_filters_that_are_not_strictly_proper_are_refused(top, low):
    with pytest.raises(InvalidInputError, match="lower degree"):
        filter_state_space(top, low)
