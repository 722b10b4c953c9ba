"""Table 3.2's measured column on the simulated rig."""

import pytest

from book.chapter_3.stepped import identified_row, rig_with, small_motions
from softgrip.actuator.printed import section, table_3_2
from softgrip.actuator.section import Section
from softgrip.errors import InvalidInputError
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.small_signal import OPERATING_ANGLE, small_signal_poles


def test_the_printed_optimum_is_design_1():
    found, known = rig_with(section("Opt. parameters")).finger, design_1().finger
    for name, value in vars(known).items():
        assert getattr(found, name) == pytest.approx(value), name


def test_a_lower_section_is_slower():
    """By hand: I_n goes with h**4.5, the rubber with its area, so 18.4 mm is at 0.57 of 24 mm."""
    low = rig_with(table_3_2()[3].section).finger
    ratio = (18.4 / 24) ** 2.25 * (220.5 / 203.7) ** 0.5
    frequencies = [abs(small_signal_poles(f, OPERATING_ANGLE)[0]) for f in (low, design_1().finger)]
    # The memory makes the pole depend on the frequency itself a little.
    assert frequencies[0] / frequencies[1] == pytest.approx(ratio, rel=0.02)


def test_steps_tell_less_than_small_motions():
    assert identified_row(1).natural_frequency.high < 0.9 * small_motions()


def test_the_rig_is_fitted_to_the_measured_frequencies():
    # A tenth, and the third row's spread: what the fit to all prints together leaves.
    for k, row in enumerate(table_3_2(), start=1):
        assert identified_row(k).natural_frequency.value == pytest.approx(row.measured, rel=0.15)


def test_frequency_falls_with_the_section_at_first_less_than_measured_and_then_further():
    rows = table_3_2()
    simulated = [identified_row(k).natural_frequency.value for k in range(1, 5)]
    assert simulated == sorted(simulated, reverse=True)
    own = [value / simulated[0] for value in simulated]
    printed = [row.measured / rows[0].measured for row in rows]
    assert own[1] > printed[1]
    assert own[2] < printed[2]
    assert own[3] < printed[3]


def test_a_section_that_bends_backwards_is_refused():
    with pytest.raises(InvalidInputError, match="b > t"):
        rig_with(Section(0.02, 0.001, 0.03, 0.0015))
