"""What recomputes the numbers of Chapter 6, and what the notes of its claims say of it."""

import numpy as np
import pytest

from book.chapter_6.filters import crossover_of_peaks
from book.chapter_6.numbers import FINE, tracking_error_on_rig, transient_difference_on_rig
from book.companion.claims import claim_of, printed
from softgrip.control.step_metrics import settling_time
from softgrip.gripper.printed_loop import FILTERS, equal_targets, run_printed


def test_second_finger_settles_alone_when_the_note_says():
    # "At 5 % SPA 2 alone takes 0.56 s", to two decimals; both take as long as the slower one.
    found = run_printed(period=FINE, angle=0.333 * np.pi, duration=4.0)
    final = equal_targets(0.333 * np.pi)
    first, second = settling_time(found.time, found.angles, final=final, band=0.05)
    assert second == pytest.approx(0.56, abs=0.005)
    assert first > second


def test_another_weight_makes_the_printed_target_loop_the_one_of_the_filter():
    """So the rule, which the text does not name, decides which target loop a filter has."""
    fast, slow = (crossover_of_peaks(*FILTERS[name], asymptote=0.2) for name in ("4.8/s", "2/s"))
    assert f"{fast:.1f}/s, and those of the other for {slow:.2f}/s" in (
        claim_of(6, "6.4-target-loop-4-8-s").note
    )


def test_the_slower_filter_leaves_less_on_the_simulated_rig():
    """As the notes of both numbers say, which are printed of the faster one."""
    for measure in (tracking_error_on_rig, transient_difference_on_rig):
        assert measure(controller="2/s") < measure(controller="4.8/s")
    assert tracking_error_on_rig(controller="2/s") < printed("6.4-measured-tracking-error")
