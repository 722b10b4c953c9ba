"""Converter and sensors."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.simulator.chance import Chance, streams
from softgrip.simulator.parameters import SensorParameters, Spread
from softgrip.simulator.sensors import from_counts, measure, to_counts
from softgrip.units import DEG, PSI

SENSORS = SensorParameters()


@given(value=st.floats(0.0, 1.0))
def test_quantisation_is_off_by_half_a_count_at_most(value):
    back = from_counts(to_counts(np.array([value]), 1.0, SENSORS), 1.0, SENSORS)
    assert abs(back[0] - value) <= 0.5 / (920.7 - 102.3) * (1 + 1e-9)


def test_all_counts_come_back_and_none_is_beyond_the_scale():
    counts = np.arange(1024)
    np.testing.assert_array_equal(
        to_counts(from_counts(counts, 2.0, SENSORS), 2.0, SENSORS), counts
    )
    assert to_counts(np.array([-9.0, 9.0]), 1.0, SENSORS).tolist() == [0, 1023]


def test_sensor_stops_at_the_end_of_its_range():
    quiet = np.zeros((2, 1))
    found = measure(0.0, np.array([200 * PSI]), np.array([[206 * DEG]]), quiet, SENSORS)
    assert found.angle[0, 0] / DEG == pytest.approx(100, abs=0.1)
    assert found.pressure[0] / PSI == pytest.approx(80, abs=0.1)


@pytest.mark.parametrize("fingers", [1, 3])
def test_noise_of_a_run_is_a_plain_sequence_of_its_stream(fingers):
    chance = Chance(Spread(), fingers=fingers, seed=4, first=2, runs=3)
    drawn = np.array([chance.noise().copy() for _ in range(150)])
    plain = streams(4, 3)[1].standard_normal((150, 1 + fingers))
    np.testing.assert_array_equal(drawn[:, :, 1], plain)


def test_no_spread_leaves_the_parameters():
    chance = Chance(Spread(), fingers=2, seed=1, first=0, runs=5)
    assert (chance.stiffness == 1).all()
    assert (chance.leakage == 1).all()


@pytest.mark.parametrize("settings", [{"bits": 8}, {"angle_lag": 0.0}, {"low_count": 950.0}])
def test_bad_sensors_are_refused(settings):
    with pytest.raises(InvalidInputError):
        SensorParameters(**settings)
