"""Eq. (5.1) and (5.2), and the fit of the latter."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import curve_fit

from softgrip.errors import InvalidInputError
from softgrip.materials import hooke, ludwick, tensile

STRAIN = np.linspace(0, 4, 80)
LOSSES = ("stress", "log", "strain")
moduli = st.floats(1e4, 1e6)
powers = st.floats(0.5, 3.0)


@given(E=moduli, strain=st.floats(-5, 5))
def test_power_one_is_hooke(E, strain):
    """Eq. (5.1) is Eq. (5.2) with n = 1."""
    assert ludwick.stress(strain, E, 1.0) == pytest.approx(hooke.stress(strain, E))


@given(E=moduli, n=powers, strain=st.floats(0, 20))
def test_law_is_odd(E, n, strain):
    assert ludwick.stress(-strain, E, n) == -ludwick.stress(strain, E, n)


@given(E=moduli, n=powers)
def test_modulus_is_the_stress_at_strain_one(E, n):
    assert ludwick.stress(1.0, E, n) == pytest.approx(E)


@given(E=moduli, n=powers)
def test_in_logarithms_the_law_is_a_line_whose_slope_is_the_power(E, n):
    """Eq. (5.2), by a straight line through 20 decades of strain."""
    strain = np.geomspace(1e-18, 1e2, 9)
    slope, constant = np.polyfit(np.log(strain), np.log(ludwick.stress(strain, E, n)), 1)
    assert (slope, np.exp(constant)) == pytest.approx((n, E), rel=1e-8)


def test_array_gives_what_floats_give():
    array = ludwick.stress(STRAIN, 1e5, 1.7)
    np.testing.assert_allclose(array, [ludwick.stress(float(e), 1e5, 1.7) for e in STRAIN])


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("held", [True, False])
@pytest.mark.parametrize("n", [0.6, 1.0, 1.538, 2.5])
def test_fit_finds_the_law_that_made_the_curve(loss, held, n):
    stress = ludwick.stress(STRAIN, 2.6e5, n)
    found = ludwick.fit(STRAIN, stress, loss=loss, young_modulus=2.6e5 if held else None)
    assert found.fractional_power == pytest.approx(n, rel=1e-6)
    assert found.young_modulus == pytest.approx(2.6e5, rel=1e-6)
    assert found.rms_stress < 1.0
    assert found.points == (STRAIN.size if loss == "stress" else STRAIN.size - 1)


@pytest.fixture
def noisy():
    noise = np.random.default_rng(1).normal(0, 8e3, STRAIN.size)
    return STRAIN[5:], (1e5 * STRAIN**1.6 + noise)[5:]


def test_stress_loss_agrees_with_a_general_fitter(noisy):
    e, s = noisy
    (E, n), _ = curve_fit(lambda e, E, n: E * e**n, e, s, p0=(1e5, 1.0))
    found = ludwick.fit(e, s)
    assert (found.young_modulus, found.fractional_power) == pytest.approx((E, n), rel=1e-5)


def test_log_loss_agrees_with_a_straight_line(noisy):
    e, s = noisy
    e, s = e[s > 0], s[s > 0]
    n, logE = np.polyfit(np.log(e), np.log(s), 1)
    found = ludwick.fit(e, s, loss="log")
    assert (found.young_modulus, found.fractional_power) == pytest.approx((np.exp(logE), n))


@pytest.mark.parametrize("held", [None, 1.2e5])
def test_strain_loss_agrees_with_a_general_fitter(noisy, held):
    e, s = noisy
    e, s = e[s > 0], s[s > 0]
    if held:
        (m,), _ = curve_fit(lambda s, m: (s / held) ** m, s, e, p0=(1.0,))
    else:
        (_, m), _ = curve_fit(lambda s, E, m: (s / E) ** m, s, e, p0=(1e5, 1.0))
    found = ludwick.fit(e, s, loss="strain", young_modulus=held)
    assert found.fractional_power == pytest.approx(1 / m, rel=1e-5)


@given(factor=st.floats(1e-3, 1e3))
def test_unit_of_stress_changes_the_modulus_only(factor):
    stress = 1e5 * STRAIN**1.6 * (1 + 0.1 * np.sin(5 * STRAIN))
    first, second = (ludwick.fit(STRAIN, s) for s in (stress, factor * stress))
    assert second.fractional_power == pytest.approx(first.fractional_power, rel=1e-6)
    assert second.young_modulus == pytest.approx(factor * first.young_modulus, rel=1e-6)


def test_negative_first_stress_is_used_by_the_stress_loss_only():
    stress = 1e5 * STRAIN**1.6
    stress[:2] = -50.0
    points = {loss: ludwick.fit(STRAIN, stress, loss=loss).points for loss in LOSSES}
    assert points == {"stress": 80, "log": 78, "strain": 78}


@pytest.mark.usefixtures("tensile_tests")
@pytest.mark.parametrize("loss", LOSSES)
def test_fit_of_a_measured_curve_beats_its_neighbours(loss):
    test = tensile.load("Ecoflex 00-10")
    best = ludwick.fit(test.strain, test.stress)
    other = ludwick.fit(test.strain, test.stress, loss=loss)
    assert best.rms_stress <= other.rms_stress < 0.1 * test.stress.max()


@pytest.mark.parametrize(
    ("strain", "stress", "loss", "expected"),
    [
        ([0, 1], [0, 1], "stress", "N >= 3"),
        ([0, 1, 2], [0, 1, 2], "log", "N >= 3"),  # of which the first has no logarithm
        ([0, 1, 2], [0, 1], "stress", "one shape"),
        ([[0, 1, 2]], [[0, 1, 2]], "stress", "one shape"),
        ([0, 1, np.nan], [0, 1, 2], "stress", "finite"),
        ([0, 1, 2], [0, 1, np.inf], "stress", "finite"),
        ([-0.1, 1, 2], [0, 1, 2], "stress", "values >= 0"),
        ([1, 1, 1], [0, 1, 2], "stress", "not all equal"),
        ([0, 1, 2], [0, -1, -2], "stress", "at least one value > 0"),
        (STRAIN, STRAIN, "mse", r"one of \('stress', 'log', 'strain'\), got 'mse'"),
    ],
)
def test_curve_that_cannot_be_fitted(strain, stress, loss, expected):
    with pytest.raises(InvalidInputError, match=expected):
        ludwick.fit(strain, stress, loss=loss)


@pytest.mark.parametrize("where", [0.12, 0.5, 0.88])
def test_valley_beside_an_end_of_the_scan_is_found(where):
    found = ludwick.least(lambda x: (x - where) ** 2, np.linspace(0, 1, 11), name="x")
    assert found == pytest.approx(where, abs=1e-8)


@pytest.mark.parametrize("loss", LOSSES)
def test_power_outside_the_searched_range(loss):
    e = np.linspace(0.5, 2, 30)
    with pytest.raises(InvalidInputError, match=r"best fitted by powers from 0\.1 to 10"):
        ludwick.fit(e, e**15, loss=loss)


@pytest.mark.parametrize("modulus", [0.0, -1.0, np.nan, np.inf])
def test_modulus_must_be_positive(modulus):
    for call in (
        lambda: hooke.stress(0.1, modulus),
        lambda: ludwick.stress(0.1, modulus, 1.5),
        lambda: ludwick.fit(STRAIN, STRAIN, young_modulus=modulus),
    ):
        with pytest.raises(InvalidInputError, match="young_modulus: expected a finite number"):
            call()


def test_the_fit_of_a_power_law_is_the_certified_one():
    """Oracle: DanWood of NIST's Statistical Reference Datasets, nonlinear regression, y = b1 x**b2.

    The data are Daniel and Wood's (1980), certified to 11 digits, and in the public domain.
    """
    x = [1.309, 1.471, 1.490, 1.565, 1.611, 1.680]
    y = [2.138, 3.421, 3.597, 4.340, 4.882, 5.660]
    found = ludwick.fit(x, y)
    # Where a sum of squares is least shows to about the root of a double's precision, 1.5e-8; how
    # small it is there shows nearly to all of the digits.
    assert found.young_modulus == pytest.approx(7.6886226176e-01, rel=2e-8)
    assert found.fractional_power == pytest.approx(3.8604055871e00, rel=2e-8)
    assert found.points * found.rms_stress**2 == pytest.approx(4.3173084083e-03, rel=1e-10)
