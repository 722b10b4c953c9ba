"""The rounding of printed inputs is carried: by interval arithmetic, and by brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.companion.printed import Printed, carried, decimals


@pytest.mark.parametrize(
    ("text", "half"),
    [("96", 0.5), ("0.5", 0.05), ("2.500", 0.0005), ("2.52e5", 500), ("-1.99", 0.005)],
)
def test_half_a_unit_of_the_last_place(text, half):
    assert Printed(text).half == pytest.approx(half, rel=1e-12)
    assert Printed(text) == float(text)


@given(st.decimals(min_value=-1000, max_value=1000, places=3))
def test_decimals_are_those_written(number):
    assert decimals(str(number)) == 3


def test_what_nobody_has_rounded_stays():
    spread = carried(lambda n, step: n * step, {"n": Printed("9", exact=True), "step": 10})
    assert (spread.low, spread.value, spread.high) == (90, 90, 90)


@given(st.floats(0.1, 9), st.floats(0.1, 9))
def test_a_quotient_lies_between_its_corners(part, whole):
    a, b = Printed(f"{part:.2f}"), Printed(f"{whole:.2f}")
    spread = carried(lambda part, whole: part / whole, {"part": a, "whole": b})
    assert spread.low == pytest.approx((a - 0.005) / (b + 0.005), rel=1e-12)
    assert spread.high == pytest.approx((a + 0.005) / (b - 0.005), rel=1e-12)


def test_many_inputs_are_moved_where_their_slopes_point():
    def weighted(values):
        return sum((-1) ** k * (k + 1) * value for k, value in enumerate(values))

    spread = carried(weighted, {"values": [Printed("1.0")] * 12})
    reach = 0.05 * sum(range(1, 13))
    assert [spread.low, spread.high] == pytest.approx([-6 - reach, -6 + reach], rel=1e-12)


def test_printed_defaults_and_nested_tables_are_moved_too():
    def product(table, scale=Printed("2.0")):
        return table["rows"][0] * scale

    spread = carried(product, {"table": {"rows": [Printed("3")]}})
    assert (spread.low, spread.high) == (2.5 * 1.95, 3.5 * 2.05)


@given(st.lists(st.floats(-5, 5), min_size=2, max_size=4), st.integers(0, 2**32 - 1))
def test_a_monotone_function_stays_within_its_spread(centres, seed):
    values = [Printed(f"{x:.1f}") for x in centres]

    def rising(values):
        return float(np.sum(np.exp(np.asarray(values) / 3)))

    spread = carried(rising, {"values": values})
    chance = np.random.default_rng(seed)
    for _ in range(20):
        drawn = [v + chance.uniform(-1, 1) * v.half for v in values]
        assert spread.low - 1e-12 <= rising(drawn) <= spread.high + 1e-12
