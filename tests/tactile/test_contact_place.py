"""The centroid of responses: hand calculations, and what must hold for any."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_place import FELT, place
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.tactile.pad_layout import rows

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
