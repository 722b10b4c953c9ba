"""The simulated grasps: the layer in the loop, what rests, what holds."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm

from book.chapter_2 import grasps
from softgrip.control.pid import PERIOD
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import felt_force, layer_voltage, read_counts
from softgrip.simulator.pad_grasp import PadGrasp, grasp
from softgrip.simulator.pad_gripper import GraspGripper
from softgrip.tactile.friction import common_friction, printed_grasps

LAYER = fitted_layer()


def test_memory_of_the_layer_is_that_of_its_logs(monkeypatch):
    """Sample by sample in the loop, or at once by `felt_force`: the same."""
    monkeypatch.setattr(
        "softgrip.simulator.pad_grasp.fitted_layer",
        lambda: replace(LAYER, object_seating=0.0, voltage_noise=0.0),
    )
    gripper = replace(GraspGripper(), opening=0.0)
    plant = PadGrasp(
        grasps.squeezes()["egg"], gripper, grasps.count_forces(), samples=101, runs=1, seed=0
    )
    targets = 1e-3 * np.abs(np.sin(np.arange(100) / 9))
    read = [plant.advance(0.0, 0.0), *(plant.advance(x, PERIOD) for x in targets)]
    force = np.array(plant.force)[:, 0]
    quiet = replace(LAYER, voltage_noise=0.0)
    voltage = layer_voltage(felt_force(force, PERIOD, LAYER), 0.0, LAYER)
    want = grasps.count_forces()[read_counts(voltage, np.zeros(force.size), quiet)]
    np.testing.assert_array_equal(np.array(read)[:, 0], want)
    assert force.max() > 0.05


@pytest.mark.parametrize("name", grasps.OBJECTS)
def test_change_of_position_brings_the_reading_to_the_desired_force(name):
    found = grasps.summary(grasps.study(name))
    # A few counts of the converter, each some 0.35 to 1.4 mN.
    assert abs(found.steady_error) < 1e-3
    assert found.overshoot < 0.1
    assert found.settling_time < 5


@pytest.mark.parametrize("name", grasps.OBJECTS)
def test_true_force_scatters_as_the_layer_is_seated(name):
    """Independent: the reading is right, so the true force is it by the part that is felt."""
    found, seating = grasps.summary(grasps.study(name)), fitted_layer().object_seating
    # Deviation of a deviation of 200: five per cent; the regressor's own errors add up to it.
    assert found.force_deviation / found.force == pytest.approx(seating, rel=0.25)


@pytest.mark.parametrize("name", grasps.OBJECTS)
def test_position_rests_where_force_and_command_agree(name):
    made = grasps.position_study(name)
    wanted, closing = grasps.desired_force(name), grasps.squeezes()[name]
    kp = float(grasps.position_gains().kp)
    measured, true = grasps.at_rest(made, made.measured), grasps.at_rest(made, made.force)
    # A step of the servo, and the curvature over a ripple of about one.
    ends = [closing.at(kp * (wanted - measured) + d * GraspGripper().resolution) for d in (-1, 1)]
    assert ((ends[0] <= true) & (true <= ends[1])).all()
    assert (measured < 0.5 * wanted).all()


def test_a_run_is_the_same_in_any_batch():
    one, many = (
        grasp(
            grasps.squeezes()["carrot"],
            grasps.study_gains(),
            0.08,
            grasps.count_forces(),
            duration=2.0,
            runs=runs,
            seed=3,
        )
        for runs in (1, 4)
    )
    np.testing.assert_array_equal(one.measured[0], many.measured[0])
    assert not np.array_equal(many.force[0], many.force[1])


def test_harder_rubber_holds_less_and_weights_decide():
    for name in grasps.OBJECTS:
        shares = [grasps.held_share(name, friction) for friction in (0.3, 0.9, 1.0, 1.1, 3.0)]
        assert shares == sorted(shares)
        assert (shares[0], shares[-1]) == (0.0, 1.0)


def test_held_share_is_that_of_a_normal_force():
    """By hand for the egg: the share of a normal force above weight / 2 (friction 1)."""
    found = grasps.summary(grasps.study("egg"))
    least = float(printed_grasps()["egg"].weight) / 2
    want = norm.sf((least - found.force) / found.force_deviation)
    # Four deviations of a share of 200.
    assert grasps.held_share("egg", 1.0) == pytest.approx(want, abs=4 * 0.5 / grasps.RUNS**0.5)


def test_fitted_friction_is_within_the_error_of_a_model_of_what_the_print_leaves():
    """A twentieth, as of all fitted numbers; it is fitted to the lift forces as they stand."""
    common = common_friction()
    assert 0.95 * common.low <= grasps.friction() <= 1.05 * common.high


def test_four_times_the_gains_make_the_stiff_contacts_swing():
    egg, tofu = (grasps.summary(grasps.study(name, 4.0)).ripple for name in ("egg", "tofu"))
    assert egg > 20 * grasps.summary(grasps.study("egg")).ripple
    # The tofu is so much softer that its loop gain is below that at which it swings.
    assert tofu < 2e-3
