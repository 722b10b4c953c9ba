"""The controllers of Chapter 4 on the simulated rig: gains, logs, and what the logs say."""

import numpy as np
import pytest

from book.chapter_3.logs import LOGS as REGULATED
from book.chapter_4 import pid_gains
from book.chapter_4.controllers import controller, settled_on_rig
from book.chapter_4.identified_model import (
    PUSH_LOG,
    identified_model,
    identify_capacity,
    identify_finger,
)
from book.chapter_4.logs import CONTROLLED
from book.companion.choices import choice
from book.companion.claims import printed
from softgrip.control.designs import NOISE
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.minimum_time import farthest
from softgrip.control.pid import PERIOD, PID
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed
from softgrip.control.rig_controller import Tracking
from softgrip.control.staircase import staircase
from softgrip.dynamics.second_order import full_state_space
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import judge_step, judge_step_log, smoothed
from softgrip.provenance import data_file
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.small_signal import (
    OPERATING_ANGLE,
    small_signal_poles,
    small_signal_stiffness,
)
from softgrip.units import DEG, ML


def kept(name):
    return data_file(f"simulated/{name}.csv").path


@pytest.fixture(scope="module")
def model():
    return identified_model()


def test_rig_does_not_move_before_the_first_command():
    rig = Simulation(design_1())
    angle = rig.measure().angle[0]
    assert rig.time == 0
    assert rig.truth.angle == rig.truth.plunger == 0
    assert abs(float(angle[0])) < 10 * DEG  # five times the noise


def test_identified_finger_is_near_the_small_signal_truth(model):
    # A spring that stiffens has no one linear model: its secant over a step to 60 deg is softer by
    # n than its slope there, so the frequency is lower than that of small motions at 60 deg, by up
    # to sqrt(n); the lag of the flex sensor takes some more.
    true = design_1().finger
    n = true.fractional_power
    frequency = abs(small_signal_poles(true, OPERATING_ANGLE)[0])
    assert frequency / n**0.5 * 0.75 < model.finger.natural_frequency < frequency
    secant = small_signal_stiffness(true, OPERATING_ANGLE) / n
    # The settled gain, less what the slow memory still holds after 6 s (at most 5 %), with spread.
    assert model.finger.gain == pytest.approx(true.torque_per_pressure / secant, rel=0.12)


def test_identified_capacity_is_that_of_the_air_in_the_rig(model):
    # Rigid: (60 mL + tube + finger) / P_atm at the start. It falls with the push and grows with
    # the bend, both by less than a tenth at 20 kPa.
    rig = design_1()
    rigid = (60 * ML + rig.gas.dead_volume + rig.finger.rest_volume) / rig.gas.atmosphere
    assert model.capacity == pytest.approx(rigid, rel=0.1)
    assert model.pump_gain == pytest.approx(6.61e-4 * 0.008 / (2 * np.pi) / model.capacity)


def test_capacity_needs_the_pump_in_the_header(tmp_path):
    path = tmp_path / "push.csv"
    path.write_text(data_file(PUSH_LOG).path.read_text().replace("# area: 0.000661 m^2\n", ""))
    with pytest.raises(DataFileError, match="area"):
        identify_capacity(path)


def test_logs_of_different_times_are_not_averaged():
    with pytest.raises(DataFileError, match="times"):
        identify_finger([kept("step-60-1"), kept("push-a")])


def test_command_gives_the_kept_gains_again(tmp_path):
    kept = pid_gains.KEPT
    again, before = kept.read(kept.write(tmp_path / "gains.csv")), kept.read()
    assert [(r.design, r.stage) for r in again] == [(r.design, r.stage) for r in before]
    for one, other in zip(again, before, strict=True):
        # The identification may end a little elsewhere under another library.
        for name in ("kp", "ki", "kd", "derivative_filter"):
            assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-3)


def test_unknown_controllers_are_refused():
    with pytest.raises(UnknownNameError, match="full tuned"):
        pid_gains.pid_gains("half")
    with pytest.raises(InvalidInputError, match="actuator by plunger"):
        controller("half")


@pytest.mark.parametrize("name", [*CONTROLLED, *REGULATED])
def test_log_replayed_in_open_loop_gives_its_own_measurements(name):
    # The controller adds nothing but the command: the rig alone, given it, says the same.
    log = read_log(kept(name))
    assert log.repairs == ()
    assert np.max(np.abs(log["command"])) <= SPEED_LIMIT
    rig = Simulation(design_1(), seed=SEED, period=PERIOD)
    first = rig.measure()
    assert log["angle"][0] == first.angle[0, 0]
    seen, _ = rig.open_loop(log["command"][1:])
    np.testing.assert_array_equal(seen.angle[:, 0, 0], log["angle"][1:])


@pytest.mark.parametrize("name", ["actuator", "full"])
def test_log_of_a_step_lies_among_runs_of_its_controller(name):
    step, band = choice("pid_step"), choice("pid_band")
    log = judge_step_log(kept(f"pid-{name}"), band=band)
    rig = Simulation(design_1(), runs=7, seed=SEED)
    made = drive(rig, Tracking(controller(name), step), duration=20.0)
    told = judge_step(made.time, made.measured.angle[:, 0].T, step, band=band)
    assert told.settled.min() <= float(log.settled) <= told.settled.max()
    # The log is the first of these runs.
    assert float(log.steady_state_error) == pytest.approx(told.steady_state_error[0])
    assert float(log.noise) == pytest.approx(design_1().sensors.angle_noise, rel=0.1)


