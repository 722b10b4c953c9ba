"""Eq. (2.6) and Eq. (2.7) against sums written out, and the fast sums against their bound."""

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import norm

from softgrip.errors import InvalidInputError
from softgrip.tactile.kernel_average import (
    BLOCK,
    BOUND,
    EXPONENT,
    MARGIN,
    blocks,
    exact_average,
    fast_average,
    gaussian,
    moments,
    plan,
)

ROUNDING = 1e-13
"""Of sums over up to 200 terms and exponents up to 50, each with an error of 1e-16."""


def written_out(query, points, targets, bandwidth):
    """Return Eq. (2.6) with sums that do not round (math.fsum), one query."""
    exponents = [-(((query - x) / bandwidth) ** 2) / 2 for x in points]
    weights = [math.exp(e - max(exponents)) for e in exponents]
    pairs = zip(weights, targets, strict=True)
    return math.fsum(w * y for w, y in pairs) / math.fsum(weights)


def both(queries, points, targets, bandwidth):
    return (
        fast_average(queries, points, targets, bandwidth),
        exact_average(queries[:, None], points[:, None], targets, bandwidth),
    )


def test_fast_average_is_that_of_forty_digits():
    rng = np.random.default_rng(7)
    points, targets = rng.random(30) ** 2, rng.normal(size=30)
    queries = rng.uniform(-0.3, 1.3, 50_000)
    bandwidth = 0.02
    found = fast_average(queries, points, targets, bandwidth)
    with localcontext() as context:
        context.prec = 40
        for k in range(0, 50_000, 2500):
            apart = [(Decimal(queries[k]) - Decimal(x)) / Decimal(bandwidth) for x in points]
            weights = [(-(d**2) / 2).exp() for d in apart]
            aimed = sum(w * Decimal(y) for w, y in zip(weights, targets, strict=True))
            expected = float(aimed / sum(weights))
            assert abs(found[k] - expected) <= (BOUND + ROUNDING) * np.ptp(targets)


def test_three_points_by_hand():
    """Eq. (2.6): the third point adds exp(-9/8) / (2 exp(-1/8)) = 1 / (2 e) to the two beside."""
    found = exact_average(np.array([[0.5]]), np.array([[0.0], [1], [2]]), np.array([0.0, 1, 5]), 1)
    expected = (1 + 5 * math.exp(-1)) / (2 + math.exp(-1))
    assert found == pytest.approx([expected], rel=1e-14)


def test_weights_are_in_the_ratio_of_a_normal_density():
    """Eq. (2.7), by SciPy; the common factor cancels in the average."""
    squares = np.array([[0.2, 1.0, 9.0]])
    density = norm.pdf(np.sqrt(squares))
    assert gaussian(squares) == pytest.approx(density / density.max(), rel=1e-12)


def test_exact_average_is_that_of_sums_written_out():
    rng = np.random.default_rng(1)
    points, targets = rng.random(50), rng.normal(size=50)
    queries = np.linspace(-1, 2, 40)
    found = exact_average(queries[:, None], points[:, None], targets, 0.05)
    expected = [written_out(q, points, targets, 0.05) for q in queries]
    np.testing.assert_allclose(found, expected, rtol=0, atol=ROUNDING * np.ptp(targets))


@settings(max_examples=100)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(2, 200),
    bandwidth=st.floats(-2.5, 1).map(lambda e: 10.0**e),
    power=st.sampled_from([0.2, 1.0, 5.0]),
    middle=st.sampled_from([0.0, 30.0]),
)
def test_fast_average_keeps_its_bound(seed, count, bandwidth, power, middle):
    # Powers spread the points evenly or crowd them at an end, with wide gaps between.
    rng = np.random.default_rng(seed)
    points = middle + rng.random(count) ** power
    targets = rng.normal(size=count) + 1e3
    queries = middle + rng.uniform(-0.5, 1.5, 8000)
    fast, exact = both(queries, points, targets, bandwidth)
    assert abs(fast - exact).max() <= (BOUND + ROUNDING) * np.ptp(targets) + 1e-12


