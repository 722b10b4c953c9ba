"""Coefficients behind printed forces: no rounded pair lies outside, the ends are reached."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.friction import (
    Interval,
    PrintedGrasp,
    common_friction,
    friction_interval,
    intersection,
    printed_grasps,
)
from softgrip.tactile.lift import lift_force


@given(contact=st.floats(0.06, 0.7), friction=st.floats(0.3, 2))
def test_true_coefficient_is_within_what_its_rounded_forces_leave(contact, friction):
    lift = lift_force(contact, friction)
    given_strings = PrintedGrasp(f"{contact:.2f}", f"{lift:.2f}", "0")
    found = given_strings.friction
    # A number on the edge of its print may be off by the error of the division.
    assert found.low - 1e-9 <= friction <= found.high + 1e-9


def test_ends_are_reached_by_the_forces_at_the_ends():
    contact, lift = Interval.of_print("0.08"), Interval.of_print("0.15")
    found = friction_interval(contact, lift)
    assert lift_force(contact.high, found.low) == pytest.approx(lift.low)
    assert lift_force(contact.low, found.high) == pytest.approx(lift.high)


@pytest.mark.parametrize(
    ("name", "low", "high"),
    # By hand: 0.65/0.70 and 0.75/0.50; 0.185/0.19 and 0.195/0.17; 0.145/0.17 and 0.155/0.15.
    [("egg", 0.929, 1.5), ("tofu", 0.974, 1.147), ("carrot", 0.853, 1.033)],
)
def test_printed_pairs_by_hand(name, low, high):
    found = printed_grasps()[name].friction
    assert (found.low, found.high) == pytest.approx((low, high), abs=5e-4)


def test_one_coefficient_agrees_with_all_three_but_not_as_the_numbers_stand():
    common = common_friction()
    assert (common.low, common.high) == pytest.approx((0.974, 1.033), abs=5e-4)
    plain = [float(g.lift) / (2 * float(g.contact)) for g in printed_grasps().values()]
    assert not all(common.low <= friction <= common.high for friction in plain)


def test_other_order_of_weights_would_exceed_what_is_lifted():
    """The text's order of objects is the one in which each lift force exceeds the weight."""
    grasps = printed_grasps()
    assert all(float(g.lift) > float(g.weight) for g in grasps.values())
    assert float(grasps["carrot"].lift) < float(grasps["tofu"].weight)


def test_intervals_apart_have_nothing_in_common():
    assert intersection([Interval(0, 1), Interval(2, 3)]) is None
    assert intersection([Interval(0, 2), Interval(1, 3)]) == Interval(1, 2)
    with pytest.raises(InvalidInputError, match="intervals"):
        intersection([])


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [("0.165", 0.1645, 0.1655), ("70", 69.5, 70.5), ("0", 0, 0.5), ("1e-2", 0.005, 0.015)],
)
def test_rounding_of_a_print(text, low, high):
    assert Interval.of_print(text) == Interval(low, high)


@pytest.mark.parametrize("text", ["", "egg", "-0.1", "nan"])
def test_text_that_is_no_force_is_refused(text):
    with pytest.raises(InvalidInputError, match="text"):
        Interval.of_print(text)


def test_contact_force_that_may_be_zero_is_refused():
    with pytest.raises(InvalidInputError, match="contact_force"):
        friction_interval(Interval.of_print("0"), Interval.of_print("0.1"))
