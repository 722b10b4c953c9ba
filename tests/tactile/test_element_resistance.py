"""The skin's resistance: its range, its slope at rest, the film by hand, and refusals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.element_resistance import AT_REST, CEILING, resistance
from softgrip.units import MM


def test_range_is_the_printed_one():
    assert resistance(0.0) == 1.0e6
    assert resistance(3 * MM) == resistance(1.0) == pytest.approx(1.5e6)


@given(part=st.floats(0, 0.33))
def test_film_keeps_its_volume(part):
    """Square of side a and thickness t: R = rho a / (a t), and a a t stays, as does a a h."""
    side = 1 / np.sqrt(1 - part)
    thickness = 1 / side**2
    assert resistance(part * 3 * MM) / AT_REST == pytest.approx(side / (side * thickness))


@given(st.lists(st.floats(0, 5e-3), min_size=2))
def test_rises_and_stays_in_range(shortening):
    found = resistance(np.sort(shortening))
    assert (np.diff(found) >= 0).all()
    assert (found >= AT_REST).all()
    assert (found <= CEILING * (1 + 1e-12)).all()


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        ({"shortening": -1e-3}, "shortening: expected m, >= 0"),
        ({"shortening": np.array([np.nan])}, "shortening"),
        ({"shortening": 0.0, "height": 0.0}, "height"),
        ({"shortening": 0.0, "ceiling": 1.0}, "ceiling"),
    ],
)
def test_bad_input_is_refused(given_, message):
    with pytest.raises(InvalidInputError, match=message):
        resistance(**given_)
