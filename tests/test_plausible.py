"""Numbers that are likely to be in another unit are refused, with the unit; those of SI are not."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip import plausible
from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand, check_units
from softgrip.actuator.optimize import optimal_design
from softgrip.errors import InvalidInputError
from softgrip.materials.powerlaw import predict_power
from softgrip.materials.table import table_5_1
from softgrip.plausible import Plausible

RANGES = [value for value in vars(plausible).values() if isinstance(value, Plausible)]
IN_MM = Bounds(top=(6, 12), bottom=(1, 4), width=(12, 20), wall=(1.5, 3), height=(8, 16))


@pytest.mark.parametrize("known", RANGES, ids=lambda known: known.what)
@given(share=st.floats(0, 1))
def test_all_within_the_range_is_taken(known, share):
    known.check("it", known.low * (known.high / known.low) ** (0.999 * share + 0.0005))


@pytest.mark.parametrize("known", RANGES, ids=lambda known: known.what)
@given(share=st.floats(0, 1), pick=st.integers(0, 9))
def test_a_slip_is_taken_for_si_or_refused_with_its_unit(known, share, pick):
    """What lies within in SI cannot be told; what does not is refused, and the slip is named."""
    unit, factor = known.others[pick % len(known.others)]
    meant = known.low * (known.high / known.low) ** (0.999 * share + 0.0005)
    written = meant / factor
    if known.low <= written <= known.high:
        known.check("it", written)
    else:
        with pytest.raises(InvalidInputError) as refused:
            known.check("it", written)
        assert f"{unit} (" in str(refused.value).partition("probably")[2]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": 110}, r"length: .*110: probably mm \(0\.11 m\)"),
        ({"length": 9.4}, r"length: .*cm \(0\.094 m\) or mm \(0\.0094 m\)"),
        ({"pressure": 20}, r"pressure: .*kPa \(2e\+04 Pa\)"),
        ({"pressure": 0.15}, r"pressure: .*MPa \(1\.5e\+05 Pa\)"),
        ({"young_modulus": 0.07}, r"young_modulus: .*MPa \(7e\+04 Pa\)"),
        ({"angle_scale": 252.0}, r"angle_scale: .*deg \(4\.4 rad\)"),
        ({"bounds": IN_MM}, r"top: .*6: probably mm \(0\.006 m\)"),
        (
            {"band": FrequencyBand(2.0, 4.0, 360, 360)},
            r"least_mass, largest_mass: .*g \(0\.36 kg\)",
        ),
    ],
)
@pytest.mark.parametrize("solve", [certified_design, optimal_design])
def test_design_in_other_units_is_refused(solve, change, message):
    with pytest.raises(InvalidInputError, match=message):
        solve(replace(DesignProblem(), **change))


def test_design_of_a_reader_in_millimetres_is_refused():
    with pytest.raises(InvalidInputError, match="110: probably mm"):
        certified_design(DesignProblem(pressure=20e3, length=110, bounds=IN_MM))


@pytest.mark.parametrize("name", table_5_1())
def test_all_materials_of_table_5_1_are_plausible(name):
    check_units(DesignProblem.for_material(name, pressure=30e3))
    known = table_5_1()[name]
    predict_power(known.young_modulus, known.mixed_viscosity, known.tensile_strength)


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ((0.34, 20, 3.79e6), r"young_modulus: .*MPa \(3\.4e\+05 Pa\)"),
        ((0.34e6, 20000, 3.79e6), r"mixed_viscosity: .*cP \(mPa s\) \(20 Pa s\)"),
        ((0.34e6, 20, 550), r"tensile_strength: .*psi \(3\.79e\+06 Pa\)"),
    ],
)
def test_properties_in_other_units_are_refused(properties, message):
    with pytest.raises(InvalidInputError, match=message):
        predict_power(*properties)


def test_what_no_unit_explains_is_refused_without_one():
    with pytest.raises(InvalidInputError, match=r"got '1e\+12'"):
        plausible.LENGTH.check("length", 1e12)
