"""Table 2.1: its cells against each other, and the rows that named inputs bring out."""

import numpy as np
import pytest

from softgrip.tactile.element import STATED_MODULUS, TABLE_MODULUS, Element, compliance, shortening
from softgrip.tactile.element_table import ASSUMED, FORCES, table_2_1
from softgrip.tactile.hertz import hertz_approach
from softgrip.units import MM, MPa

ROWS = table_2_1()


def cells(values):
    return tuple(f"{value / MM:.3f}" for value in values)


@pytest.mark.parametrize("key", [key for key in ROWS if key[1] != "Hertzian"])
def test_linear_rows_are_linear_to_the_last_digit(key):
    low, high = ROWS[key].coefficient()
    # The pyramid's finite elements allow one number only, 6.675 mm/N: no interval but for rounding.
    assert low <= high * (1 + 1e-9)


def test_hertzian_row_is_the_power_two_thirds_and_not_linear():
    low, high = ROWS["hemisphere", "Hertzian"].coefficient(2 / 3)
    assert low < high
    low, high = ROWS["hemisphere", "Hertzian"].coefficient()
    assert low > high


@pytest.mark.parametrize("shape", ASSUMED)
def test_analytic_rows_come_out_of_the_assumed_elements(shape):
    found = shortening(ASSUMED[shape], np.array(FORCES), TABLE_MODULUS)
    assert cells(found) == ROWS[shape, "Analytics"].cells


def test_no_analytic_row_comes_out_of_the_stated_modulus():
    for shape, element in ASSUMED.items():
        found = shortening(element, np.array(FORCES), STATED_MODULUS)
        assert not set(cells(found)) & set(ROWS[shape, "Analytics"].cells)


def test_hertzian_row_comes_out_with_a_tenth_of_a_megapascal():
    found = hertz_approach(np.array(FORCES), young_modulus=TABLE_MODULUS)
    assert cells(found) == ROWS["hemisphere", "Hertzian"].cells


def test_hertzian_row_allows_no_other_modulus_at_the_stated_radius():
    """With radius 3 mm the row fixes E to 0.1 MPa within 0.04 %."""
    low, high = ROWS["hemisphere", "Hertzian"].coefficient(2 / 3)
    unit = hertz_approach(1.0, young_modulus=1 * MPa) / MM
    # E goes with the coefficient's power -3/2.
    least, largest = (high / unit) ** -1.5, (low / unit) ** -1.5
    assert least < TABLE_MODULUS / MPa < largest
    assert largest / least - 1 < 4e-4


def test_stated_cylinder_by_hand():
    # 0.1 N over pi (3 mm)^2 = 28.27 mm^2 is 3537 Pa: a strain of 0.0283 of 3 mm.
    found = 0.1 * compliance(Element("cylinder"), STATED_MODULUS) / MM
    assert found == pytest.approx(0.08488, abs=5e-6)
