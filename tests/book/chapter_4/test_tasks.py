"""The answers of Chapter 4's tasks and questions, found another way, within the sliders' reach."""

from dataclasses import replace

import control
import numpy as np
import pytest

from book.chapter_4 import tasks
from book.chapter_4.controllers import own_loop
from book.chapter_4.identified_model import identified_model
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.chapter_4.sliders import PUMP_PLOT, pid, pump, sizing
from book.chapter_4.tables import LEAST_MARGIN, finger_to_drive
from book.companion.choices import choice
from softgrip.control.pid import Gains, pid_state_space
from softgrip.dynamics.second_order import full_state_space
from softgrip.logs.pushes import reference_noise
from softgrip.logs.reader import kept_log
from softgrip.pump.sizing import sizings
from softgrip.units import DEG, ML, MPa
from tests.book.explore.page_laws import page_laws


def within(law, **values):
    """Tell whether the sliders of a page can be set to these values."""
    ranges = page_laws()[law].ranges
    return all(ranges[name].low <= value <= ranges[name].high for name, value in values.items())


def scaled(kp, ki, kd):
    tuned = pid_gains("full")
    return Gains(kp * tuned.kp, ki * tuned.ki, kd * tuned.kd, tuned.derivative_filter)


@pytest.mark.parametrize("syringe", ["60 mL", "200 mL"])
def test_time_to_the_pressure_is_where_the_drawn_curve_passes_it(syringe):
    found = pump(syringe, 8.0, 2.0)
    assert np.interp(tasks.PRESSURE / MPa, found["gas"], found["time"]) == pytest.approx(
        tasks.time_to_pressure(syringe),
        rel=2e-3,  # a polygon of 80 points
    )
    (level, *_) = PUMP_PLOT.panels[0].marks
    assert level.at == pytest.approx(tasks.PRESSURE / MPa)


def test_a_full_larger_syringe_saves_no_time():
    small, large = map(tasks.time_to_pressure, ("60 mL", "200 mL"))
    assert 1 < large / small < 1.05


@pytest.mark.parametrize(
    "parts", [("60 mL", 10, 5), ("60 mL", 3, 3), ("200 mL", 8, 2), ("200 mL", 10, 4)]
)
def test_constant_share_is_that_of_any_parts(parts):
    _, lead, speed = parts
    assert within("pump", lead=lead, speed=speed)
    found = pump(*parts)
    at = np.interp(tasks.PRESSURE / MPa, found["gas"], found["time"])
    share = np.interp(at, found["time"], found["constant"]) / (tasks.PRESSURE / MPa)
    assert share == pytest.approx(tasks.constant_share(), rel=2e-3)


@pytest.mark.parametrize("coupling", [0.0, 0.01])
def test_rank_by_angle_counts_the_states_that_change_a_reading(coupling):
    step = np.array([[1, 0.1], [coupling, 1]])

    def readings(state):
        return [(np.linalg.matrix_power(step, k) @ state)[1] for k in range(5)]

    seen = [max(map(abs, readings(unit))) > 0 for unit in np.eye(2)]
    assert tasks.rank_by_angle(coupling) == sum(seen)


@pytest.mark.parametrize("moved", [0, 1, 100])
def test_rank_by_pressure_counts_what_two_machines_show_differently(moved):
    flows = [8.7e-6] * moved + [0.0] * (100 - moved)
    # Two elastances, one pressure at the start: do the pressures ever differ?
    first, second = (np.cumsum(flows) * 0.025 * elastance for elastance in (1e9, 2e9))
    assert tasks.rank_by_pressure(flows) == 1 + bool(np.any(first != second))


def test_errors_of_the_filter_at_both_ends_are_those_of_the_push():
    noise = page_laws()["capacity_filter"].ranges["noise"]
    for factor, said in ((noise.low, 33), (noise.high, 2)):
        levels = reference_noise()
        levels = replace(levels, elastance_step=factor * levels.elastance_step)
        found = pushed(kept_log("push-a"), levels)
        error = 100 * abs(found.error(found.filtered))
        # The law filters a sample at a time: to rounding.
        assert tasks.filter_error(factor) == pytest.approx(error, rel=1e-6)
        assert error == pytest.approx(said, abs=1), "the page's words: far off, and near"


def test_without_integral_no_error_is_left():
    assert within("pid", kp=1, ki=0, kd=1)
    model = identified_model()
    loop = control.series(
        pid_state_space(scaled(1, 0, 1)), full_state_space(model.finger, model.pump_gain)
    )
    assert float(np.real(control.feedback(loop).dcgain())) == pytest.approx(1, abs=1e-6)
    assert 0 < tasks.left_without_integral() < 0.01 * choice("pid_step") / DEG
    # And it is still getting smaller.
    error = np.abs(pid(1.0, 0.0, 1.0)["angle"] - choice("pid_step") / DEG)
    assert error[-1] < error[-40]


def test_the_loop_swings_for_ever_below_the_least_derivative():
    least = tasks.least_derivative()
    assert within("pid", kp=1.5, ki=1, kd=least)

    def swings(kd):
        # A step so small that the motor never reaches its limit.
        found = own_loop("full", scaled(1.5, 1, kd), duration=40, step=1e-3)
        early, late = np.array_split(np.ravel(found.measured)[400:], 2)
        return np.ptp(late) / np.ptp(early)

    assert swings(0.97 * least) > 1 > swings(1.03 * least)


def test_below_it_the_explorer_shows_a_swing_that_stays():
    least, span = tasks.least_derivative(), {}
    for factor in (0.85, 1.4):
        halves = np.array_split(pid(1.5, 1.0, factor * least)["angle"][160:], 2)
        span[factor] = [np.ptp(half) for half in halves]
    # Of what it swings by in the third quarter, the last one keeps nearly all, or clearly less.
    assert span[0.85][1] > 0.97 * span[0.85][0]
    assert span[1.4][1] < 0.9 * span[1.4][0]


def test_largest_pressure_is_the_last_that_some_parts_reach():
    finger = finger_to_drive()
    volume, rise = finger.volume_at_rest / ML, finger.rise_time
    found = tasks.largest_pressure(volume, rise)
    assert within("sizing", pressure=found, volume=volume, rise=rise)
    for pressure, reached in ((found, True), (found + 0.002, False)):
        asked = replace(
            finger,
            gauge_pressure=pressure * MPa,
            volume_at_pressure=1.25 * finger.volume_at_rest,
            dead_volume=2 * ML,  # as the explorer has them
        )
        assert any(s.feasible for s in sizings(asked, least_margin=LEAST_MARGIN)) == reached
    assert found < finger.gauge_pressure / MPa
    # More time does not help the syringe that has too little air.
    assert not any(sizing(finger.gauge_pressure / MPa, volume, 8.0)["fits"][:6])
