"""Eq. (2.8) and Eq. (2.9) undo each other, and which coefficients printed forces leave open."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.friction import (
    Interval,
    PrintedGrasp,
    common_friction,
    contact_force,
    friction_interval,
    holding_probability,
    intersection,
    lift_force,
    printed_grasps,
)


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


FORCES = st.floats(1e-3, 10)


@given(force=FORCES, friction=st.floats(0.01, 10))
def test_equations_undo_each_other(force, friction):
    """Eq. (2.9) is the inverse of the force that each finger must press with."""
    assert lift_force(contact_force(force, friction), friction) == pytest.approx(force, rel=1e-12)


@given(force=FORCES, friction=st.floats(0.01, 10))
def test_friction_of_two_fingers_balances_the_lift_force(force, friction):
    """Eq. (2.8) by Coulomb: each of two fingers bears friction times the force on it."""
    pressed = contact_force(force, friction)
    assert friction * pressed + friction * pressed == pytest.approx(force, rel=1e-12)


def test_arrays_are_taken():
    assert contact_force(np.array([0.6, 1.2]), 1.0).tolist() == [0.3, 0.6]


def test_probability_is_the_share_of_drawn_grasps():
    weight, friction, error = 0.165, 1.0, 0.015
    drawn = 0.19 / (2 * friction) + error * np.random.default_rng(1).standard_normal(40_000)
    share = np.mean(2 * friction * drawn >= weight)
    # Five deviations of a share of 40 000.
    found = holding_probability(0.19, weight, friction, error)
    assert found == pytest.approx(share, abs=5 * 0.5 / 200)
    assert 0.6 < found < 0.9


@pytest.mark.parametrize("friction", [0.0, -1.0, float("nan")])
def test_friction_that_cannot_be_is_refused(friction):
    for equation in (contact_force, lift_force):
        with pytest.raises(InvalidInputError, match="friction"):
            equation(1.0, friction)


def test_error_and_weight_that_cannot_be_are_refused():
    with pytest.raises(InvalidInputError, match="error"):
        holding_probability(1.0, 1.0, 1.0, error=0.0)
    with pytest.raises(InvalidInputError, match="weight"):
        holding_probability(1.0, -1.0, 1.0, error=0.1)
