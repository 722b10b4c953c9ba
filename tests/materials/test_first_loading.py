"""A curve that is hidden in a record comes out of it, or it is said what cannot be told."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.materials import ludwick, tensile
from softgrip.materials.first_loading import first_loading

STRAIN = np.linspace(0, 3, 61)


def law(strain, n=1.6):
    return 0.12e6 * np.maximum(strain, 0) ** n


def check(found, n=1.6, rel=1e-3):
    fit = ludwick.fit(found.strain, found.stress)
    assert (fit.young_modulus, fit.fractional_power) == pytest.approx((0.12e6, n), rel=rel)


@pytest.mark.parametrize("n", [0.8, 1.0, 1.6, 2.5])
@pytest.mark.parametrize("rows", [40, 400])
def test_a_clean_curve_is_left_alone(n, rows):
    """A law that begins flat has no slack, and one that begins steep no preload."""
    strain = np.linspace(0, 3, rows)
    found = first_loading(strain, law(strain, n))
    assert (found.slack, found.preload, found.notes) == (0, 0, ())
    np.testing.assert_array_equal(found.strain, strain)


@pytest.mark.parametrize("n", [1.0, 1.6, 2.5])
@pytest.mark.parametrize("preload", [0.0, 20e3])
def test_slack_and_preload_are_taken_off(n, preload):
    found = first_loading(STRAIN, law(STRAIN - 0.2, n) + preload)
    # A straight line fixes its knee only to where the nearest row lies beyond it.
    assert found.slack == pytest.approx(0.2, abs=0.002)
    assert found.preload == pytest.approx(preload, abs=100)
    check(found, n, rel=0.01)


@pytest.mark.parametrize("zero", [3.5, -1.5, -0.2, 0.1])
def test_a_position_is_counted_from_the_first_row(zero):
    found = first_loading(STRAIN + zero, law(STRAIN))
    assert found.notes == (f"the strain is counted from {zero:.4g} on",)
    check(found)


def test_a_record_that_begins_later_keeps_the_zero_of_its_file():
    late = STRAIN[STRAIN > 0.2]
    check(first_loading(late, law(late)))


def test_rows_before_zero_that_bear_nothing_are_left_out():
    strain = np.linspace(-0.3, 3, 67)
    check(first_loading(strain, law(strain)))


def test_what_a_strain_is_counted_from_is_asked_where_noise_hides_it():
    noise = 0.01 * law(3.0) * np.random.default_rng(1).standard_normal(STRAIN.size)
    record = STRAIN + 0.06, law(STRAIN) + noise
    with pytest.raises(InvalidInputError, match="zero: expected 'file' or 'first row'"):
        first_loading(*record)
    from_row = first_loading(*record, zero="first row")
    assert first_loading(*record, zero="file").strain[0] == pytest.approx(0.06)
    assert from_row.strain[0] == 0
    check(from_row, rel=0.05)


def test_noise_before_the_pull_is_rest():
    random = np.random.default_rng(3)
    strain = np.concatenate([random.normal(0, 1e-4, 40), STRAIN])
    stress = law(strain) + 20e3 + 300 * random.standard_normal(strain.size)
    found = first_loading(strain, stress)
    assert found.preload == pytest.approx(20e3, abs=5 * 300 / 40**0.5)
    assert found.slack == 0
    check(found, rel=0.01)


def test_noise_says_what_it_hides():
    noise = 0.01 * law(3.0) * np.random.default_rng(1).standard_normal(STRAIN.size)
    assert "in it may hide a preload" in first_loading(STRAIN, law(STRAIN) + noise).notes[-1]


def test_only_the_first_loading_of_cycles_is_used():
    strain = np.concatenate([STRAIN, STRAIN[::-1], STRAIN * 1.5])
    stress = np.concatenate([law(STRAIN), 0.7 * law(STRAIN[::-1]), 0.8 * law(STRAIN * 1.5)])
    found = first_loading(strain, stress)
    assert found.strain.max() == 3
    assert found.notes[0] == "only the first loading is used: 122 rows after it are not"
    check(found)


def test_rows_after_a_break_are_left_out():
    strain = np.linspace(0, 3.5, 71)
    stress = np.where(strain > 3, 0.1 * law(strain), law(strain))
    found = first_loading(strain, stress)
    assert found.strain.max() == pytest.approx(3)
    assert found.notes == ("the specimen broke: 10 rows after the largest stress are left out",)
    check(found)


@pytest.mark.parametrize(
    ("strain", "stress", "words"),
    [
        (STRAIN, -law(STRAIN), "stress: expected one that rises; compression_positive"),
        (-STRAIN, law(STRAIN), "strain: expected one that rises"),
        (0 * STRAIN, law(STRAIN), "strain: expected one that rises"),
        (STRAIN[:8], law(STRAIN[:8]), "12 rows of a first loading, got 8"),
    ],
)
def test_what_is_no_pull_is_refused(strain, stress, words):
    with pytest.raises(InvalidInputError, match=words):
        first_loading(strain, stress)


@pytest.mark.usefixtures("tensile_tests")
@pytest.mark.parametrize("name", ["Ecoflex 00-30", "SORTA-Clear 40"])
def test_a_measured_curve_is_not_taken_for_slack(name):
    test = tensile.load(name)
    found = first_loading(test.strain, test.stress)
    assert found.slack == 0
    assert abs(found.preload) < 0.01 * test.stress.max()
