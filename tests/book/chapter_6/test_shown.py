"""Words of Chapter 6's page and captions hold for what its figures and tables show."""

import numpy as np
import pytest

from book.chapter_6 import figures_model, figures_study, filters, shown
from book.chapter_6.comparison import judged
from book.chapter_6.numbers import spread_at_rest
from book.chapter_6.results import logs_of
from book.companion.claims import printed
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FILTERS, run_printed
from softgrip.logs.fingers import run_deviation
from softgrip.units import DEG, REV


def test_both_fingers_lie_below_the_frequencies_that_are_asked_for():
    assert all(f.natural_frequency < printed("6.3-frequency-spa1") for f in PRINTED.fingers)


def test_settling_time_jumps_over_the_printed_one():
    """The narrower band ends below the peak of SPA 1, the wider one above it."""
    (narrow, late), (wide, early) = shown.settles_about(0), shown.settles_about(1)
    assert early < printed("6.4-simulated-settling") < late
    assert wide - narrow == pytest.approx(0.001)
    assert late > early + 0.3


def test_motor_is_exceeded_by_one_filter_and_not_by_the_other():
    in_either_unit = (SPEED_LIMIT, SPEED_LIMIT / REV)
    assert all(shown.peak("4.8/s", np.pi / 3) > limit for limit in in_either_unit)
    assert all(shown.peak("2/s", np.pi / 3) < limit for limit in in_either_unit)


def test_filters_by_the_rule_are_within_what_the_page_says():
    """By their gains, which the coefficients make."""
    for name, c in filters.CROSSOVER.items():
        ours = filters.designed(name, c, filters.author_plant()).complementary(2j)
        top, low = FILTERS[name]
        assert abs(ours) == pytest.approx(abs(np.polyval(top, 2j) / np.polyval(low, 2j)), rel=1e-3)
    assert 0 < shown.largest_deviation() < 0.1


def test_pump_moves_by_the_sum_of_the_commands():
    free = run_printed(duration=8.0)
    assert shown.travel() == pytest.approx(free.commands.sum() * PERIOD, rel=1e-3)


def test_first_finger_returns_after_it_has_passed_its_target():
    assert 0 < shown.passes_target() < shown.back_within(1 * DEG)
    assert shown.back_within(2 * DEG) < shown.back_within(1 * DEG)


def test_push_moves_the_fingers_apart():
    left, right = shown.moved_by_push()
    assert right < 0 < left < figures_model.PUSH


@pytest.mark.parametrize(("method", "delay"), [("bilinear", 1), ("bilinear", 2), ("zoh", 0)])
def test_margin_changes_its_sign_where_it_is_said(method, delay):
    at = shown.unstable_from(method, delay)
    margins, periods = figures_model.margins(method, delay), figures_model.PERIODS
    assert (margins[periods > at] < 0).all()
    assert margins[periods < at][-1] > 0


def test_bilinear_rule_without_delay_is_stable_at_every_period():
    assert (figures_model.margins("bilinear", 0) > 0).all()


@pytest.mark.parametrize("kind", ["open", "low-speed"])
def test_deviations_lie_above_one_from_the_said_frequency_on(kind):
    frequency, found = run_deviation(logs_of(kind), 0)
    start = shown.above_one_from(kind)
    assert (found[frequency >= start] > 1).all()
    assert found[frequency < start][-1] <= 1


def test_slow_steps_deviate_from_lower_frequencies_on_but_spread_no_more():
    assert shown.above_one_from("low-speed") < shown.above_one_from("open")
    assert spread_at_rest(0.1) < 1.1 * spread_at_rest(5.0)  # as much as chance gives with 200 runs


def test_regulator_on_the_mean_settles_earlier_than_the_scheme():
    for scheme in ("2/s", "4.8/s"):
        medians = [
            np.median(judged(name).settling["2 deg"]) for name in ("LQR on the mean", scheme)
        ]
        assert medians[0] < medians[1]


def test_most_pairs_of_the_fast_loop_do_not_settle():
    assert figures_study.settling_times("4.8/s").size < figures_study.PAIRS / 2


def test_least_times_are_later_than_the_printed_one():
    times = shown.least_times()
    assert times == sorted(times, reverse=True)
    assert times[-1] > printed("6.4-settling-fast")


def test_loop_lies_above_the_curves_of_least_difference():
    loop = figures_study.outcome("2/s", pairs=1)
    assert loop.synchronization[0] > shown.least_differences()[1]
    assert loop.settling[0].max() > shown.LOOKED_AT


def test_out_of_reach_falls_for_equal_angles_and_rises_for_the_projection():
    low, high = (shown.outside("equal angles", end) for end in (0, 1))
    assert low / 50 > high
    low, high = (shown.outside("proj(Y_d)", end) for end in (0, 1))
    assert high / 50 > low
    # On the way as much is missed as at the end of the axis, and hardly more.
    assert high <= shown.missed_on_the_way() < 1.1 * high


def test_every_drive_pushes_the_disc_aside_and_lets_it_come_back():
    most, end = shown.pushed_aside()
    assert (end > 0.5).all()
    assert (end < most).all()
    assert shown.first_touch("fast push") < shown.first_touch("scheme, 2/s")
