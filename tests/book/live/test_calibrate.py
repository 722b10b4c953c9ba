"""A calibration from readings of a rig at rest."""

from dataclasses import replace

import numpy as np
import pytest

from book.live.calibrate import FITTED, Readings, fit_calibration, take_readings
from softgrip.board.calibration import nominal
from softgrip.board.errors import CommandRefusedError
from softgrip.errors import InvalidInputError
from softgrip.rig.connect import connect
from softgrip.rig.simulated import simulated_gripper
from softgrip.simulator.parameters import SensorParameters
from softgrip.units import DEG


def truth(rig):
    return lambda: (rig.rig.truth.pressure[0], rig.rig.truth.angle)


@pytest.fixture(scope="module")
def readings():
    with connect("simulated", seed=3) as rig:
        rig.home()
        return take_readings(rig, truth(rig))


def test_readings_rise_at_rest_and_go_beyond_the_flex_sensor(readings):
    assert (np.diff(readings.pressure) > 0).all()
    assert (np.diff(readings.angles[:, 0]) > 0).all()
    assert readings.angles[-1, 0] > SensorParameters().angle_range
    assert readings.angle_counts.shape == readings.angles.shape == (14, 1)


def test_lines_are_those_that_the_simulated_sensors_were_made_with(readings):
    found, sheet = fit_calibration(readings, "this board", "mine.csv"), nominal()
    # The gauge is read at the end of the second that the counts are the mean of: the leak of the
    # air and the creep of the finger are a thousandth of what they moved by then.
    assert found.pressure.gain == pytest.approx(sheet.pressure.gain, rel=0.01)
    assert found.angles[0].gain == pytest.approx(sheet.angles[0].gain, rel=0.02)
    assert (found.board, found.name) == ("this board", "mine.csv")


def test_angles_near_the_end_of_the_flex_sensor_leave_its_line_alone(readings):
    end = FITTED * SensorParameters().angle_range
    beyond = readings.angles >= end
    assert 0 < beyond.sum() < beyond.size - 3
    changed = replace(readings, angle_counts=np.where(beyond, 0.0, readings.angle_counts))
    one, other = (fit_calibration(x, "b", "n").angles for x in (readings, changed))
    assert one == other


def test_every_finger_has_its_line():
    with simulated_gripper(seed=1) as rig:
        rig.home()
        found = take_readings(rig, truth(rig), count=4)
    assert found.angles.shape == (4, 2)
    assert len(fit_calibration(found, "b", "n").angles) == 2


def test_a_plunger_of_which_the_place_is_not_known_is_not_pushed():
    with connect("simulated") as rig, pytest.raises(CommandRefusedError, match="home"):
        take_readings(rig, truth(rig))


def test_too_few_readings_are_refused():
    few = Readings(np.arange(2.0), np.arange(2.0), np.ones((2, 1)), DEG * np.ones((2, 1)))
    with pytest.raises(InvalidInputError, match="three pairs"):
        fit_calibration(few, "b", "n")
