"""Yeoh's and Ogden's laws against their energies, and their fits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.materials import ogden, tensile, yeoh

STRAIN = np.linspace(0, 6, 60)
C = (2e4, 3e2, 2.0)
MU, ALPHA = (2e4, -3e3), (2.2, -3.0)
stretches = st.floats(0.3, 8)


def yeoh_energy(stretch):
    x = stretch**2 + 2 / stretch - 3
    return C[0] * x + C[1] * x**2 + C[2] * x**3


def ogden_energy(stretch):
    return sum(
        m / a * (stretch**a + 2 * stretch ** (-a / 2) - 3) for m, a in zip(MU, ALPHA, strict=True)
    )


@given(stretch=stretches)
@pytest.mark.parametrize(
    ("energy", "law"),
    [
        (yeoh_energy, lambda x: yeoh.stress(x, C)),
        (ogden_energy, lambda x: ogden.stress(x, MU, ALPHA)),
    ],
    ids=["Yeoh", "Ogden"],
)
def test_stress_is_the_slope_of_the_energy(energy, law, stretch):
    h = 1e-5 * stretch
    slope = (energy(stretch + h) - energy(stretch - h)) / (2 * h)
    assert law(stretch) == pytest.approx(slope, rel=1e-5, abs=1)


@given(stretch=stretches, shear=st.floats(1e3, 1e6))
def test_both_hold_the_neo_hookean_law(stretch, shear):
    expected = pytest.approx(shear * (stretch - stretch**-2), rel=1e-9, abs=1e-6)
    assert yeoh.stress(stretch, (shear / 2,)) == expected
    assert ogden.stress(stretch, (shear,), (2.0,)) == expected


def test_slope_at_rest_is_three_times_the_shear_modulus():
    h = 1e-6
    assert yeoh.stress(1 + h, C) / h == pytest.approx(3 * 2 * C[0], rel=1e-4)
    shear = 0.5 * sum(m * a for m, a in zip(MU, ALPHA, strict=True))
    assert ogden.stress(1 + h, MU, ALPHA) / h == pytest.approx(3 * shear, rel=1e-4)


def test_fit_of_yeoh_finds_the_law_that_made_the_curve():
    found = yeoh.fit(STRAIN, yeoh.stress(1 + STRAIN, C))
    assert found.coefficients == pytest.approx(C, rel=1e-8)
    assert found.rms_stress < 1e-3


@pytest.mark.parametrize(("mu", "alpha"), [(2e4, 2.7), (-3e3, -6.3), (1e4, 1.1)])
def test_fit_of_ogden_finds_the_law_that_made_the_curve(mu, alpha):
    found = ogden.fit(STRAIN, ogden.stress(1 + STRAIN, (mu,), (alpha,)))
    assert (found.modulus, found.exponent) == pytest.approx((mu, alpha), rel=1e-5)
    assert found.rms_stress < 1


@pytest.mark.usefixtures("tensile_tests")
def test_fit_of_a_measured_curve_is_close_and_stiff_at_rest():
    test = tensile.load("Ecoflex 00-30")
    first, second = yeoh.fit(test.strain, test.stress), ogden.fit(test.strain, test.stress)
    assert first.rms_stress < 0.001 * test.stress.max()
    assert second.rms_stress < 0.01 * test.stress.max()
    assert first.coefficients[0] > 0
    assert second.modulus * second.exponent > 0


@pytest.mark.parametrize("stretch", [0.0, -1.0, np.nan, np.array([1.0, 0.0])])
def test_stretch_must_be_positive(stretch):
    for call in (lambda: yeoh.stress(stretch, C), lambda: ogden.stress(stretch, MU, ALPHA)):
        with pytest.raises(InvalidInputError, match="stretch: expected numbers > 0"):
            call()


def test_exponent_outside_the_searched_range():
    with pytest.raises(InvalidInputError, match="best fitted by exponents from -10 to 10"):
        ogden.fit(STRAIN, STRAIN**15)


@pytest.mark.parametrize("fit", [yeoh.fit, ogden.fit])
def test_curve_too_short_to_fit(fit):
    with pytest.raises(InvalidInputError, match="N >= "):
        fit([0, 1], [0, 1])
