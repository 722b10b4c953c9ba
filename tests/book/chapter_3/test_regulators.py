"""The regulators of Figure 3.12 on the simulated rig."""

import numpy as np
import pytest

from book.chapter_3 import regulators as lqr_gains
from book.chapter_4.identified_model import identified_model
from book.companion.simulated_logs import STEP
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, input_gain, lqr_gain
from softgrip.control.minimum_time import minimum_settling_time
from softgrip.control.rig_controller import Tracking
from softgrip.control.state_feedback import StateFeedback
from softgrip.dynamics.second_order import full_state_space
from softgrip.errors import UnknownNameError
from softgrip.logs.steps import judge_step, judge_step_log
from softgrip.provenance import data_file
from softgrip.simulator.calibration import design_1
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG


def batch(regulator, runs):
    rig = Simulation(design_1(), runs=runs, seed=SEED)
    made = drive(rig, Tracking(regulator, STEP), duration=20.0)
    return (
        judge_step(made.time, made.measured.angle[:, 0].T, STEP),
        judge_step(made.time, made.truth.angle[:, 0].T, STEP, window=0),
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


def test_printed_weights_take_three_times_the_printed_time():
    told, true = batch(lqr_gains.regulator("printed"), 100)
    # Medians 2.7 s within 5 deg and 4.2 s within 5 %; printed is 0.8 s.
    assert np.min(true.settled_5_deg) > 2.0
    assert middle(told.settled_5_deg) == pytest.approx(2.66, abs=0.1)
    assert middle(true.settled_5_percent) == pytest.approx(4.2, abs=0.5)
    # On average no error is left, in a run about a degree is: friction, and slow swinging.
    assert abs(np.mean(told.steady_state_error)) < 0.4 * DEG
    assert np.std(told.steady_state_error) == pytest.approx(1.2 * DEG, abs=0.3 * DEG)


def test_fast_design_is_near_what_any_controller_can_do_on_the_model():
    told, true = batch(lqr_gains.regulator("fast"), 100)
    model = identified_model()
    bound = minimum_settling_time(
        full_state_space(model.finger, model.pump_gain), STEP, SPEED_LIMIT, band=5 * DEG
    )
    # The model is not the rig, so a single run might beat the bound; the median is 0.2 s above.
    assert bound == pytest.approx(1.075, abs=0.026)
    assert middle(true.settled_5_deg) == pytest.approx(1.24, abs=0.05)
    assert middle(told.settled_5_deg) == pytest.approx(1.33, abs=0.05)
    assert np.min(true.settled_5_deg) > 0.8
    assert np.abs(told.steady_state_error).max() < DEG


def test_logs_say_the_same_as_the_batch():
    for name, time in (("printed", 2.62), ("fast", 1.30)):
        found = judge_step_log(data_file(f"simulated/lqr-{name}.csv").path)
        assert float(found.settled_5_deg) == pytest.approx(time, abs=0.03)
        assert abs(float(found.steady_state_error)) < 2 * DEG


def test_the_differentiator_makes_the_fast_design_swing():
    model = identified_model()
    finger, weights = lqr_gains.designed_on("fast", model)
    scale = input_gain(finger, model.pump_gain, SPEED_LIMIT)
    for jerk in (lqr_gains.JERK, scale):
        regulator = StateFeedback(lqr_gain(finger, weights), scale, RobustDifferentiator(jerk))
        _, true = batch(regulator, 7)
        assert np.isinf(true.settled_5_deg).all()
        assert np.median(true.swing) > 5 * DEG


def test_choice_of_the_jerk_decides_little_on_the_rig():
    model = identified_model()
    finger, weights = lqr_gains.designed_on("printed", model)
    scale = input_gain(finger, model.pump_gain, SPEED_LIMIT)
    for jerk in (2.0, 5.0, 20.0):
        regulator = StateFeedback(lqr_gain(finger, weights), scale, RobustDifferentiator(jerk))
        _, true = batch(regulator, 40)
        assert 2.4 < middle(true.settled_5_deg) < 3.5
