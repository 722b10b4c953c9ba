"""Names, units and ranges of what is free in a fit."""

from dataclasses import fields

import pytest

from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.simulator.free_parameters import (
    Parameter,
    free_parameters,
    parameter_values,
    parts,
    unit_of,
    with_values,
)
from tests.simulator.rigs import design_1, design_2, design_3, printed_gripper

RIGS = {
    "design 1": design_1(), "design 2": design_2(), "design 3": design_3(),
    "gripper": printed_gripper(),
}  # fmt: skip
each = pytest.mark.parametrize("rig", RIGS.values(), ids=RIGS)


@each
def test_the_declared_ranges_hold_the_calibrated_rigs(rig):
    values = parameter_values(rig)
    for one in free_parameters(len(rig.fingers)):
        assert one.low < values[one.name] < one.high, one.name


@each
def test_all_values_by_name_make_the_rig_again(rig):
    other = {name: 1.1 * value for name, value in parameter_values(rig).items()}
    bare = with_values(rig, other | {"sensors.bits": 11})
    assert bare != rig
    assert with_values(bare, parameter_values(rig)) == rig


@each
def test_each_field_of_a_rig_has_a_unit(rig):
    for name, part in parts(rig).items():
        for entry in fields(part):
            assert unit_of(f"{name}.{entry.name}")


def test_the_second_finger_is_another_one():
    rig = with_values(printed_gripper(), {"finger_2.memory[1]": 0.3, "finger_2.stiffness": 0.02})
    assert rig.fingers[0] == printed_gripper().fingers[0]
    assert (rig.fingers[1].memory[1], rig.fingers[1].stiffness) == (0.3, 0.02)


@pytest.mark.parametrize(
    ("name", "value"),
    [("finger_2.stiffness", 1.0), ("finger.memory[2]", 1.0), ("finger.memory", 1.0),
     ("finger.length", 1.0), ("sensors.bits", 10.5)],
)  # fmt: skip
def test_a_name_that_a_rig_has_not(name, value):
    with pytest.raises(UnknownNameError, match=r"valid are: finger\.stiffness, "):
        with_values(design_1(), {name: value})


def test_what_is_no_name_and_no_range():
    with pytest.raises(InvalidInputError, match=r"part\.field"):
        unit_of("stiffness")
    with pytest.raises(UnknownNameError, match=r"finger\.length"):
        unit_of("finger.length")
    with pytest.raises(InvalidInputError, match=r"finger\.x: expected 0 < low < high"):
        Parameter("finger.x", 2.0, 1.0, "linear", "the wrong way round")
    with pytest.raises(InvalidInputError, match=r"finger\.x: expected 0 < low < high"):
        Parameter("finger.x", 0.0, 1.0, "log", "nothing has no logarithm")
