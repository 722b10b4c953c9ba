"""From forces to counts: hand calculations and the printed ranges."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.simulator import pad_range
from softgrip.simulator.pad import convert, ideal_responses, make_pad, to_volts, voltages
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import angle_between, line_angle, place
from softgrip.tactile.element import compliance
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.units import DEG, MM

IDEAL = PadParameters()


def test_ideal_pad_goes_from_2_5_to_3_5_volts():
    """By hand: 0.5 V (1 + 1 MOhm / 0.25 MOhm), and with 1.5 MOhm."""
    pad = make_pad(IDEAL)
    np.testing.assert_allclose(voltages(pad, np.zeros(8))[:8], 2.5)
    np.testing.assert_allclose(voltages(pad, np.full(8, 0.5))[:8], 3.5)


def test_half_of_the_largest_shortening_by_hand():
    # 0.09 N by 5.556 mm/N shorten 3 mm by a sixth: 1.2 MOhm, 2.9 V.
    assert compliance(IDEAL.element, IDEAL.young_modulus) == pytest.approx(1 / 180)
    assert voltages(make_pad(IDEAL), np.full(8, 0.09))[0] == pytest.approx(2.9)


def test_force_layer_gives_4_volts_at_its_range():
    """By hand at 0.7 N: x = 3.5, 2.5 * 5 V * 3.5 / 11."""
    found = voltages(make_pad(IDEAL), np.full(8, 0.7 / 8))[8]
    assert found == pytest.approx(2.5 * 5 * 3.5 / 11)


def test_drift_is_linear_in_time_and_that_of_the_pad():
    pad = make_pad(IDEAL, seed=1)
    now, one, two = (voltages(pad, np.zeros(8), 3600 * hour)[:8] for hour in (0, 1, 2))
    np.testing.assert_allclose(two - one, one - now, rtol=1e-9)
    assert not np.allclose(one, now, atol=1e-6)


def test_pad_is_its_seed_and_its_elements_differ():
    one, same, other = (make_pad(IDEAL, seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one.at_rest, same.at_rest)
    assert not np.allclose(one.at_rest, other.at_rest)
    assert np.unique(one.gain).size == 8


def test_converter_rounds_to_half_a_step_and_cuts():
    volts = np.linspace(0, 4.99, 500)
    back = to_volts(convert(volts, IDEAL), IDEAL)
    assert np.abs(back - volts).max() <= 5 / 1024 / 2 + 1e-12
    assert convert(np.array([-1.0, 9.0]), IDEAL).tolist() == [0, 1023]


def test_printed_range_of_an_element_and_least_force_are_met():
    """Section 2.2: 0.1 to 0.2 N are the end of an element's range; 0.01 N are felt."""
    assert 0.1 <= pad_range.ceiling_force(IDEAL) <= 0.2
    # A third of the height, 1 mm, by 180 N/m.
    assert pad_range.ceiling_force(IDEAL) == pytest.approx(0.18, rel=1e-6)
    assert pad_range.least_force(IDEAL) < 0.01


@pytest.mark.parametrize("name", ["cover", "noise", "gain_resistor", "tilt"])
def test_parameters_that_cannot_be_are_refused(name):
    with pytest.raises(InvalidInputError, match=name):
        replace(IDEAL, **{name: -1 * MM})


@pytest.mark.parametrize("k", range(8))
def test_ball_on_an_element_is_found_there(k):
    felt = ideal_responses("ball 20 mm", Pose(tuple(PAD.places[k])), 0.1)
    np.testing.assert_allclose(place(felt, PAD), PAD.places[k], atol=1e-9)


@pytest.mark.parametrize(("x", "y", "degrees"), [(0, 10, 0), (0, 0, 0), (0, -10, 0), (0, 0, 90)])
def test_rod_over_a_row_or_the_middle_is_found_with_its_angle(x, y, degrees):
    felt = ideal_responses("rod 20 mm", Pose((x * MM, y * MM), degrees * DEG), 0.2)
    assert angle_between(line_angle(felt, PAD), degrees * DEG) < 0.1 * DEG
