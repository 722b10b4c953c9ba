"""Centroid and principal axis: by hand, against NumPy's covariance, and what holds for any."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_pose import FELT, angle_between, line_angle, place, place_errors
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.tactile.pad_layout import rows
from softgrip.units import DEG

some = arrays(np.float64, 8, elements=st.floats(0, 1))


@pytest.mark.parametrize("k", range(8))
def test_one_element_is_found_in_its_middle(k):
    np.testing.assert_allclose(place(0.3 * np.eye(8)[k], PAD), PAD.places[k], atol=1e-15)


def test_three_to_one_is_a_quarter_of_the_way():
    felt = np.zeros(8)
    felt[[0, 2]] = 0.6, 0.2
    # From -11 mm, a quarter of 22 mm: by hand.
    np.testing.assert_allclose(place(felt, PAD), [-5.5e-3, 10e-3], atol=1e-15)


@given(responses=some)
def test_place_is_the_weighted_mean_and_within_the_elements(responses):
    found = place(responses, PAD)
    felt = responses > FELT
    if not felt.any():
        assert np.isnan(found).all()
        return
    mean = np.average(PAD.places[felt], axis=0, weights=responses[felt])
    np.testing.assert_allclose(found, mean, atol=1e-12)
    assert (np.abs(found) <= np.abs(PAD.places).max(axis=0) + 1e-12).all()


@given(responses=some)
def test_turned_pad_gives_the_turned_place(responses):
    # Half a turn exchanges the first element with the last, and so on.
    np.testing.assert_allclose(
        place(responses[::-1], PAD), -place(responses, PAD), atol=1e-12, equal_nan=True
    )


def test_many_are_found_as_one_by_one():
    many = np.random.default_rng(1).uniform(0, 1, (4, 5, 8))
    one_by_one = [[place(row, PAD) for row in rows_] for rows_ in many]
    np.testing.assert_allclose(place(many, PAD), one_by_one, atol=1e-15)


def test_layout_of_another_size_takes_as_many_channels():
    layout = rows((2, 2), 0.01, 0.01)
    assert place([1, 1, 1, 1], layout) == pytest.approx([0, 0], abs=1e-15)
    with pytest.raises(InvalidInputError, match="4 channels"):
        place([0.5] * 8, layout)


@pytest.mark.parametrize("value", [np.nan, -0.1, 1.5])
def test_response_that_is_none_is_refused(value):
    with pytest.raises(InvalidInputError, match="between 0 and 1"):
        place([value] + [0.0] * 7, PAD)


@given(responses=some)
def test_angle_is_that_of_the_first_principal_component(responses):
    felt = responses > FELT
    assume(felt.sum() >= 2)
    moments = np.cov(PAD.places[felt].T, aweights=responses[felt], bias=True)
    values, vectors = np.linalg.eigh(moments)
    # Near a round one, rounding chooses the direction.
    assume(values[1] - values[0] > 1e-6 * values[1])
    oracle = np.arctan2(*vectors[::-1, 1])
    assert angle_between(line_angle(responses, PAD), oracle) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize(
    ("pair", "degrees"), [((0, 2), 0), ((1, 6), 90), ((0, 3), -61.19), ((3, 5), 61.19)]
)
@given(weights=st.tuples(st.floats(0.06, 1), st.floats(0.06, 1)))
def test_two_elements_give_their_connection_whatever_they_say(pair, degrees, weights):
    responses = np.zeros(8)
    responses[list(pair)] = weights
    # By hand: arctan(10 / 5.5) = 61.19 deg.
    assert angle_between(line_angle(responses, PAD), degrees * DEG) < 0.01 * DEG


@pytest.mark.parametrize("felt", [0, 1])
def test_less_than_two_elements_say_no_angle(felt):
    assert np.isnan(line_angle(0.5 * (np.arange(8) < felt), PAD))


def test_square_says_no_angle():
    assert np.isnan(line_angle([0.5] * 4, rows((2, 2), 0.01, 0.01)))


def test_angles_between_lines():
    assert angle_between([0, 80 * DEG, 1.0], [90 * DEG, -80 * DEG, 1.0]) / DEG == pytest.approx(
        [90, 20, 0]
    )


def test_errors_are_by_hand():
    felt = np.zeros((3, 8))
    felt[0, 1], felt[1, [1, 6]] = 0.5, 0.5  # (0, 10) mm; the y axis
    found = place_errors(
        Contacts(
            felt, np.zeros(3), np.arange(3.0), ["point", "line", "surface"], ["a", "b", "c"],
            [[3e-3, 6e-3], [4e-3, 1e-3], [0, 0]], [np.nan, np.pi / 2, np.nan], [0.1, 0.1, 0.1],
        ),
        PAD,
    )  # fmt: skip
    # A 3-4-5 triangle; a line along y that is 4 mm off; nothing felt.
    np.testing.assert_allclose(found.place, [5e-3, 4e-3, np.nan], atol=1e-12)
    np.testing.assert_allclose(found.angle, [np.nan, 0, np.nan], atol=1e-12)
    assert found.elements.tolist() == [1, 2, 0]


@given(angle=st.floats(-1.5, 1.5), along=st.floats(-0.02, 0.02), off=st.floats(-0.02, 0.02))
def test_place_of_a_line_errs_by_what_is_square_to_it_alone(angle, along, off):
    line, square = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    felt = np.zeros((1, 8))
    felt[0, [0, 3]] = 0.5
    where = PAD.places[[0, 3]].mean(axis=0) + along * line + off * square
    found = place_errors(
        Contacts(felt, np.zeros(1), np.zeros(1), ["line"], ["a"], [where], [angle], [0.1]), PAD
    )
    np.testing.assert_allclose(found.place, [abs(off)], atol=1e-12)
