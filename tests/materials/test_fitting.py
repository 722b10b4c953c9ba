"""The kept fits are those of the tests, and the ways of fitting do what they are named for."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.materials import tensile
from softgrip.materials.fitting import (
    Fitting,
    bootstrap_interval,
    curve,
    fit,
    grid,
    kept,
    measure,
    ranking,
    score,
)
from softgrip.materials.table import table_5_1


def test_kept_fits_cover_the_grid():
    assert len(grid()) == 96
    assert set(kept()) == {(name, fitting) for name in table_5_1() for fitting in grid()}


@pytest.mark.usefixtures("tensile_tests")
def test_kept_fits_are_what_the_tests_give():
    found = {(row.material, row.fitting): row.fractional_power for row in measure()}
    for key, power in kept().items():
        # The file has five decimals; a bounded search ends within 1e-8.
        assert found[key] == pytest.approx(power, abs=1e-5, nan_ok=True), key


def test_printed_exponents_are_reciprocals_of_two_decimal_numbers():
    for material in table_5_1().values():
        printed = material.fractional_power
        assert f"{1 / round(1 / printed, 2):.3f}" == f"{printed:.3f}"


def test_best_way_is_the_default_and_its_score_is_counted_by_hand():
    best = ranking()[0]
    assert best.fitting == Fitting()
    found = {name: kept()[name, Fitting()] for name in table_5_1()}
    printed = {name: m.fractional_power for name, m in table_5_1().items()}
    come_out = [name for name, n in found.items() if round(1 / n, 2) == round(1 / printed[name], 2)]
    expected = ["Dragon Skin 10 MEDIUM", "Ecoflex 00-30", "Ecoflex 00-50", "Mold Star 16 FAST"]
    assert come_out == expected
    assert best.come_out == len(come_out)


def test_no_way_gives_more_than_half_of_the_column():
    assert max(score(fitting).come_out for fitting in grid()) < 5


@pytest.mark.usefixtures("tensile_tests")
def test_curve_stops_where_it_should():
    test = tensile.load("Mold Star 20T")
    strain, true = curve(test, Fitting(longest_strain=3))
    assert strain.max() <= 3 < test.strain.max()
    engineering = curve(test, Fitting("engineering", longest_strain=3))[1]
    assert true == pytest.approx(engineering * (1 + strain))
    # Ours, of a solid that keeps its volume, is the database's own to its rounding.
    assert true == pytest.approx(test.true_stress[: true.size], rel=2e-3, abs=200)


@pytest.mark.usefixtures("tensile_tests")
def test_fit_is_least_among_its_neighbours():
    """Oracle: no exponent of a fine grid has a smaller sum of squares."""
    test = tensile.load("Dragon Skin 30")
    strain, stress = curve(test, Fitting())
    E = table_5_1()[test.name].young_modulus
    powers = np.linspace(1.0, 3.0, 2001)
    misfit = [np.sum((stress - E * strain**n) ** 2) for n in powers]
    assert fit(test, Fitting()).fractional_power == pytest.approx(
        powers[np.argmin(misfit)], abs=0.001
    )


@pytest.mark.usefixtures("tensile_tests")
def test_bootstrap_interval_holds_the_estimate_and_repeats():
    test = tensile.load("Ecoflex 00-30")
    low, high = bootstrap_interval(test, Fitting(), resamples=50)
    assert low < kept()[test.name, Fitting()] < high
    assert (low, high) == bootstrap_interval(test, Fitting(), resamples=50)
    with pytest.raises(InvalidInputError, match="confidence"):
        bootstrap_interval(test, Fitting(), confidence=1.2)


def test_a_stress_of_nothing_at_strain_1_is_no_modulus():
    strain = np.linspace(0, 3, 13)
    stress = np.where(strain == 1, 1e-294, 1e5 * strain)
    test = tensile.TensileTest("mine", strain, stress, np.log1p(strain), stress * (1 + strain))
    with pytest.raises(InvalidInputError, match="1000 Pa or more at strain 1"):
        fit(test, Fitting("engineering"))
