"""The regulators of Figure 3.12 on the simulated rig."""

import numpy as np
import pytest

from book.chapter_3 import regulators as lqr_gains
from book.chapter_3.figures_control import PRINTED_TIME, step_size
from book.chapter_4.identified_model import identified_model
from book.companion.choices import choice
from book.companion.twin_reach import reaches
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, input_gain, lqr_gain
from softgrip.control.minimum_time import minimum_settling_time
from softgrip.control.rig_controller import Tracking
from softgrip.control.state_feedback import StateFeedback
from softgrip.dynamics.second_order import full_state_space
from softgrip.errors import UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.logs.steps import judge_step, judge_step_log
from softgrip.provenance import data_file
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG

STEP = step_size()


def batch(regulator, runs):
    rig = Simulation(design_1(), runs=runs, seed=SEED)
    made = drive(rig, Tracking(regulator, STEP), duration=20.0)
    band = choice("lqr_band")
    return (
        judge_step(made.time, made.measured.angle[:, 0].T, STEP, band=band),
        judge_step(made.time, made.truth.angle[:, 0].T, STEP, window=0, band=band),
    )


def middle(times):
    return float(np.percentile(times, 50, method="nearest"))


def test_faster_design_has_ten_times_p_and_a_tenth_of_the_weight_on_the_rate():
    printed, fast = Weights(), lqr_gains.FAST
    assert fast.p / printed.p == pytest.approx(10)
    assert fast.q == pytest.approx((printed.q[0], printed.q[1] / 10, printed.q[2]))


def test_command_gives_the_kept_gains_again(tmp_path):
    table = lqr_gains.KEPT
    again, kept = table.read(table.write(tmp_path / "gains.csv")), table.read()
    for one, other in zip(again, kept, strict=True):
        assert one.design == other.design
        # The identification may end a little elsewhere under another library.
        for name in ("input_gain", "k1", "k2", "k3"):
            assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-3)


def test_unknown_design_is_refused():
    with pytest.raises(UnknownNameError, match="fast"):
        lqr_gains.regulator("slow")


@pytest.fixture(scope="module")
def batches():
    return {name: batch(lqr_gains.regulator(name), 40) for name in ("printed", "fast")}


def test_printed_weights_take_more_than_twice_the_printed_time(batches):
    told, true = batches["printed"]
    assert np.min(true.settled) > 2 * PRINTED_TIME
    # The averaged measurement lags behind the truth by the sensor, and averages over its window.
    assert middle(told.settled) == pytest.approx(middle(true.settled), abs=0.5)
    # On average no error is left, in a run about a degree may be: friction, and slow swinging.
    assert abs(np.mean(told.steady_state_error)) < 0.4 * DEG
    assert np.std(told.steady_state_error) < 1.5 * DEG


def test_no_rig_that_fits_the_other_prints_settles_as_soon_as_printed():
    assert reaches()["3.4-lqr-settling-measured"].word != "together"


def test_faster_design_takes_well_less_time_and_not_less_than_any_controller_on_the_model(batches):
    told, true = batches["fast"]
    model = identified_model()
    bound = minimum_settling_time(
        full_state_space(model.finger, model.pump_gain), STEP, SPEED_LIMIT, band=choice("lqr_band")
    )
    # The model is not the rig, so a single run might beat the bound.
    assert bound < middle(true.settled) < 0.7 * middle(batches["printed"][1].settled)
    assert np.abs(told.steady_state_error).max() < DEG


def test_logs_lie_among_the_batch(batches):
    for name, (told, _) in batches.items():
        path = data_file(f"simulated/lqr-{name}.csv").path
        found = judge_step_log(path, band=choice("lqr_band"))
        assert told.settled.min() <= float(found.settled) <= told.settled.max()
        assert abs(float(found.steady_state_error)) < 2 * DEG


def test_command_of_the_faster_design_is_full_at_first_and_then_turns_back():
    log = read_log(data_file("simulated/lqr-fast.csv").path)
    share = log["command"] / SPEED_LIMIT
    assert share[:8].max() == pytest.approx(1)
    assert share.min() < -0.2


def test_the_differentiator_makes_the_fast_design_swing():
    model = identified_model()
    finger, weights = lqr_gains.designed_on("fast", model)
    scale = input_gain(finger, model.pump_gain, SPEED_LIMIT)
    for jerk in (choice("lqr_jerk"), scale):
        regulator = StateFeedback(lqr_gain(finger, weights), scale, RobustDifferentiator(jerk))
        _, true = batch(regulator, 7)
        assert np.isinf(true.settled).all()
        assert np.median(true.swing) > 5 * DEG


def test_choice_of_the_jerk_moves_the_time_by_more_than_the_printed_one():
    model = identified_model()
    finger, weights = lqr_gains.designed_on("printed", model)
    scale = input_gain(finger, model.pump_gain, SPEED_LIMIT)
    times = []
    for jerk in (1.5, 5.0):
        regulator = StateFeedback(lqr_gain(finger, weights), scale, RobustDifferentiator(jerk))
        times.append(middle(batch(regulator, 7)[1].settled))
    assert np.ptp(times) > PRINTED_TIME
