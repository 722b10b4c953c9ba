"""Eq. (2.8) and (2.9): they are each other's inverse, and hold as often as chance says."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.lift import contact_force, holding_probability, lift_force

FORCES = st.floats(1e-3, 10)


@given(force=FORCES, friction=st.floats(0.01, 10))
def test_equations_undo_each_other(force, friction):
    assert lift_force(contact_force(force, friction), friction) == pytest.approx(force, rel=1e-12)


@given(force=FORCES, friction=st.floats(0.01, 10))
def test_friction_of_two_fingers_balances_the_lift_force(force, friction):
    """Coulomb: each of two fingers bears friction times the force that presses it."""
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
