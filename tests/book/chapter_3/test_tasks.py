"""The answers of Chapter 3's tasks and questions, found another way, within the sliders' reach."""

from math import exp, sqrt

import numpy as np
import pytest
from scipy.integrate import quad

from book.chapter_3 import tasks
from book.chapter_3.regulators import designed_on
from book.chapter_4.identified_model import identified_model
from book.companion.claims import printed
from softgrip.actuator.design import (
    SCRIPT_POWER,
    DesignProblem,
    FrequencyBand,
    InfeasibleDesignError,
)
from softgrip.actuator.optimize import optimal_design
from softgrip.control.limited_lqr import limited_loop
from softgrip.control.lqr import FINGER, Weights, linear_settling_time, lqr_gain
from softgrip.control.step_metrics import settling_time
from softgrip.units import DEG, MM, MPa
from tests.book.explore.page_laws import page_laws


def torque_by_integrals(top, bottom, wall, width=30.0, pressure=0.15 * MPa):
    """Integrate Eq. (3.5) and (3.6) over the height, N m; dimensions in mm."""
    a, b, t, w = (x * MM for x in (top, bottom, wall, width))
    inner = w - 2 * t

    def moment(low, high, breadth):
        return breadth * quad(lambda y: y, low, high)[0]

    chamber, chamber_area = moment(0, a - t, inner), inner * (a - t)
    parts = ((-b, 0, w), (0, a - t, 2 * t), (a - t, a, w))
    walls, wall_area = (sum(moment(*part) for part in parts), w * (a + b) - chamber_area)
    return pressure * (chamber - chamber_area / wall_area * walls)


SECTIONS = [(20, 4, 1.5), (21, 4, 1.5), (20, 5, 1.5), (19, 5, 1.5), (20, 2, 2)]


@pytest.mark.parametrize("section", SECTIONS)
def test_torque_in_the_title_is_that_of_the_integrals(section):
    found = tasks.torque_of(**dict(zip(("top", "bottom", "wall"), section, strict=True)))
    # By parts of a newton millimetre: the last section has none.
    assert found == pytest.approx(torque_by_integrals(*section), abs=1e-9)
    ranges = page_laws()["finger"].ranges
    for name, value in zip(("top", "bottom", "wall"), section, strict=True):
        assert ranges[name].low <= value <= ranges[name].high


def test_only_one_place_of_the_sliders_has_no_torque():
    ranges = page_laws()["finger"].ranges
    assert ranges["bottom"].low == ranges["wall"].high == tasks.LEAST_BOTTOM
    assert tasks.torque_of(bottom=tasks.LEAST_BOTTOM, wall=tasks.LEAST_BOTTOM) == 0


def test_sliders_start_at_the_section_of_the_task():
    ranges = page_laws()["finger"].ranges
    for name, start in (("top", tasks.TOP), ("bottom", tasks.BOTTOM), ("wall", tasks.WALL)):
        assert ranges[name].start == start
    assert printed("table-3.1-optimum-top") == tasks.TOP
    assert printed("table-3.1-optimum-bottom") == tasks.BOTTOM


def test_giving_height_to_the_bottom_leaves_the_frequency():
    # Its square goes with the width and a power of the height alone, Eq. (3.19).
    for bottom in (3.0, 5.0, 6.0):
        top = tasks.TOP + tasks.BOTTOM - bottom
        assert tasks.frequency_of(top=top, bottom=bottom) == pytest.approx(tasks.frequency_of())
        taller = tasks.frequency_of(bottom=tasks.BOTTOM + 1) / tasks.frequency_of()
    assert taller == pytest.approx((25 / 24) ** ((SCRIPT_POWER + 2) / 2))


def test_weight_by_the_pole_is_that_of_a_loop_with_huge_p():
    found = tasks.weight_by_the_pole()
    assert exp(-0.8 / sqrt(found)) == pytest.approx(0.05)
    seconds = linear_settling_time(FINGER, Weights(p=1e8, q=(1.0, found, 0.0)), 0.05)
    # The pair of poles lies at the fourth root of p q_2, some 50 rad/s, and delays by that much.
    assert 0 < seconds - 0.8 < 2 / (1e8 * found) ** 0.25


def judged(rate, step):
    """Return the settling time of the loop as the chapter computes it, s."""
    model = identified_model()
    finger, _ = designed_on("printed", model)
    gain = lqr_gain(finger, Weights(p=tasks.LARGEST_P, q=(1.0, rate, 0.0)))
    found = limited_loop(finger, model.pump_gain, gain, step * DEG, duration=4.0)
    return float(settling_time(found.time, found.measured, final=step * DEG, band=0.05))


def test_weight_on_the_explorer_is_the_largest_that_is_fast_enough():
    found = tasks.weight_on_the_explorer()
    assert found < tasks.weight_by_the_pole()
    assert judged(0.98 * found, tasks.LEAST_STEP) < 0.8 < judged(1.02 * found, tasks.LEAST_STEP)
    for rate in np.geomspace(1.1 * found, tasks.LARGEST_RATE, 8):
        assert judged(rate, tasks.LEAST_STEP) > 0.8


def test_no_weight_is_fast_enough_at_the_step_where_the_slider_starts():
    times = {q: judged(q, tasks.FIRST_STEP) for q in np.geomspace(0.01, 0.3, 13)}
    assert min(times.values()) > 0.8
    # The smallest weight is the best, and a finer grid finds none that is better by a hundredth.
    assert min(times, key=times.get) == pytest.approx(0.01)
    assert tasks.least_time_on_the_explorer() == pytest.approx(min(times.values()), rel=0.01)


def test_ends_of_the_sliders_are_those_of_the_page():
    ranges = page_laws()["lqr"].ranges
    assert ranges["p"].high == tasks.LARGEST_P
    assert (ranges["q2"].low, ranges["q2"].high) == (tasks.LEAST_RATE, tasks.LARGEST_RATE)
    assert (ranges["step"].low, ranges["step"].start) == (tasks.LEAST_STEP, tasks.FIRST_STEP)


def best_section(modulus, low, pressure):
    band = FrequencyBand(low, low + 0.4)
    return optimal_design(
        DesignProblem(
            pressure=pressure * MPa,
            young_modulus=modulus * MPa,
            fractional_power=SCRIPT_POWER,
            band=band,
        )
    )


def test_the_softest_rubber_has_no_section_for_the_highest_band():
    with pytest.raises(InfeasibleDesignError):
        best_section(0.26, 2.8, 0.15)


def test_pressure_leaves_the_section_and_a_stiffer_rubber_makes_it_lower():
    def height(*asked):
        return best_section(*asked).section.height

    assert height(0.34, 2.0, 0.1) == pytest.approx(height(0.34, 2.0, 0.2), rel=1e-3)
    assert height(0.26, 2.0, 0.15) > height(0.34, 2.0, 0.15) > height(0.59, 2.0, 0.15)
    soft, stiff = best_section(0.26, 2.0, 0.15), best_section(0.59, 2.0, 0.15)
    assert soft.torque > stiff.torque
