"""The layout of the pad against the printed sizes."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.tactile.pad_layout import ELEMENT_SIDE, PAD_SIZE, THREE_TWO_THREE, PadLayout, rows
from softgrip.units import MM


def test_eight_elements_fit_into_the_printed_pad():
    """Section 2.2: eight elements of 6 mm x 6 mm in 40 mm x 38 mm."""
    assert THREE_TWO_THREE.elements == 8
    edge = np.abs(THREE_TWO_THREE.places).max(axis=0) + ELEMENT_SIDE / 2
    assert (edge < np.array(PAD_SIZE) / 2).all()


def test_layout_is_the_same_turned_by_half():
    places = THREE_TWO_THREE.places
    np.testing.assert_allclose(places[::-1], -places, atol=1e-15)


@pytest.mark.parametrize(
    "places", [[[0, 0]], [[0, 0], [0.005, 0]], [[0, 0], [np.nan, 0]], [[0, 0, 0], [1, 1, 1]]]
)
def test_elements_that_touch_or_are_nowhere_are_refused(places):
    with pytest.raises(InvalidInputError, match="places"):
        PadLayout(np.array(places, dtype=float))


def test_rows_are_set_about_the_middle():
    made = rows((2, 3, 2), 10 * MM, 8 * MM)
    np.testing.assert_allclose(made.places.mean(axis=0), 0, atol=1e-15)
    assert made.places[:2, 1] == pytest.approx(8 * MM)