def test_set_pressure_decides_when_the_actuator_design_settles():
    # The set pressure is not stated; the smaller it is, the larger the gain of the loop.
    settled = []
    for set_pressure in (150e3, 100e3, 50e3, 20e3):
        pid = PID(pid_gains.pid_gains("actuator"), limits=(-SET_PRESSURE, SET_PRESSURE))
        by_share = PressureAsSpeed(pid, set_pressure=set_pressure)
        rig = Simulation(design_1(), runs=7, seed=SEED)
        made = drive(rig, Tracking(by_share, 60 * DEG), duration=20.0)
        response = judge_step(made.time, made.measured.angle[:, 0].T, 60 * DEG)
        settled.append(float(np.median(response.settled_5_deg)))
    assert settled[0] > settled[1] > settled[2]
    assert settled[0] > 2 * settled[2]
    # Too large a gain swings.
    assert settled[3] > settled[2]


def test_plunger_reading_settles_late_or_never():
    step, band = choice("pid_step"), choice("pid_band")
    rig = Simulation(design_1(), runs=7, seed=SEED)
    made = drive(rig, Tracking(controller("actuator by plunger"), step), duration=20.0)
    found = judge_step(made.time, made.measured.angle[:, 0].T, step, band=band)
    other = settled_on_rig("actuator", step)
    assert found.settled.min() > 2 * other
    # Some runs never do; with the fitted motor, whose ramp is short, the middle one just does.
    assert np.isinf(found.settled).any()
    assert np.median(found.settled) > 4 * other


def test_staircase_lags_more_than_the_printed_fifth_of_a_second(model):
    response = judge_staircase(kept("staircase"))
    assert response.edges == 12
    assert response.lag > 1.5 * printed("4.4-time-to-change")
    assert response.time_to_change > 3 * printed("4.4-time-to-change")
    # No controller can: 90 % of a change lie beyond what 5 rev/s all the way do in 0.2 s.
    system = full_state_space(model.finger, model.pump_gain)
    reached = float(farthest(system, SPEED_LIMIT, printed("4.4-time-to-change")))
    assert reached < 0.9 * choice("stair_increment")
    # Nor is that to be seen behind the noise of the sensor (Figure 4.C).
    assert reached < NOISE


def test_angle_lies_above_the_staircase_on_its_way_down():
    log = read_log(kept("staircase"))
    down = log["time"] > log["time"][-1] * 0.6
    assert (log["angle"] - log["reference"])[down].mean() > 0.2 * choice("stair_increment")


def test_step_figures_of_a_known_response():
    time = np.arange(0, 20, 0.01)
    angle = 1.0 - np.exp(-time)
    found = judge_step(time, np.stack([angle, 0.9 * angle]), 1.0, window=0.0)
    assert found.settled_2_percent[0] == pytest.approx(np.log(50), abs=1e-3)
    assert found.settled_5_deg[0] == pytest.approx(-np.log(5 * DEG), abs=1e-3)
    # The second keeps an error of 0.1 rad: it settles about its own end alone.
    assert np.isinf(found.settled_5_deg[1])
    assert found.steady_state_error[1] == pytest.approx(0.1, abs=1e-6)
    own = judge_step(time, 0.9 * angle, 1.0, about="own end", window=0.0)
    assert own.settled_2_percent == pytest.approx(np.log(0.9 / 0.018), abs=1e-3)


def test_what_settles_only_at_the_end_of_the_record_has_not_settled():
    time = np.arange(0, 10, 0.01)
    late = np.where(time < 9.0, 0.0, 1.0)
    assert np.isinf(judge_step(time, late, 1.0, window=0.0).settled_5_deg)


def test_averaging_delays_nothing_and_takes_noise_away():
    ramp = np.arange(400) * 0.01
    np.testing.assert_allclose(smoothed(ramp, 0.025)[20:-20], ramp[20:-20])
    noise = np.random.default_rng(1).normal(size=100_000)
    # 21 samples: 0.5 s at 25 ms, made odd.
    assert np.std(smoothed(noise, 0.025)) == pytest.approx(21**-0.5, rel=0.03)


def test_staircase_has_the_printed_hold_and_comes_back():
    reference = staircase()
    changes = np.flatnonzero(np.diff(reference))
    np.testing.assert_allclose(np.diff(changes) * 0.025, 1.2)
    assert reference.max() == pytest.approx(60 * DEG)
    np.testing.assert_array_equal(reference, reference[::-1])
    with pytest.raises(InvalidInputError):
        staircase(increment=7 * DEG)


def test_logs_without_a_fitting_reference_are_refused(tmp_path):
    with pytest.raises(DataFileError, match="reference"):
        judge_step_log(kept("step-60-1"))
    with pytest.raises(DataFileError, match="one step"):
        judge_step_log(kept("staircase"))
    with pytest.raises(DataFileError, match="staircase"):
        judge_staircase(kept("pid-full"))
