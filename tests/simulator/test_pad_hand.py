"""The hand does what words say: against the pad pressed by itself, and in its times."""

import numpy as np
import pytest

from softgrip.errors import UnknownNameError
from softgrip.simulator.pad import make_pad, press, to_volts, voltages
from softgrip.simulator.pad_hand import CORNERS, CYCLE, FULL, SCALE, PadHand
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose
from softgrip.units import GRAM_FORCE

PARAMETERS = PadParameters()
HELD = (CORNERS[1] + CORNERS[2]) / 2


@pytest.fixture(autouse=True)
def example_pad(monkeypatch):
    """Press a pad whose parameters hang on no fit, and whose changes repeat within 3 %."""
    monkeypatch.setattr("softgrip.simulator.pad_hand.fitted_pad", PadParameters)


def volts(hand, time):
    """Return the mean voltages of samples about a time, in which the pad's noise is averaged."""
    return np.mean([to_volts(hand.counts(time + k / 1e3), PARAMETERS) for k in range(100)], axis=0)


def test_nothing_is_pressed_at_rest_nor_before_and_after_a_press():
    hand, rest = PadHand(), voltages(make_pad(PARAMETERS, 2024), np.zeros(8))
    for words, time in (("rest", 0.0), ("press: element 3", 5.05), ("press: element 3", 7.35)):
        hand.obey(words, 5.0)
        # A step of the converter, 4.9 mV, rounded either way.
        np.testing.assert_allclose(volts(hand, time), rest, atol=4e-3)


def test_weight_is_the_force_of_the_layer_and_an_element_is_pressed_alone():
    hand, pad = PadHand(), make_pad(PARAMETERS, 2024)
    hand.obey("weight: 20 gf", 0.0)
    force = 20 * GRAM_FORCE
    expected = voltages(pad, press(pad, SCALE, Pose((0.0, 0.0)), force))
    assert volts(hand, HELD)[8] == pytest.approx(expected[8], abs=4e-3)
    hand.obey("press: element 3", 10.0)
    change = volts(hand, 10.0 + HELD) - voltages(pad, np.zeros(8))
    assert (abs(np.delete(change[:8], 2)) < 4e-3).all()
    full = voltages(pad, FULL * np.eye(8)[2]) - voltages(pad, np.zeros(8))
    # Repeatability is 3 % of the change: four deviations.
    assert change[2] == pytest.approx(full[2], rel=0.12)


def test_contact_is_laid_anew_at_each_press():
    hand = PadHand()
    hand.obey("contact: egg", 0.0)
    for time in np.arange(0, 2.99 * CYCLE, 0.1):
        hand.counts(time)
    poses = {one.pose for one in hand.presses}
    assert (len(hand.presses), len(poses)) == (3, 3)
    assert {one.item.name for one in hand.presses} == {"egg"}


def test_same_seed_same_hand():
    def counts(seed):
        hand = PadHand(seed=seed)
        hand.obey("line: hot dog", 0.0)
        return hand.counts(HELD).tolist()

    assert counts(1) == counts(1) != counts(2)


def test_object_that_is_none_is_refused_when_it_is_said():
    with pytest.raises(UnknownNameError, match="cherry tomato"):
        PadHand().obey("point: moon", 0.0)
