"""The draws of E and n: about the truth of a made-up test, and about the table they stand for."""

import numpy as np
import pytest

from softgrip.materials import tensile
from softgrip.materials.draws import DRAWS, KEPT, drawn, draws
from softgrip.materials.facts import facts
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import TensileTest


def made(E, n, noise, rows=400):
    """A test whose true stress is Ludwick's, with noise of a share of its largest stress."""
    strain = np.linspace(0, 5, rows)
    stress = E * strain**n / (1 + strain)
    stress = stress + noise * stress.max() * np.random.default_rng(2).normal(size=rows)
    return TensileTest("made", strain, stress, np.log1p(strain), stress * (1 + strain))


def test_draws_lie_about_the_truth():
    """E is the engineering stress at strain 1, half of the true one, so n is that of this E."""
    found = np.array(
        [(d.young_modulus, d.fractional_power) for d in drawn(made(2e5, 2.0, 0.01), 60)]
    )
    # A cubic is not the curve: it is off by less than a hundredth, as the next test says.
    assert np.median(found[:, 0]) == pytest.approx(1e5, rel=0.02)
    assert 0.001 < np.std(found[:, 0]) / 1e5 < 0.05
    assert np.std(found[:, 1]) > 0


def test_an_exact_curve_has_no_spread():
    found = np.array([d.young_modulus for d in drawn(made(2e5, 2.0, 0.0), 10)])
    np.testing.assert_allclose(found, 1e5, rtol=1e-2)


def test_kept_draws_are_about_the_moduli_of_the_tests():
    """The kept facts read the stress at strain 1 from the curve itself, without a draw."""
    assert draws().keys() == table_5_1().keys()
    for name, rows in draws().items():
        assert rows.shape == (DRAWS, 2)
        low, high = np.percentile(rows[:, 0], [0.5, 99.5])
        modulus = facts()[name].hundred_percent_modulus
        assert low * 0.97 < modulus < high * 1.03


@pytest.mark.skipif(not tensile.available(), reason="the tensile tests cannot be had")
def test_kept_draws_come_out_again():
    again = drawn(tensile.load("Ecoflex 00-30"), 5)
    kept = [row for row in KEPT.read() if row.name == "Ecoflex 00-30"][:5]
    for one, other in zip(again, kept, strict=True):
        assert one.young_modulus == pytest.approx(other.young_modulus, rel=1e-4)
        assert one.fractional_power == pytest.approx(other.fractional_power, rel=1e-4)
