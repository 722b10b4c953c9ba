"""Experiments on many rigs are the simulator's runs, with a step that each rig can bear."""

from dataclasses import replace

import numpy as np
import pytest

from book.twin.experiments import KEPT, closed_loop, open_loop
from softgrip.control.pid import PID, Gains
from softgrip.control.rig_controller import Tracking
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.rig_batch import stacked
from softgrip.simulator.sampled_law import command_law, sampled_law
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.step_size import LARGEST_STEP, STEPS, steps_for
from softgrip.units import DEG
from tests.simulator.rigs import design_1, printed_gripper

COMMANDS = np.r_[np.full(20, 20.0), np.zeros(60)]
STIFF = replace(
    design_1(), fingers=(replace(design_1().finger, inertia=2e-4, damping=0.06, friction=1e-3),)
)
BOTH = stacked([design_1(), STIFF])


def _agree(found, known):
    """The kernel rounds otherwise: to 1e-9 of each quantity's size, as `drive_compiled` says."""
    size = np.abs(known).max()
    assert found == pytest.approx(known, rel=0, abs=1e-9 * size)


@pytest.mark.parametrize("compiled", [True, False])
def test_open_loop_records_are_the_runs_of_each_rig(compiled):
    commands = np.stack([COMMANDS, 0.5 * COMMANDS])
    found = open_loop(BOTH, commands, runs=3, compiled=compiled)
    assert found.angle.shape == (2, 3, 1, 80)
    for k, rig in enumerate((design_1(), STIFF)):
        step = 0.025 / steps_for(rig, 0.025)[0]
        seen, true = Simulation(rig, runs=3, seed=SEED, step=step).open_loop(commands[k])
        _agree(found.angle[k, :, 0], seen.angle[:, 0].T)
        _agree(found.pressure[k], seen.pressure.T)
        _agree(found.true_angle[k, :, 0], true.angle[:, 0].T)
        _agree(found.true_pressure[k], true.pressure.T)
        _agree(found.plunger[k], true.plunger.T)
        assert found.time == pytest.approx(seen.time)


@pytest.mark.parametrize("compiled", [True, False])
def test_closed_loop_records_are_the_runs_of_each_controller(compiled):
    gains, aims = np.array([[20.0, 12.0], [40.0, 5.0]]), (60 * DEG, 30 * DEG)
    law = sampled_law(Tracking(PID(Gains(*gains.T), limits=(-9.0, 9.0)), 0.0), 1)
    law = replace(law, reference=np.reshape(aims, (2, 1, 1)))
    found = closed_loop(BOTH, law, 3.0, runs=2, compiled=compiled)
    for k, rig in enumerate((design_1(), STIFF)):
        own = Simulation(rig, runs=2, seed=SEED, step=0.025 / steps_for(rig, 0.025)[0])
        alone = Tracking(PID(Gains(*gains[k]), limits=(-9.0, 9.0)), aims[k])
        made = drive(own, alone, duration=3.0)
        _agree(found.angle[k, :, 0], made.measured.angle[:, 0].T)
        _agree(found.true_angle[k, :, 0], made.truth.angle[:, 0].T)


def test_closed_loop_records_begin_before_the_rig_moves():
    law = command_law(np.array([5.0, 5.0]), 2)
    found = closed_loop(printed_gripper(), law, 1.0, runs=2, period=0.1)
    assert found.true_angle.shape == (1, 2, 2, 11)
    assert (found.true_angle[..., 0] == 0).all()


def test_what_is_not_asked_for_is_not_recorded():
    found = open_loop(design_1(), COMMANDS, keep=("plunger",))
    assert found.plunger.size == COMMANDS.size
    assert all(getattr(found, name).size == 0 for name in KEPT if name != "plunger")


def test_the_calibrated_rigs_have_the_step_that_they_had():
    for rig in (design_1(), printed_gripper()):
        assert steps_for(rig, 0.1).tolist() == [round(0.1 / LARGEST_STEP)]


def test_a_stiff_rig_is_stepped_shorter_and_stays_finite():
    # By hand: 1.5 for the spread of the damping, and friction as a damper at rest.
    rate = (np.exp(3 * STIFF.spread.damping) * 0.06 + 1e-3 / 0.05) / 2e-4
    (steps,) = steps_for(STIFF, 0.025)
    assert steps >= 0.025 * rate / 2 > STEPS[np.searchsorted(STEPS, steps) - 1]
    assert steps_for(BOTH, 0.025).tolist() == [1, steps]
    fine = replace(STIFF, spread=replace(STIFF.spread, damping=0.5))
    assert steps_for(fine, 0.025) > steps
    angle = open_loop(STIFF, COMMANDS).true_angle[0, 0, 0]
    _, finer = Simulation(STIFF, seed=SEED, step=0.025 / steps / 8).open_loop(COMMANDS)
    # As far as the simulator asks of its own largest step.
    assert angle == pytest.approx(finer.angle[:, 0, 0], abs=2e-4)
    with np.errstate(all="ignore"):
        _, coarse = Simulation(STIFF, seed=SEED, step=0.025).open_loop(COMMANDS)
    assert not np.abs(coarse.angle).max() < 10
