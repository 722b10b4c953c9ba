"""Units against factors that standards print, and what is no unit of the dimension."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.quantities import DIMENSIONS, convert, in_si, is_unit, si_unit, usual_units
from softgrip.units import DEG, GRAM_FORCE, PSI, REV

# NIST SP 811 (2008), Appendix B.8, and the definitions of the SI brochure.
FACTORS = {
    ("psi", "Pa"): PSI, ("bar", "Pa"): 1e5, ("mbar", "Pa"): 100.0, ("mmHg", "Pa"): 133.3224,
    ("kPa", "Pa"): 1e3, ("atm", "Pa"): 101325.0, ("torr", "Pa"): 133.3224,
    ("inHg", "Pa"): 3386.389,
    ("cmH2O", "Pa"): 98.0665, ("kgf/cm2", "Pa"): 98066.5, ("N/mm²", "Pa"): 1e6,
    ("rpm", "rad/s"): 0.1047198, ("r/min", "rad/s"): 0.1047198, ("rev/s", "rad/s"): REV,
    ("deg", "rad"): DEG,
    ("°/s", "rad/s"): DEG,
    ("mm", "m"): 1e-3, ("in", "m"): 0.0254, ("mL", "m^3"): 1e-6, ("cm3", "m^3"): 1e-6,
    ("mL/min", "m^3/s"): 1e-6 / 60, ("gf", "N"): GRAM_FORCE, ("kN", "N"): 1e3,
    ("lbf", "N"): 4.448222,
    ("cP", "Pa s"): 1e-3, ("mPa.s", "Pa s"): 1e-3, ("ms", "s"): 1e-3, ("min", "s"): 60.0,
    ("%", "1"): 0.01, ("mm/mm", "1"): 1.0, ("kΩ", "ohm"): 1e3, ("counts", "count"): 1.0,
}  # fmt: skip


@pytest.mark.parametrize(("unit", "wanted"), FACTORS)
def test_factors_are_the_printed_ones(unit, wanted):
    # Seven digits are printed.
    assert convert([1.0, -2.0], unit, wanted) == pytest.approx(
        np.array([1, -2]) * FACTORS[unit, wanted], rel=5e-7
    )


def test_temperatures_have_an_offset():
    assert convert(25.0, "°C", "K") == pytest.approx(298.15)


@pytest.mark.parametrize(
    ("written", "usual", "wanted"),
    [
        ("PSI", "psi", "Pa"), ("KPA", "kPa", "Pa"), ("Mpa", "MPa", "Pa"), ("RPM", "rpm", "rad/s"),
        ("degrees", "deg", "rad"), ("º", "deg", "rad"), ("S", "s", "s"), ("seconds", "s", "s"),
        ("µm", "um", "m"), ("ml/min", "mL/min", "m^3/s"), (" bar ", "bar", "Pa"),
        ("N * m", "N·m", "N m"), ("kgf / cm ** 2", "kgf/cm^2", "Pa"),
    ],
)  # fmt: skip
def test_other_ways_to_write_a_unit_mean_the_same(written, usual, wanted):
    assert convert(3.0, written, wanted) == convert(3.0, usual, wanted)


@pytest.mark.parametrize(
    ("unit", "wanted"),
    [
        ("deg", "Pa"), ("s", "m"), ("g", "N"), ("kg", "N"),  # another dimension
        ("Hz", "rad/s"), ("1/s", "rad/s"), ("count", "rad"), ("1", "rad"), ("%", "rad"),
        ("mPa", "Pa"), ("mpa", "Pa"), ("Mbar", "Pa"), ("MS", "s"), ("Mm", "m"),  # another prefix
        ("psia", "Pa"), ("", "Pa"), ("?", "Pa"), ("furlongs", "m"),
        ("9**9**9", "s"), ("3 mm", "m"), ("e", "1"), ("x" * 1000, "m"), ("(", "m"), ("s^", "s"),
    ],
)  # fmt: skip
def test_what_is_no_such_unit_is_refused_with_those_that_are(unit, wanted):
    with pytest.raises(InvalidInputError) as error:
        convert(1.0, unit, wanted, name="P")
    assert str(error.value).startswith("P: expected ")
    assert all(usual in str(error.value) for usual in usual_units(wanted))
    assert repr(unit) in str(error.value)


@given(st.text(max_size=12))
def test_any_word_is_a_unit_or_refused(word):
    for wanted in ("Pa", "rad", "1"):
        try:
            found = float(convert(1.0, word, wanted))
        except InvalidInputError:
            continue
        # The usual units lie between these.
        assert 1e-6 <= found <= 1e9


def test_a_unit_tells_its_dimension():
    for wanted in DIMENSIONS:
        assert {si_unit(unit) for unit in usual_units(wanted)} == {wanted}
        assert all(map(is_unit, usual_units(wanted)))
    with pytest.raises(InvalidInputError, match=r"pressure \(Pa\)"):
        si_unit("mood")
    with pytest.raises(UnknownNameError, match="rad/s"):
        convert(1.0, "psi", "bar")


def test_quantities_of_a_caller_come_in_si():
    import pint

    own = pint.UnitRegistry()
    assert in_si("angle", own.Quantity(180, "deg"), "rad") == pytest.approx(np.pi)
    assert in_si("speed", own.Quantity(60, "rpm"), "rad/s") == pytest.approx(REV)
    assert in_si("area", own.Quantity(2, "cm**2"), "m^2") == pytest.approx(2e-4)
    assert in_si("modulus", "0.07 MPa", "Pa") == pytest.approx(70e3)
    assert in_si("length", 0.11, "m") == 0.11
    for bad in ("110", "1,1 m", "much", None, [1, 2], own.Quantity(1, "N")):
        with pytest.raises(InvalidInputError, match=r"^length: expected a"):
            in_si("length", bad, "m")


def test_pint_is_not_imported_where_all_is_in_si():
    program = (
        "import sys, softgrip.quantities as q; q.convert([1.0], 'Pa', 'Pa'); q.is_unit('psi'); "
        "sys.exit('pint' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
