"""Table 5.1 as it is read: units, order, names."""

import numpy as np
import pytest

from softgrip.errors import UnknownNameError
from softgrip.materials import table


def test_ten_materials_in_the_printed_order():
    names = list(table.table_5_1())
    assert len(names) == 10
    assert (names[0], names[-1]) == ("Dragon Skin FX Pro", "SORTA-Clear 40")


def test_row_is_in_si():
    assert table.material("Dragon Skin 10 MEDIUM") == table.Material(
        "Dragon Skin 10 MEDIUM",
        fractional_power=2.174,
        young_modulus=150e3,
        mixed_viscosity=23.0,
        tensile_strength=3.28e6,
    )


def test_fractional_powers_are_reciprocals_of_two_decimals():
    """Eq. (5.5): they were read off as m = 1/n; a misread digit would show here."""
    n = table.fractional_powers(table.table_5_1().values())
    m = np.round(1 / n, 2)
    np.testing.assert_array_equal(np.round(1 / m, 3), n)


def test_properties_have_one_row_a_material():
    X = table.properties(table.material(name) for name in table.HELD_OUT)
    np.testing.assert_array_equal(X, [[0.34e6, 20, 3.79e6], [0.26e6, 18, 1.99e6]])
    assert table.properties([]).shape == (0, 3)


def test_unknown_name_lists_the_valid_ones():
    with pytest.raises(UnknownNameError, match=r"'Ecoflex 50'; valid are: .*Ecoflex 00-50"):
        table.material("Ecoflex 50")


def test_table_cannot_be_changed():
    with pytest.raises(TypeError):
        table.table_5_1()["new"] = table.material("Dragon Skin 20")
