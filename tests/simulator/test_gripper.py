"""The simulated gripper: against the rig with one finger, conservation, steps, chance."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.simulator.calibration import design_1
from softgrip.simulator.finger import SimulatedRig
from softgrip.simulator.gripper import GripperRig
from softgrip.simulator.gripper_loop import CommandSequence, drive_gripper
from softgrip.simulator.gripper_parameters import drawn_gripper, printed_gripper
from softgrip.simulator.parameters import GripperParameters, RigParameters
from softgrip.units import DEG, REV

CALM = printed_gripper(spread=False)


def abrupt(samples, seed=1):
    speeds = np.random.default_rng(seed).choice([-5.0, 5.0, 0.0, 2.0], samples // 4)
    return np.round(np.repeat(speeds, 4) * REV, 6)  # as `drive_gripper` rounds


def run(parameters, commands, *, runs=1, seed=0, first=0, step=0.025, push=None):
    rig = GripperRig(parameters, runs=runs, seed=seed, first=first, step=step)
    return drive_gripper(
        rig, CommandSequence(commands), duration=len(commands) * rig.period, push=push
    )


def alike(finger, count):
    """Return the finger that is `count` fingers in one: all torques and volumes add up."""
    names = ("stiffness", "inertia", "damping", "torque_per_pressure", "rest_volume",
             "ballooning", "friction")  # fmt: skip
    return replace(finger, **{name: count * getattr(finger, name) for name in names})


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_equal_fingers_are_one_finger_of_all_their_torque_and_volume(count):
    finger = design_1(spread=False).finger
    many = GripperParameters((finger,) * count, pump=CALM.pump)
    one = RigParameters(alike(finger, count), pump=CALM.pump)
    commands = abrupt(60)
    found = run(many, commands).truth
    _, expected = SimulatedRig(one, period=0.1).open_loop(commands)
    assert np.ptp(expected.angle) > 60 * DEG
    for k in range(count):
        np.testing.assert_allclose(found.angle[1:, k, 0], expected.angle[:, 0], rtol=1e-9)
    np.testing.assert_allclose(found.pressure[1:], expected.pressure, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(found.plunger[1:], expected.plunger, rtol=1e-12)


def test_air_is_kept_without_a_leak_and_lost_with_it():
    commands = np.concatenate([np.full(10, 5 * REV), np.zeros(40)])
    tight = replace(CALM, gas=replace(CALM.gas, leakage=0.0))
    kept = run(tight, commands).truth
    assert np.ptp(kept.amount) == 0
    # The same air by the gas law, from the volumes: fingers, tube and syringe.
    fingers, gas, pump = tight.fingers, tight.gas, tight.pump
    gauge = kept.pressure[:, 0]
    volume = pump.syringe_volume - pump.area * kept.plunger[:, 0] + gas.dead_volume
    for k, finger in enumerate(fingers):
        volume += finger.rest_volume + finger.torque_per_pressure * kept.angle[:, k, 0]
        volume += finger.ballooning * gauge
    np.testing.assert_allclose((gauge + gas.atmosphere) * volume, kept.amount[:, 0], rtol=1e-12)
    assert (np.diff(run(CALM, commands).truth.amount[10:, 0]) < 0).all()


def energy(parameters, truth):
    """Return kinetic, spring and isothermal gas energy, J."""
    gas, pump = parameters.gas, parameters.pump
    volume = pump.syringe_volume - pump.area * truth.plunger[:, 0] + gas.dead_volume
    total = np.zeros_like(volume)
    for k, finger in enumerate(parameters.fingers):
        angle, rate, n = truth.angle[:, k, 0], truth.rate[:, k, 0], finger.fractional_power
        total += finger.inertia * rate**2 / 2
        total += finger.stiffness * np.abs(angle) ** (n + 1) / (n + 1)
        volume = volume + finger.rest_volume + finger.torque_per_pressure * angle
    start = volume[0]
    return total - truth.amount[:, 0] * np.log(volume / start) + gas.atmosphere * (volume - start)


def test_energy_is_kept_without_losses_and_falls_with_them():
    bare = {"damping": 0.0, "friction": 0.0, "memory": (0.0, 0.0), "ballooning": 0.0}
    free = replace(
        CALM,
        fingers=tuple(replace(finger, **bare) for finger in CALM.fingers),
        gas=replace(CALM.gas, leakage=0.0),
    )
    # After the push the plunger stands still: the rest is the fingers' own motion.
    commands = np.concatenate([[4.3 * REV], np.zeros(40)])
    free_energy = energy(free, run(free, commands, step=0.00125).truth)[2:]
    scale = np.ptp(run(free, commands).truth.rate[:, 0]) ** 2 * free.fingers[0].inertia / 8
    assert np.ptp(free_energy) < 2e-3 * scale
    damped = replace(
        free, fingers=tuple(replace(f, damping=0.008, friction=1e-4) for f in free.fingers)
    )
    lost = np.diff(energy(damped, run(damped, commands, step=0.00125).truth)[2:])
    assert lost.max() < 1e-9
    assert -lost.sum() > 100 * np.ptp(free_energy)


def test_a_finer_step_changes_less_than_a_tenth_of_a_count():
    gripper, commands = printed_gripper(), abrupt(80, seed=3)
    coarse = run(gripper, commands, runs=3)
    fine = run(gripper, commands, runs=3, step=0.025 / 16)
    assert abs(coarse.truth.angle - fine.truth.angle).max() < 2e-4
    assert abs(coarse.truth.pressure - fine.truth.pressure).max() < 5.0
    assert abs(coarse.measured.angle_counts - fine.measured.angle_counts).max() <= 1


@pytest.mark.parametrize("i", [0, 3])
def test_run_of_a_batch_is_the_run_alone(i):
    commands = abrupt(40)
    batch = run(printed_gripper(), commands, runs=4, seed=5)
    alone = run(printed_gripper(), commands, seed=5, first=i)
    for one, many in ((alone.measured, batch.measured), (alone.truth, batch.truth)):
        for name, value in vars(one).items():
            other = getattr(many, name)
            other = other if name == "time" else other[..., i : i + 1]
            np.testing.assert_allclose(value, other, rtol=1e-9, atol=1e-12, err_msg=name)
    assert np.ptp(batch.truth.angle[-1, 0]) > 0.5 * DEG


def test_a_push_moves_its_finger_and_through_the_air_the_other():
    # A finger held back takes less air, so that the pressure and the other finger rise.
    commands = np.concatenate([[4.3 * REV], np.zeros(60)])
    free = run(CALM, commands).truth
    pushed = run(CALM, commands, push=lambda t: [[-1e-3 if t > 2.95 else 0.0], [0.0]]).truth
    off = (pushed.angle - free.angle)[-1, :, 0]
    np.testing.assert_array_equal(pushed.angle[:30], free.angle[:30])
    assert off[0] < -2 * DEG
    assert 0 < off[1] < 1 * DEG
    assert pushed.pressure[-1] > free.pressure[-1]


def test_fingers_of_a_drawn_gripper_are_its_own_in_each_run():
    one, again, other = (drawn_gripper(4, seed=seed) for seed in (1, 1, 2))
    assert one == again != other
    assert len({finger.rest_volume for finger in one.fingers}) == 4
    many = [f.stiffness for seed in range(200) for f in drawn_gripper(5, seed=seed).fingers]
    pair = np.log([finger.stiffness for finger in CALM.fingers])
    # 1,000 numbers tell a deviation to 2 %.
    assert np.log(many).std() == pytest.approx(pair.std(ddof=1), rel=0.07)
    assert np.log(many).mean() == pytest.approx(pair.mean(), abs=0.05)


def test_motor_and_stroke_limits_hold():
    truth = run(CALM, np.full(60, 9 * REV)).truth
    assert truth.motor_speed.max() == pytest.approx(5 * REV)
    assert truth.plunger.max() == CALM.pump.stroke
    assert truth.motor_speed[-1] == 0


@pytest.mark.parametrize("settings", [{"runs": 0}, {"seed": -1}, {"period": 0.0}, {"step": 0.05}])
def test_bad_settings_are_refused(settings):
    with pytest.raises(InvalidInputError):
        GripperRig(CALM, **settings)


def test_bad_commands_torques_and_fingers_are_refused():
    rig = GripperRig(CALM)
    with pytest.raises(InvalidInputError, match="command"):
        rig.advance(np.nan)
    with pytest.raises(InvalidInputError, match="torque"):
        rig.push(np.inf)
    with pytest.raises(InvalidInputError, match="one to five"):
        GripperParameters(CALM.fingers * 3)
    with pytest.raises(InvalidInputError, match="branches"):
        GripperParameters(
            (CALM.fingers[0], replace(CALM.fingers[1], memory=(0.1,), memory_time=(1.0,)))
        )