def test_series_are_used_where_they_should_be():
    # Without this, the bound above could be kept by exact sums alone.
    points = np.linspace(0, 1, 69)
    queries = np.linspace(0, 1, 100_000)
    assert plan(queries, points, 0.02).count < 1000
    assert plan(queries[::1000], points, 0.02) is None
    assert plan(queries, points, 1e-7) is None
    assert plan(queries, np.zeros(69), 0.02) is None


@pytest.mark.parametrize("terms", [2, 3, 4, 6])
def test_series_cut_short_errs_by_its_bound_and_not_by_much_less(terms):
    # Two points at the ends of the spread that is planned for: the worst that there can be.
    points, targets, queries = (
        np.array([0.0, 1.0]),
        np.array([-1.0, 1.0]),
        np.linspace(0, 1, 50_000),
    )
    cells = plan(queries, points, 0.1)
    centre, below, above = moments(cells, points, targets, 0.1)
    powers = (cells.half / 0.1) ** np.arange(terms)
    exact = exact_average((centre + cells.half)[:, None], points[:, None], targets, 0.1)
    error = abs(powers @ above[:terms] / (powers @ below[:terms]) - exact).max()
    part = math.exp(EXPONENT) * EXPONENT**terms / math.factorial(terms)
    assert 0.05 * part < error / np.ptp(targets) < part / (1 - part)


def test_queries_far_beyond_the_points_get_the_end_points():
    points, targets = np.linspace(0, 1, 20), np.arange(20.0)
    far = np.array([-1e6, -50, 50, 1e6])
    queries = np.concatenate([np.linspace(0, 1, 50_000), far])
    fast, exact = both(queries, points, targets, 0.01)
    np.testing.assert_array_equal(fast[-4:], [0, 0, 19, 19])
    np.testing.assert_allclose(fast, exact, rtol=0, atol=1e-12 * 19)


def test_gap_whose_weights_all_underflow():
    # 50 bandwidths from both points, exp(-1250) is no number; the nearer one must win.
    queries, points = np.linspace(0, 2, 900_001), np.array([0.0, 2.0])
    assert plan(queries, points, 0.02).count > 5000
    fast = fast_average(queries, points, np.array([1.0, 3.0]), 0.02)
    np.testing.assert_allclose(fast[queries < 0.99], 1, rtol=1e-12)
    np.testing.assert_allclose(fast[queries > 1.01], 3, rtol=1e-12)
    assert fast[450_000] == pytest.approx(2, rel=1e-9)


def test_wide_gap_within_the_cells():
    # 20 bandwidths on both sides: exp(-200) is a tiny number, the sum of the rest still right.
    queries = np.linspace(-1, 5, 400_000)
    points = np.array([0.0, 0.1, 4.1, 4.2])
    targets = np.array([1.0, 2.0, -3.0, 4.0])
    assert plan(queries, points, 0.1) is not None
    fast, exact = both(queries, points, targets, 0.1)
    assert abs(fast - exact).max() < (BOUND + ROUNDING) * 7


def test_margin_is_within_the_spread_that_is_planned():
    # Beyond the ends only one side counts, so that the cells of the middle are narrow enough.
    queries = np.linspace(-MARGIN, 1 + MARGIN, 300_000)
    points = np.linspace(0, 1, 30)
    fast, exact = both(queries, points, points**2, 1.0)
    assert abs(fast - exact).max() < BOUND + ROUNDING


def test_blocks_hold_no_more_than_they_may_or_one_row():
    assert [*blocks(3, BLOCK // 2)] == [slice(0, 2), slice(2, 3)]
    assert [*blocks(2, 2 * BLOCK)] == [slice(0, 1), slice(1, 2)]


def test_compact_kernel_falls_to_the_nearest_points():
    points, targets = np.array([[0.0], [1.0], [1.0]]), np.array([3.0, 5.0, 7.0])
    found = exact_average(np.array([[0.1], [0.45], [9.0]]), points, targets, 0.2, "epanechnikov")
    np.testing.assert_allclose(found, [3, 3, 6])


def test_distance_without_a_square_is_refused():
    with pytest.raises(InvalidInputError, match="1e150"):
        exact_average(np.array([[1e200]]), np.array([[0.0]]), np.array([1.0]), 1.0)
