"""What a fit to logs minimises, and its slopes."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.simulator import fitted_rigs
from softgrip.simulator.chance import SEED, Chance
from softgrip.simulator.fit_problem import START, Problem
from softgrip.simulator.free_parameters import parameter_values
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.trial import read_trial
from tests.simulator.rigs import design_1, printed_gripper
from tests.simulator.test_trial import GRIPPER, STEP


def shortened(path, rows, **given):
    one = read_trial(path, **given)
    return replace(
        one, commands=one.commands[:rows], at=one.at[:rows], measured=one.measured[:, :rows],
        believed=one.believed[:, :rows],
    )  # fmt: skip


def problem(base, *trials):
    return Problem(base, trials, tuple(one.noise for one in trials))


def at(one, rig):
    """The point of a rig's own parameters, nothing else."""
    values = parameter_values(rig)
    scaled = one.on_scale(np.array([values[p.name] for p in one.space]))
    point = np.zeros(one.size)
    point[: len(one.space)] = (scaled - one.middle) / one.deviation
    return point


FINGER = problem(design_1(), shortened(STEP, 60), shortened(STEP, 50, clamped=True))
FINGERS = problem(printed_gripper(), shortened(GRIPPER, 12))
both = pytest.mark.parametrize("one", [FINGER, FINGERS], ids=["finger", "gripper"])


@both
def test_the_middle_of_the_ranges_is_zero_and_their_ends_are_the_90_percent(one):
    for sign, end in ((-1, "low"), (1, "high")):
        values = one.values(np.full(one.size, sign * 1.6449))
        wanted = [getattr(p, end) for p in one.space]
        # The deviations are printed with five digits.
        np.testing.assert_allclose(values, wanted, rtol=1e-9, atol=1e-15)


@both
def test_slopes_are_those_of_the_residuals(one):
    random = np.random.default_rng(3)
    point = at(one, one.base) + 0.2 * random.standard_normal(one.size)
    direction = random.standard_normal(one.size)
    _, slopes = one.linear(point)
    away = 1e-3
    before, after = (one.linear(point + sign * away * direction)[0] for sign in (-1, 1))
    central = (after - before) / (2 * away)
    # Friction bends within its small rate: one-sided slopes of 1e-4 are good to a percent there.
    np.testing.assert_allclose(slopes @ direction, central, atol=0.01 * np.abs(central).max())


def test_what_is_left_over_at_the_truth_is_the_noise():
    # The log is the fitted rig's.
    true = fitted_rigs.design_1()
    one = problem(true, read_trial(STEP))
    point, spread = at(one, true), true.spread
    run = Chance(spread, fingers=1, seed=SEED, first=0, runs=1)
    point[len(one.space) :][:3] = [
        np.log(run.stiffness.item()) / spread.stiffness,
        np.log(run.damping.item()) / spread.damping,
        np.log(run.leakage.item()) / spread.leakage,
    ]
    residuals, _ = one.linear(point)
    # Of 480 residuals: 4 * sqrt(2 / 480).
    assert np.mean(residuals[:480] ** 2) == pytest.approx(1.0, abs=0.26)
    assert residuals[480:].tolist() == point.tolist()


def test_a_start_below_the_atmosphere_is_a_plunger_drawn_out():
    """The rig begins at 2 mm of travel, is drawn out in one period, and only then is logged."""
    base = design_1(spread=False)
    pump = replace(base.pump, speed_limit=1e4, acceleration_limit=1e9)
    sensors = replace(base.sensors, pressure_noise=0, angle_noise=0, bits=40, low_count=2.0**39,
                      high_count=2.0**40 - 1)  # fmt: skip
    rig = replace(base, pump=pump, sensors=sensors)
    trial = shortened(STEP, 100)
    out = -2e-3 / pump.advance / 0.025
    seen, truth = Simulation(rig, plunger=2e-3).open_loop([out, *trial.commands])
    one = problem(rig, trial)
    found = one.predict(trial, one.values(at(one, rig))[None], truth.pressure[0])
    assert truth.pressure[0, 0] == pytest.approx(-2000, abs=500)
    # What the finger did within the one period before.
    np.testing.assert_allclose(found[0, 5:, 0], seen.pressure[6:, 0], atol=60)
    np.testing.assert_allclose(found[1, :, 0], seen.angle[1:, 0, 0], atol=0.02)
    assert -truth.pressure[0, 0] == pytest.approx(START, rel=0.5)


def test_shut_at_the_finger_it_is_the_law_of_boyle():
    base = design_1(spread=False)
    trial = replace(shortened(STEP, 120), clamped=True)
    one = problem(base, trial)
    point = at(one, base)
    values = one.values(point)
    values[[p.name for p in one.space].index("gas.leakage")] = 0.0
    found = one.predict(trial, values[None], np.zeros(1))[0, -1, 0]
    charge = base.pump.syringe_volume + base.gas.dead_volume
    left = charge - base.pump.area * trial.deepest
    assert found == pytest.approx(base.gas.atmosphere * (charge / left - 1), rel=1e-4)


def test_a_weight_has_bent_the_finger_before_the_log_begins():
    base = design_1(spread=False)
    trial = replace(shortened(STEP, 40), torque=2e-3)
    trial = replace(trial, commands=np.zeros(40))
    one = problem(base, trial)
    angle = one.predict(trial, one.values(at(one, base))[None], np.zeros(1))[1, :, 0]
    finger = base.finger
    # The torque of the memory has not all gone in 10 s, and the air that the finger swept pulls.
    settled = (2e-3 / finger.stiffness) ** (1 / finger.fractional_power)
    assert angle == pytest.approx(settled, rel=0.35)
    assert np.ptp(angle) < 0.02
