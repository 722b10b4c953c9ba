"""What recomputes the numbers of Chapter 5, against what is known of it."""

from itertools import pairwise
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.chapter_5.numbers import (
    TESTS,
    allowed_fit,
    estimated_power,
    fitted_power,
    hundred_percent_modulus,
    peak_stress,
    printed_rms,
)
from book.chapter_5.step_models import FINGERS
from book.companion.claims import printed
from softgrip.materials.fitting import Fitting, fractional_power
from softgrip.materials.powerlaw import EXPONENTS, SCALES
from softgrip.materials.table import HELD_OUT, table_5_1
from softgrip.units import MPa


def slug(name):
    return "".join(c if c.isalnum() else "-" for c in name.lower())


def test_table_of_the_package_is_the_one_that_is_printed():
    for name, material in table_5_1().items():
        n, E, MV, TS = (printed(f"table-5.1-{c}-{slug(name)}") for c in ("n", "e", "mv", "ts"))
        assert (material.fractional_power, material.mixed_viscosity) == (n, MV)
        assert material.young_modulus / MPa == pytest.approx(E, rel=1e-12)
        assert material.tensile_strength / MPa == pytest.approx(TS, rel=1e-12)


def test_powers_of_the_fingers_are_those_of_table_5_2():
    assert {finger.material for finger in FINGERS.values()} == set(HELD_OUT)
    for finger in FINGERS.values():
        estimated, true = (
            printed(f"table-5.2-{c}-{slug(finger.material)}") for c in ("estimated", "true")
        )
        assert (finger.estimated, finger.true) == (estimated, true)


def test_powers_and_units_of_the_package_are_those_that_are_printed():
    properties = ("mixed-viscosity", "tensile-strength")
    assert [printed(f"5.2-power-{name}") for name in properties] == [*EXPONENTS[1:]]
    scales = (
        printed("5.2-scale-mixed-viscosity--pa-s-"),
        printed("5.2-scale-tensile-strength--mpa-"),
    )
    assert [scales[0], scales[1] * MPa] == [*SCALES[1:]]


@given(st.lists(st.floats(0.5, 3), min_size=3, max_size=3), st.integers(0, 1000))
def test_estimate_is_exact_where_the_law_holds(factors, seed):
    rng = np.random.default_rng(seed)
    X = rng.uniform([0.1, 5, 1], [0.6, 40, 6], (9, 3))
    n = (X / [1, 50, 10]) ** [1, 0.5, 0.5] @ factors
    known = np.column_stack([n, X])[:-1]
    # The normal equations square the condition number of nine random rows.
    assert estimated_power(known.tolist(), X[-1].tolist(), (1, 0.5, 0.5), (1, 50, 10)) == (
        pytest.approx(n[-1], rel=1e-6)
    )


def test_units_of_the_properties_move_no_estimate():
    known = [(1.5, 0.2, 10, 1.0), (2.0, 0.3, 20, 3.0), (2.2, 0.6, 15, 3.5), (1.7, 0.1, 9, 2.0)]
    as_printed, others = (
        estimated_power(known, (0.3, 18, 2.0), (1, 0.5, 0.5), scales)
        for scales in ((1, 50, 10), (0.0069, 1, 3))
    )
    assert others == pytest.approx(as_printed, rel=1e-9)


def test_a_record_allows_the_fit_of_its_farthest_shape():
    # Half the record at each end: no record between them deviates more from its mean.
    record = np.repeat([0.0, 60.0], 50)
    error = 3.0
    fit = 100 * (1 - error / np.std(record))
    assert allowed_fit([error], [60.0]) == pytest.approx(fit, rel=1e-12)
    low, high = (allowed_fit([1.3, 3.2], [60.0, 90.0], overshoot) for overshoot in (0.0, 0.3))
    assert low < high < 100


@pytest.mark.parametrize("name", ["Ecoflex 00-30", "Dragon Skin 20"])
def test_fitted_power_is_read_to_two_decimals_of_its_reciprocal(name):
    n = fractional_power(name, Fitting(longest_strain=6.0))
    assert fitted_power(name, 6.0) == n
    assert 1 / fitted_power(name, 6.0, two_decimals=True) == pytest.approx(1 / n, abs=0.005)
    assert fitted_power(name, inf, "engineering") != fitted_power(name, inf)


@pytest.mark.usefixtures("tensile_tests")
@pytest.mark.parametrize("name", ["Dragon Skin 30", "Ecoflex 00-10", "SORTA-Clear 40"])
def test_print_between_two_cases_of_its_band_comes_out_at_a_strain_between_them(name):
    """What the band's word continuous says, of the three powers that no case gives."""
    print_ = printed(f"table-5.1-n-{slug(name)}")
    found = [fitted_power(name, strain, two_decimals=True) for strain in np.arange(2.0, 6.05, 0.1)]
    assert min(abs(n - print_) for n in found) <= print_.half


def test_present_area_is_half_the_first_at_a_strain_of_one():
    first, present = (
        hundred_percent_modulus("Dragon Skin 30", stress) for stress in ("engineering", "true")
    )
    assert present == 2 * first
    assert peak_stress("Dragon Skin 30") > first


def test_printed_errors_have_each_test_once_and_grow_with_the_step():
    errors = printed_rms()
    assert [*errors] == [*TESTS.values()]
    assert len(set(errors.values())) == len(errors) == 8
    for design in FINGERS:
        for kind in ("linear", "ludwick"):
            assert all(a < b for a, b in pairwise(errors[design, x, kind] for x in (60, 90)))


def test_a_way_of_fitting_that_gives_no_power_gives_nan():
    # The engineering curve lies below E far beyond a strain of one: no rising power does that.
    assert np.isnan(fitted_power("Dragon Skin FX Pro", 3.0, "engineering", two_decimals=True))
