"""Tables 3.1 to 3.4 as they are read."""

import pytest

from softgrip.actuator.printed import section, table_3_1, table_3_2, table_3_3, table_3_4
from softgrip.errors import UnknownNameError


def test_all_rows_are_there():
    assert len(table_3_1()) == 7
    assert [row.measured for row in table_3_2()] == [2.86, 2.49, 2.26, 1.83]
    assert [row.estimated for row in table_3_3().values()] == [2.62, 2.62, 2.01]
    assert len(table_3_4()) == 9


def test_heights_are_constant_over_the_variances():
    assert {round(s.height, 9) for s in table_3_1().values()} == {0.024}


def test_unknown_section_lists_those_that_are():
    with pytest.raises(UnknownNameError, match="Variance 6"):
        section("Variance 7")


def test_four_designs_of_table_3_4_bend_further_and_two_push_harder():
    """As its caption says."""
    own, *others = (
        [float(row[key].strip("~> ")) for key in ("torque", "angle")] for row in table_3_4()
    )
    assert sum(other[1] > own[1] for other in others) == 4
    assert sum(other[0] > own[0] for other in others) == 2
