"""Interval bounds hold what the function does in a box, and close in on it."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.actuator.enclosure import enclosed
from softgrip.errors import InvalidInputError

X, P = ca.SX.sym("x", 2), ca.SX.sym("p")
U, V = ca.vertsplit(X)
OF_ANY_SIGN = ca.vertcat(U * V - U, (U - V) ** 2, -2 * U + V, U * P - V, (U - V) * (U + P))
OF_POSITIVE = ca.vertcat(
    U / V, ca.log(U) - ca.exp(-V), ca.sqrt(U * V), U**P / V, 1 / (U + V), U**1.5, P**2 / U
)

ends = st.tuples(st.floats(-3, 3), st.floats(0, 2), st.floats(-3, 3), st.floats(0, 2))


LAWS = {
    name: ca.Function(name, [X, P], [law])
    for name, law in {"any": OF_ANY_SIGN, "positive": OF_POSITIVE}.items()
}
BOUNDS = {
    (name, positive): enclosed(law, 1, positive=positive)
    for name, law in LAWS.items()
    for positive in (0, 1, 2)
}


def _holds(law, low, high, known, positive=0):
    function = LAWS[law]
    bounds = BOUNDS[law, positive](low, high, known)
    least, largest = (np.array(end).ravel() for end in bounds)
    share = np.random.default_rng(0).random((2, 200))
    points = np.array(low)[:, None] + share * (np.array(high) - np.array(low))[:, None]
    found = np.array(function(points, known))
    room = 1e-9 * (1 + np.abs(found))
    assert (found >= least[:, None] - room).all()
    assert (found <= largest[:, None] + room).all()


@given(ends, st.floats(-2, 2))
def test_no_value_lies_outside(box, known):
    a, wide, b, long = box
    _holds("any", [a, b], [a + wide, b + long], known)


@given(ends, st.floats(0.1, 2))
def test_no_value_of_positive_numbers_lies_outside(box, known):
    a, wide, b, long = box
    a, b = abs(a) + 0.1, abs(b) + 0.1
    for positive in (0, 1, 2):
        _holds("positive", [a, b], [a + wide, b + long], known, positive)
        _holds("any", [a, b], [a + wide, b + long], known, positive)


def test_knowing_a_sign_changes_no_bound():
    function = ca.Function("f", [X, P], [ca.vertcat(OF_POSITIVE, OF_ANY_SIGN)])
    box = [0.5, 1.2], [0.9, 2.0], 1.4
    plain, told = enclosed(function, 1)(*box), enclosed(function, 1, positive=2)(*box)
    for one, other in zip(plain, told, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-14)


def test_a_point_has_its_value():
    function = ca.Function("f", [X, P], [OF_POSITIVE])
    least, largest = enclosed(function, 1)([1.3, 0.7], [1.3, 0.7], 1.9)
    expected = np.array(function([1.3, 0.7], 1.9))
    np.testing.assert_allclose(least, expected, rtol=1e-14)
    np.testing.assert_allclose(largest, expected, rtol=1e-14)


def test_what_may_be_divided_by_nothing_is_unbounded():
    bounds = enclosed(ca.Function("f", [X], [U / V]), 1)([1.0, -1.0], [2.0, 1.0])
    assert [float(end) for end in bounds] == [-np.inf, np.inf]


def test_another_instruction_is_refused():
    with pytest.raises(InvalidInputError, match="sums, products"):
        enclosed(ca.Function("f", [X], [ca.sin(U)]), 1)
