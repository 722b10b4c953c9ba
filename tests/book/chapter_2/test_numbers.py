"""What recomputes Chapter 2's numbers: by hand, by brute force, and against what is kept."""

from itertools import product

import numpy as np
import pytest

from book.chapter_2 import numbers
from book.companion.claims import read_claims
from softgrip.materials.facts import facts
from softgrip.tactile.element import SHAPES
from softgrip.tactile.element_results import fem_deformation
from softgrip.tactile.element_sensitivity import least_force
from softgrip.tactile.element_table import ASSUMED
from softgrip.units import MM

PIECES = (1, 2, 5, 10, 20, 50, 70)


@pytest.mark.parametrize("twice", [(), (2, 20)])
def test_weights_are_made_of_pieces_as_by_trying_all(twice):
    made = {}
    held = (*PIECES, *twice)
    for choice in product((0, 1), repeat=len(held)):
        if 2 <= sum(choice) <= 3:
            total = sum(piece for piece, chosen in zip(held, choice, strict=True) if chosen)
            made[total] = True
    for wanted in (1, 2.5, 4, 14, 40, 45, 66, 130):
        found = numbers.nearest_weight(wanted, PIECES, (2, 3), twice)
        assert found in made
        assert abs(found - wanted) == min(abs(total - wanted) for total in made)


def test_a_share_of_a_count_is_one_that_the_count_can_have():
    # Four fifths of 630 are 504; 486 of them right.
    assert numbers.share_of_a_count(96.43, 630, 80) == pytest.approx(100 * 486 / 504)
    # No whole number of 80 contacts is 93 %; 74 are nearest.
    assert numbers.share_of_a_count(93.0, 80) == pytest.approx(92.5)


def test_mean_deviation_by_hand():
    deviations = {"coin": 1.0, "egg": 3.0}
    assert numbers.mean_deviation(deviations) == pytest.approx(2 * 9.80665e-3)
    assert numbers.mean_deviation(deviations, without="egg") == pytest.approx(9.80665e-3)


def test_a_weight_some_deviations_off_by_hand():
    assert numbers.newtons(100) == pytest.approx(0.980665)
    assert numbers.newtons(16.0, 2.0, -1) == pytest.approx(14 * 9.80665e-3)


def test_contact_forces_are_as_lift_forces_whatever_the_friction():
    assert numbers.pressed(0.7, 0.19, 0.09) == pytest.approx(0.7 * 0.09 / 0.19)


def test_secant_modulus_is_near_that_of_the_test_itself():
    test = facts()["Ecoflex 00-30"]
    found = 1e6 * numbers.secant_modulus("Ecoflex 00-30", 1.0)
    # The law is fitted up to the peak at a strain of 16, not to this one.
    assert found == pytest.approx(test.hundred_percent_modulus, rel=0.2)
    # At twice the length the cross-section is half.
    true = numbers.secant_modulus("Ecoflex 00-30", 1.0, stress="true")
    assert 1e6 * true == pytest.approx(2 * found)
    # Small strains: six times the first coefficient.
    assert 1e6 * numbers.secant_modulus("Ecoflex 00-30", 1e-6) == pytest.approx(
        6 * test.yeoh_1, rel=1e-4
    )


@pytest.mark.parametrize("shape", ["hemisphere", "pyramid"])
def test_cut_elements_are_those_that_are_kept(shape):
    # Another mesh, and a sphere that is stretched by 0.4 % rather than cut.
    swept = numbers.cut_by_finite_elements(0.1, shape, 0.125, ASSUMED[shape].cut)
    assert swept == pytest.approx(fem_deformation(ASSUMED[shape], 0.1) / MM, rel=2e-3)


@pytest.mark.parametrize("shape", SHAPES)
def test_least_forces_by_deformation_are_those_of_the_skin(shape):
    """There from a law of the skin's resistance, here from two deformations under one load."""
    change = 1e2  # Ohm: small beside the 1 MOhm at rest, so that all is linear
    felt = {name: least_force(element, change) for name, element in ASSUMED.items()}
    given = {name: 0.1 * 1e-3 * ASSUMED[name].height / felt[name] for name in felt}
    found = numbers.least_force_by_deformation(felt["pyramid"], given["pyramid"], given[shape], 1)
    # The heights differ by 0.4 %, and it is the strain that the skin feels.
    assert found == pytest.approx(felt[shape], rel=5e-3)


def test_analytic_rows_come_out_with_what_they_ask_for():
    """Of Table 2.1 at 0.1 N, in closed form by hand."""
    assert numbers.cylinder_by_equation(0.1, 0.1, 10.0, 3.0) == pytest.approx(0.038197, 1e-4)
    assert numbers.pyramid_by_equation(0.1, 0.1, 6.0, 3.0, 0.12) == pytest.approx(
        0.1 * 3 / (0.1 * 36 * 0.12)
    )


def test_no_one_size_brings_out_both_rows_with_the_stated_modulus():
    """As the note to the cylinder's row in the ledger says; Table 2.1 at 0.1 N, in mm."""
    found = set()
    for radius in np.geomspace(0.1, 100.0, 4001):
        cylinder = numbers.cylinder_by_equation(0.1, 0.125, 2 * radius, radius)
        hertz = numbers.hertzian(0.1, 0.125, 0.49, 2 * radius)
        # Radii lie 0.2 % apart, the prints far more: 2 % each is wide enough to miss nothing.
        found.add((abs(cylinder / 0.038 - 1) < 0.02, abs(hertz / 0.477 - 1) < 0.02))
    assert found == {(False, False), (True, False), (False, True)}


def test_what_the_claims_count_is_listed_once():
    """A count of a list that holds something twice would be no count."""
    counted = [claim for claim in read_claims(2) if claim.function == "number_of"]
    assert counted
    for claim in counted:
        values = claim.arguments["values"]
        assert len({*values}) == len(values), claim.id


def test_shape_that_deforms_twice_as_much_and_needs_half_the_deformation_feels_a_quarter():
    assert numbers.least_force_by_deformation(0.01, 0.7, 1.4, threshold=0.5) == 0.0025
