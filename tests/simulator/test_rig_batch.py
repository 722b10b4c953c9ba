"""Rigs that differ from run to run, on NumPy."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.simulator.rig_batch import run_count, stacked, take
from softgrip.simulator.simulation import Simulation
from tests.simulator.rigs import (
    THREE,
    commands,
    design_1,
    design_2,
    design_3,
    differing,
    printed_gripper,
)

FINGER = design_1()


def equal(one, two, *, runs=slice(None)):
    for name, value in vars(one).items():
        other = getattr(two, name)
        np.testing.assert_array_equal(value, other if name == "time" else other[..., runs], name)


def test_one_rig_many_times_is_the_rig_bit_by_bit():
    rig, speeds = printed_gripper(), commands(40, 4).T
    single = Simulation(rig, runs=4, seed=2).open_loop(speeds)
    many = Simulation([rig] * 4, seed=2).open_loop(speeds)
    for one, two in zip(single, many, strict=True):
        equal(one, two)


@pytest.mark.parametrize("rig", [FINGER, THREE], ids=["one finger", "three"])
def test_run_of_its_own_rig_is_that_rig_alone(rig):
    rigs, speeds = differing(rig, 4), commands(40, 4).T
    # One step for all: by itself a batch takes that of its stiffest rig.
    batch = Simulation(rigs, seed=2, step=2e-3).open_loop(speeds)
    for k, own in enumerate(rigs):
        alone = Simulation(own, seed=2, first=k, step=2e-3).open_loop(speeds[:, k : k + 1])
        for one, many in zip(alone, batch, strict=True):
            for name, value in vars(one).items():
                other = getattr(many, name)
                other = other if name == "time" else other[..., k : k + 1]
                # Powers of many numbers at once differ from those of one by a last place.
                np.testing.assert_allclose(value, other, rtol=1e-11, atol=1e-13, err_msg=name)


def test_part_of_a_batch_is_those_rigs():
    rigs = [design_1(), design_2(), design_3()]
    whole = stacked(rigs)
    assert run_count(whole) == 3
    part = take(whole, slice(1, 3))
    assert part.finger.stiffness.tolist() == [rig.finger.stiffness for rig in rigs[1:]]
    assert take(FINGER, slice(1, 3)) == FINGER


def test_rigs_that_do_not_fit_together_are_refused():
    with pytest.raises(InvalidInputError, match="fingers and branches"):
        stacked([FINGER, printed_gripper()])
    with pytest.raises(InvalidInputError, match="one or more"):
        Simulation([])
    with pytest.raises(InvalidInputError, match="runs: expected 2"):
        Simulation([FINGER, FINGER], runs=3)
    pump = replace(FINGER.pump, area=np.array([6e-4, 7e-4]))
    with pytest.raises(InvalidInputError, match=r"pump.area: expected a number, or shape \(3,\)"):
        Simulation(replace(FINGER, pump=pump), runs=3)


@pytest.mark.parametrize("bad", [[1.0, 0.9], [2.0, np.nan]])
def test_bad_value_among_many_is_refused(bad):
    with pytest.raises(InvalidInputError, match="fractional_power"):
        replace(FINGER.finger, fractional_power=np.array(bad))
