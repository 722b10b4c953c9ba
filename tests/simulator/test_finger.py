"""The simulated rig as a whole."""

from dataclasses import replace

import numpy as np
import pytest

from book.chapter_5.logs import STEP_PLUNGER, STEPS
from softgrip.errors import InvalidInputError
from softgrip.simulator import finger as plant
from softgrip.simulator.angle_plant import AnglePlant
from softgrip.simulator.batches import in_parts
from softgrip.simulator.calibration import design_1
from softgrip.simulator.capacity_check import constant_capacity_error, least_air_swept
from softgrip.simulator.finger import SimulatedRig
from softgrip.units import DEG, ML, REV

RIG = design_1()
CALM = design_1(spread=False)


def abrupt(samples, runs, seed=1):
    speeds = np.random.default_rng(seed).choice([-5.0, 5.0, 0.0, 2.0], (samples // 20, runs))
    return np.repeat(speeds, 20, axis=0) * REV


def same(one, two, *, runs=slice(None)):
    for name, value in vars(one).items():
        other = getattr(two, name)
        other = other[..., runs] if name != "time" else other
        np.testing.assert_allclose(value, other, rtol=1e-11, atol=1e-13, err_msg=name)


def test_one_seed_gives_one_run():
    commands = abrupt(100, 3)
    first, again = (SimulatedRig(RIG, runs=3, seed=5).open_loop(commands) for _ in range(2))
    for one, two in zip(first, again, strict=True):
        same(one, two)
    other, _ = SimulatedRig(RIG, runs=3, seed=6).open_loop(commands)
    assert (other.angle_counts != first[0].angle_counts).mean() > 0.5


@pytest.mark.parametrize("i", [0, 3])
def test_run_of_a_batch_is_the_run_alone(i):
    commands = abrupt(100, 4)
    batch = SimulatedRig(RIG, runs=4, seed=5).open_loop(commands)
    alone = SimulatedRig(RIG, first=i, seed=5).open_loop(commands[:, i : i + 1])
    for one, many in zip(alone, batch, strict=True):
        same(one, many, runs=slice(i, i + 1))


def test_runs_of_a_batch_differ():
    _, truth = SimulatedRig(RIG, runs=4).open_loop(np.full(40, 5 * REV))
    assert np.ptp(truth.angle[-1]) > 1 * DEG


def test_parts_are_the_batch():
    commands = abrupt(60, 7)
    whole = SimulatedRig(RIG, runs=7, seed=2).open_loop(commands)
    sizes = []
    for part, *found in in_parts(RIG, commands, runs=7, seed=2, limit=3 * 8 * 25 * 60):
        sizes.append(part.stop - part.start)
        for one, many in zip(found, whole, strict=True):
            same(one, many, runs=part)
    assert sizes == [3, 3, 1]


def test_sampled_loop_gives_what_the_open_loop_gives():
    commands = abrupt(60, 2)
    batch, truth = SimulatedRig(RIG, runs=2).open_loop(commands)
    rig = SimulatedRig(RIG, runs=2)
    for k, command in enumerate(commands):
        found = rig.advance(command)
        np.testing.assert_array_equal(found.angle, batch.angle[k])
        np.testing.assert_array_equal(found.pressure_counts, batch.pressure_counts[k])
        np.testing.assert_allclose(rig.truth.pressure, truth.pressure[k], rtol=1e-12, atol=1e-9)


def test_noise_is_of_the_sample_and_not_of_the_step(monkeypatch):
    # A finer step must leave the noise where it is: what changes is the error of the integration.
    commands = abrupt(240, 5)
    coarse, coarse_truth = SimulatedRig(RIG, runs=5).open_loop(commands)
    monkeypatch.setattr(plant, "LARGEST_STEP", plant.LARGEST_STEP / 16)
    fine, fine_truth = SimulatedRig(RIG, runs=5).open_loop(commands)
    assert abs(coarse.angle_counts - fine.angle_counts).max() <= 1
    assert abs(coarse_truth.angle - fine_truth.angle).max() < 2e-4
    assert abs(coarse_truth.pressure - fine_truth.pressure).max() < 5.0


@pytest.mark.parametrize("period", [0.025, 0.1])
def test_stiff_air_follows_the_isothermal_law_exactly(period):
    finger = replace(CALM.finger, torque_per_pressure=0.0, ballooning=0.0)
    gas = replace(CALM.gas, leakage=0.0)
    rig = SimulatedRig(replace(CALM, finger=finger, gas=gas), period=period)
    _, truth = rig.open_loop(np.full(round(3 / period), 1.65 * REV))
    start = CALM.pump.syringe_volume + gas.dead_volume + finger.rest_volume
    volume = start - CALM.pump.area * truth.plunger[:, 0]
    np.testing.assert_allclose(
        truth.pressure[:, 0] + gas.atmosphere, gas.atmosphere * start / volume, rtol=1e-12
    )
    # n R T: what the amount of air is said to be, in mol, at the stated temperature.
    mol = gas.atmosphere * start / (8.314462618 * gas.temperature)
    np.testing.assert_allclose(truth.amount, mol, rtol=1e-12)


def test_air_is_kept_without_a_leak_and_lost_with_it():
    commands = np.concatenate([np.full(60, 5 * REV), np.zeros(340)])
    tight = replace(CALM, gas=replace(CALM.gas, leakage=0.0))
    _, kept = SimulatedRig(tight).open_loop(commands)
    _, lost = SimulatedRig(CALM).open_loop(commands)
    assert np.ptp(kept.amount) == 0
    assert (np.diff(lost.amount[:, 0]) < 0).all()


def test_motor_and_stroke_limits_hold():
    commands = abrupt(400, 8) * 3
    rig = SimulatedRig(RIG, runs=8)
    _, truth = rig.open_loop(commands)
    assert abs(truth.motor_speed).max() == pytest.approx(RIG.pump.speed_limit)
    change = abs(np.diff(truth.motor_speed, axis=0))
    at_end = (truth.plunger[1:] == 0) | (truth.plunger[1:] == RIG.pump.stroke)
    assert change[~at_end].max() <= RIG.pump.acceleration_limit * 0.025 * (1 + 1e-9)
    assert truth.plunger.min() == 0
    assert truth.plunger.max() == RIG.pump.stroke
    assert truth.motor_speed[truth.plunger == RIG.pump.stroke].max() == 0


def test_sensors_have_the_stated_noise():
    found, truth = SimulatedRig(CALM, runs=200, seed=3).open_loop(np.zeros(50))
    off = (found.angle - truth.angle) / DEG
    # 2 deg and the rounding of the converter, from 10,000 samples: 1 % of scatter.
    assert off.std() == pytest.approx(2.0, rel=0.03)
    assert abs(off.mean()) < 0.08
    lags = (off[1:] * off[:-1]).mean() / off.var()
    assert abs(lags) < 0.04


def test_run_to_run_spread_is_the_printed_one():
    # Section 5.4: 2 to 3 deg. Against the closed form, which holds the pressure, a softer finger
    # here takes more air and so sees less of it: some 10 %, and 4 % of scatter from 300 runs.
    spread = []
    for angle in STEP_PLUNGER:
        commands = STEPS[f"step-{angle}-1"].commands
        _, truth = SimulatedRig(RIG, runs=300).open_loop(commands)
        assert np.median(truth.angle[-1]) / DEG == pytest.approx(angle, abs=1.0)
        spread.append(truth.angle[-1].std() / DEG)
    assert 2.0 < np.mean(spread) < 3.0
    held = [2.5 * angle / 75 for angle in STEP_PLUNGER]
    np.testing.assert_allclose(spread, held, rtol=0.2)
    assert (np.array(spread) < held).all()


def test_constant_capacity_cannot_lie_above_a_closed_syringe():
    # The text has it 30 % above the truth at high pressure; ideal gas at one temperature has it
    # below, since the sweep that it would take is more than all the air at the start.
    assert constant_capacity_error() < -0.3
    assert least_air_swept(101325.0, 0.0) == 1.0
    reached = 0
    for ballooning in (0.0, 6e-12, 1e-10, 4e-10):
        finger = replace(CALM.finger, ballooning=ballooning)
        rig = SimulatedRig(replace(CALM, finger=finger))
        _, truth = rig.open_loop(np.full(320, 1.65 * REV))
        start = 60 * ML + CALM.gas.dead_volume + finger.rest_volume
        capacity = start / CALM.gas.atmosphere + ballooning
        high = truth.pressure[:, 0] >= CALM.gas.atmosphere
        reached += high.any()
        model = CALM.pump.area * truth.plunger[high, 0] / capacity
        assert (model < truth.pressure[high, 0]).all()
    assert reached >= 2


def test_angle_plant_tells_the_measured_angle_and_measures_at_rest():
    rig, own = SimulatedRig(RIG, runs=2), AnglePlant(SimulatedRig(RIG, runs=2))
    for command, duration in ((0.0, 0.0), (20.0, 0.025), (20.0, 0.1)):
        expected = rig.advance(command, duration).angle
        np.testing.assert_array_equal(own.advance(command, duration), expected)
    assert own.rig.time == pytest.approx(0.125)


@pytest.mark.parametrize(
    "settings", [{"runs": 0}, {"seed": -1}, {"period": 0.0}, {"plunger": 1.0}, {"plunger": -0.1}]
)
def test_bad_settings_are_refused(settings):
    with pytest.raises(InvalidInputError):
        SimulatedRig(RIG, **settings)


def test_bad_commands_are_refused():
    rig = SimulatedRig(RIG)
    with pytest.raises(InvalidInputError, match="finite"):
        rig.advance(np.nan)
    with pytest.raises(InvalidInputError, match="whole number"):
        rig.advance(0.0, 0.03)
    with pytest.raises(InvalidInputError, match="shape"):
        rig.open_loop(np.zeros((2, 2, 2)))
