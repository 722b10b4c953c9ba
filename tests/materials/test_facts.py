"""What is kept of the tensile tests is what they give."""

from dataclasses import astuple

import pytest

from softgrip.materials import tensile
from softgrip.materials.facts import facts, measure_facts
from softgrip.materials.table import table_5_1


@pytest.mark.usefixtures("tensile_tests")
@pytest.mark.parametrize("name", table_5_1())
def test_kept_facts_are_what_the_test_gives(name):
    measured = astuple(measure_facts(tensile.load(name)))
    # Seven digits are kept; the cubic term of Yeoh's law is the worst conditioned.
    assert measured[0] == name
    assert measured[1:] == pytest.approx(astuple(facts()[name])[1:], rel=1e-5)


def test_modulus_of_the_table_is_above_the_stress_at_100_percent_strain():
    for name, material in table_5_1().items():
        assert facts()[name].hundred_percent_modulus < material.young_modulus
