"""Experiments on many rigs are the simulator's runs, with a step that each rig can bear."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.control.rig_controller import CommandSequence
from softgrip.simulator.calibration import design_1
from softgrip.simulator.chance import SEED
from softgrip.simulator.gripper_parameters import printed_gripper
from softgrip.simulator.simulation import LARGEST_STEP, Simulation
from softgrip.twin.experiments import closed_loop, open_loop, step_for

COMMANDS = np.r_[np.full(20, 20.0), np.zeros(60)]
STIFF = replace(
    design_1(), fingers=(replace(design_1().finger, inertia=2e-4, damping=0.06, friction=1e-3),)
)


def test_open_loop_records_are_the_runs_of_each_rig():
    found = open_loop([design_1(), STIFF], [COMMANDS, 0.5 * COMMANDS], runs=3)
    seen, true = Simulation(design_1(), runs=3, seed=SEED).open_loop(COMMANDS)
    assert found.angle.shape == (2, 3, 1, 80)
    assert found.angle[0, :, 0] == pytest.approx(seen.angle[:, 0].T, abs=0)
    assert found.pressure[0] == pytest.approx(seen.pressure.T, abs=0)
    assert found.true_angle[0, 2, 0] == pytest.approx(true.angle[:, 0, 2], abs=0)
    assert found.plunger[0, 1] == pytest.approx(true.plunger[:, 1], abs=0)
    assert (found.command[1] == 0.5 * COMMANDS).all()


def test_closed_loop_records_begin_before_the_rig_moves():
    found = closed_loop(
        [printed_gripper()], [lambda: CommandSequence([5.0, 5.0])], 1.0, runs=2, period=0.1
    )
    assert found.true_angle.shape == (1, 2, 2, 11)
    assert (found.true_angle[..., 0] == 0).all()
    assert found.command[0, :4].tolist() == [0.0, 5.0, 5.0, 0.0]


def test_the_calibrated_rigs_have_the_step_that_they_had():
    assert step_for(design_1()) == step_for(printed_gripper()) == LARGEST_STEP


def test_a_stiff_rig_is_stepped_shorter_and_stays_finite():
    # By hand: 1.5 for the spread of the damping, and friction as a damper at rest.
    rate = (np.exp(3 * STIFF.spread.damping) * 0.06 + 1e-3 / 0.05) / 2e-4
    assert step_for(STIFF) == pytest.approx(2 / rate)
    fine = replace(STIFF, spread=replace(STIFF.spread, damping=0.5))
    assert step_for(fine) < step_for(STIFF)
    angle = open_loop([STIFF], [COMMANDS]).true_angle[0, 0, 0]
    _, finer = Simulation(STIFF, seed=SEED, step=step_for(STIFF) / 8).open_loop(COMMANDS)
    # As far as the simulator asks of its own largest step.
    assert angle == pytest.approx(finer.angle[:, 0, 0], abs=2e-4)
    with np.errstate(all="ignore"):
        _, coarse = Simulation(STIFF, seed=SEED).open_loop(COMMANDS)
    assert not np.abs(coarse.angle).max() < 10
