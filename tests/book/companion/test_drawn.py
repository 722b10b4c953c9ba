"""What a figure draws is read back by the names of its series."""

import pytest

from book.companion.drawn import drawn
from softgrip.errors import UnknownNameError


def test_a_series_is_that_of_its_panel():
    first, second = (drawn("Figure 2.G", "as read", panel) for panel in ("(a)", "(b)"))
    assert (first[0].min(), second[0].min()) == (6, 0)  # min in the hour, h from the calibration
    assert [len(x) == len(y) == 5 for x, y in (first, second)] == [True, True]


def test_a_series_that_is_not_there_is_named():
    with pytest.raises(UnknownNameError, match="lines at both ends"):
        drawn("Figure 2.G", "as felt")
