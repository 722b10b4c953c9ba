"""Yeoh's law against its energy, and its fit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.materials import tensile, yeoh

STRAIN = np.linspace(0, 6, 60)
C = (2e4, 3e2, 2.0)
stretches = st.floats(0.3, 8)


def energy(stretch):
    x = stretch**2 + 2 / stretch - 3
    return C[0] * x + C[1] * x**2 + C[2] * x**3


@given(stretch=stretches)
def test_stress_is_the_slope_of_the_energy(stretch):
    h = 1e-5 * stretch
    slope = (energy(stretch + h) - energy(stretch - h)) / (2 * h)
    assert yeoh.stress(stretch, C) == pytest.approx(slope, rel=1e-5, abs=1)


@given(stretch=stretches, shear=st.floats(1e3, 1e6))
def test_one_coefficient_is_the_neo_hookean_law(stretch, shear):
    expected = pytest.approx(shear * (stretch - stretch**-2), rel=1e-9, abs=1e-6)
    assert yeoh.stress(stretch, (shear / 2,)) == expected


def test_slope_at_rest_is_three_times_the_shear_modulus():
    h = 1e-6
    assert yeoh.stress(1 + h, C) / h == pytest.approx(3 * 2 * C[0], rel=1e-4)


def test_fit_finds_the_law_that_made_the_curve():
    found = yeoh.fit(STRAIN, yeoh.stress(1 + STRAIN, C))
    assert found.coefficients == pytest.approx(C, rel=1e-8)
    assert found.rms_stress < 1e-3


@pytest.mark.usefixtures("tensile_tests")
def test_fit_of_a_measured_curve_is_close_and_stiff_at_rest():
    test = tensile.load("Ecoflex 00-30")
    found = yeoh.fit(test.strain, test.stress)
    assert found.rms_stress < 0.001 * test.stress.max()
    assert found.coefficients[0] > 0


@pytest.mark.parametrize("stretch", [0.0, -1.0, np.nan, np.array([1.0, 0.0])])
def test_stretch_must_be_positive(stretch):
    with pytest.raises(InvalidInputError, match="stretch: expected numbers > 0"):
        yeoh.stress(stretch, C)


def test_curve_too_short_to_fit():
    with pytest.raises(InvalidInputError, match="N >= "):
        yeoh.fit([0, 1], [0, 1])
