"""Table 3.2's measured column on the simulated rig."""

import pytest

from book.chapter_3.stepped import identified_step, rig_with
from softgrip.actuator.printed import section, table_3_2
from softgrip.actuator.section import Section
from softgrip.errors import InvalidInputError
from softgrip.simulator.calibration import OPERATING_ANGLE, design_1, small_signal_poles


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
    found = identified_step(design_1())
    assert found.natural_frequency.high < 2.86
    assert found.natural_frequency.value == pytest.approx(1.70, abs=0.05)


def test_a_section_that_bends_backwards_is_refused():
    with pytest.raises(InvalidInputError, match="b > t"):
        rig_with(Section(0.02, 0.001, 0.03, 0.0015))
