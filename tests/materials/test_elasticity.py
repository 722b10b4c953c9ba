"""What a test says of its material, and the command that prints it."""

import json
import warnings

import numpy as np
import pytest

from softgrip.errors import FitWarning, InvalidInputError
from softgrip.materials import tensile, yeoh
from softgrip.materials.__main__ import main
from softgrip.materials.elasticity import WINDOW_ROWS, elasticity
from softgrip.materials.fitting import Fitting, bootstrap_interval, fit, held_modulus
from softgrip.materials.tensile import TensileTest

STRAIN = np.linspace(0, 3, 61)


def made(strain, stress, name="own rubber"):
    return TensileTest(name, strain, stress, np.log1p(strain), stress * (1 + strain))


OWN = made(STRAIN, 0.12e6 * STRAIN**1.6)


def test_laws_that_made_a_curve_come_out():
    found = elasticity(OWN, resamples=20)
    assert found.young_modulus.value == pytest.approx(0.12e6, rel=1e-5)
    assert found.fractional_power.value == pytest.approx(1.6, rel=1e-5)
    C = (2e4, 3e2, 2.0)
    other = elasticity(made(STRAIN, yeoh.stress(1 + STRAIN, C)), resamples=20)
    for one, expected in zip(other.yeoh, C, strict=True):
        assert one.value == pytest.approx(expected, rel=1e-6)
        assert one.low <= one.value * (1 + 1e-6)
        assert one.high >= one.value * (1 - 1e-6)


def test_slope_is_that_of_small_strains_and_says_how_far():
    strain = np.linspace(0, 3, 301)
    found = elasticity(made(strain, 5e4 * strain), resamples=20)
    assert found.small_strain_modulus.value == pytest.approx(5e4)
    assert found.window == pytest.approx(0.1)
    coarse = elasticity(OWN, resamples=20)
    assert coarse.window == STRAIN[WINDOW_ROWS - 1]


def test_a_modulus_can_be_held():
    found = elasticity(OWN, young_modulus=0.12e6, resamples=20).young_modulus
    assert (found.value, found.low, found.high) == (0.12e6, 0.12e6, 0.12e6)


def fit_quietly(*given, **held):
    """Return a fit whether it holds or not."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FitWarning)
        return fit(*given, **held)


def test_fit_that_does_not_hold_says_so():
    # E strain^n times 1 + strain is no power with the same E.
    with pytest.warns(FitWarning, match=r"own rubber: .* true stress, with E held at 1\.2e\+05 Pa"):
        wrong = fit(OWN, Fitting())
    strain, true = OWN.strain, OWN.stress * (1 + OWN.strain)
    left = true - wrong.young_modulus * strain**wrong.fractional_power
    assert not wrong.holds
    assert wrong.missed == pytest.approx(np.sqrt(np.mean(left**2)) / true.max(), rel=1e-3)
    assert fit(OWN, Fitting("engineering")).holds
    assert elasticity(OWN, resamples=20).ludwick_holds


def test_own_material_holds_the_modulus_given_or_its_own_stress_at_strain_1():
    for fitting in (Fitting(), Fitting("engineering")):
        own = fit_quietly(OWN, fitting)
        assert own == fit_quietly(OWN, fitting, young_modulus=held_modulus(OWN)[0])
        low, high = bootstrap_interval(OWN, fitting, resamples=20)
        assert low <= own.fractional_power + 1e-9
        assert high >= own.fractional_power - 1e-9
    assert held_modulus(OWN) == (
        pytest.approx(0.12e6),
        "the stress of the test at strain 1",
    )
    assert fit(OWN, Fitting("engineering")).fractional_power == pytest.approx(1.6)


def test_own_material_that_does_not_reach_strain_1_asks_for_a_modulus():
    short = made(STRAIN / 4, OWN.stress)
    with pytest.raises(InvalidInputError, match=r"'own rubber' is not in Table 5\.1"):
        fit(short, Fitting())
    held = fit_quietly(short, Fitting("engineering"), young_modulus=1e6)
    assert held.young_modulus == 1e6
    assert fit(short, Fitting(modulus="free")).points == 61


@pytest.mark.usefixtures("tensile_tests")
def test_the_fit_of_yeohs_law_is_that_of_two_packages():
    """Oracle: hyperelastic 0.10.2 (curve_fit) and felupe 11.3.0 (least_squares), up to the peak."""
    test = tensile.up_to_peak(tensile.load("Ecoflex 00-30"))
    used = test.strain >= 0
    found = yeoh.fit(test.strain[used], test.stress[used])
    expected = 8336.54651730731, 72.9703092461895, -0.0425604000300777
    # They agree with one another to 8 digits: they search, here the coefficients are solved for.
    assert found.coefficients == pytest.approx(expected, rel=1e-7)
    assert found.rms_stress == pytest.approx(618.1877960, rel=1e-8)


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "rubber.csv"
    force = OWN.stress * 12e-6
    lines = [f"{30 * e:.4f},{f:.8f}" for e, f in zip(STRAIN, force, strict=True)]
    path.write_text("Extension (mm),Load (N)\n" + "\n".join(lines) + "\n")
    return str(path)


SIZES = ("--gauge-length", "30 mm", "--area", "12 mm^2")


def test_command_prints_the_fit(file, capsys):
    assert main(["fit", file, *SIZES]) == 0
    printed = capsys.readouterr().out
    assert "E, its stress at strain 1  120 (120 to 120) kPa" in printed
    assert "n                          1.6 (1.6 to 1.6)" in printed
    assert "note  the stress is 'Load [N]' over 1.2e-05 m^2" in printed


def test_command_prints_json_in_si(file, capsys):
    assert main(["fit", file, *SIZES, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["fractional_power"]["value"] == pytest.approx(1.6, rel=1e-4)
    assert found["young_modulus"]["value"] == pytest.approx(0.12e6, rel=1e-4)
    assert (found["slack"], found["preload"]) == (0, 0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "a gauge length"),
        (("--gauge-length", "30 kg", "--area", "12 mm^2"), "gauge_length: expected a length"),
        ((*SIZES, "--column", "force"), "--column: expected WHAT=HEADING, got 'force'"),
        ((*SIZES, "--column", "force=F"), "a column 'F'"),
        ((*SIZES, "--young-modulus", "1 kg"), "young_modulus: expected a pressure"),
    ],
)
def test_command_that_cannot_judge_says_why_and_ends_with_2(file, arguments, words, capsys):
    assert main(["fit", file, *arguments]) == 2
    assert words in capsys.readouterr().err


def test_command_says_that_there_is_no_file(capsys):
    assert main(["fit", "none.csv"]) == 2
    assert "none.csv: expected a file, got none" in capsys.readouterr().err


def test_help_has_an_example(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["fit", "--help"])
    assert 'fit rubber.csv --gauge-length "30 mm"' in capsys.readouterr().out
