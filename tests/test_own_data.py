"""What people of the field bring: step tests, sensors and pads, with the right values known."""

import csv

import numpy as np
import pytest

from softgrip.board.calibration import DividerCurve, fit_sensor
from softgrip.control.ziegler_nichols import reaction_curve, ziegler_nichols
from softgrip.dynamics.identify import identify
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels, Prior
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.kind_evaluation import accuracy, cross_validated
from softgrip.tactile.own_pad import read_readings
from tests.conftest import CASES

pytestmark = pytest.mark.skipif(not CASES.is_dir(), reason="needs the inputs: SOFTGRIP_CASES_DIR")


def columns(name):
    with (CASES / name).open(newline="") as stream:
        return np.array([[float(cell) for cell in row] for row in [*csv.reader(stream)][1:]]).T


def test_noisy_reaction_curve():
    curve = reaction_curve(*columns("reaction-noisy.csv"))
    # Noise of 0.5 % makes the delay uncertain by 2 %.
    assert curve.delay == pytest.approx(0.5, rel=0.03)
    assert curve.delay_interval[0] < 0.5 < curve.delay_interval[1]
    assert curve.slope == pytest.approx(2 / 3, rel=0.01)
    assert ziegler_nichols(curve).kp == pytest.approx(3.6, rel=0.03)


def test_step_with_a_dead_time():
    found = identify(*columns("step-dead-time.csv"), hold="zero")
    for estimate_of, true in (
        (found.natural_frequency, 2.86),
        (found.damping_ratio, 0.70),
        (found.dead_time, 0.1),
    ):
        assert estimate_of.low < true < estimate_of.high
        assert estimate_of.value == pytest.approx(true, rel=0.05)


def test_flex_sensor_in_a_divider():
    counts, angle = columns("flex-divider.csv")
    curve = fit_sensor(counts, angle)
    assert isinstance(curve, DividerCurve)
    # Counts are given to 0.1, which is 0.06 deg at the flat end.
    assert np.abs(curve.value(counts) - angle).max() < 0.1
    with pytest.raises(InvalidInputError, match="off a line"):
        fit_sensor(counts, angle, curve="line")


@pytest.mark.parametrize("missing", [[], [30], [0, 1, 80, 163]])
def test_capacity_over_lost_rows(missing):
    time, pressure, flow = columns("capacity-rows-lost.csv")
    pressure[missing] = np.nan
    noise = NoiseLevels(pressure_step=40.0, elastance_step=1e5, sensor=150.0)
    model = ElastanceModel(0.025, noise, Prior(0.0, 200.0, 1e9, 3e8))
    found = estimate(pressure, flow, 0 * flow, model, time=time)
    assert found.capacity[-1] == pytest.approx(1.20e-9, rel=0.02)


def test_time_column_is_no_channel_and_noise_is_chance():
    file = CASES / "pad-time-column.csv"
    with pytest.raises(DataFileError, match="time: its name is that of a clock"):
        read_readings(file, label="kind")
    elements = ["e1", "e2", "e3", "e4"]
    found = read_readings(file, label="kind", channels=elements)
    right = accuracy(cross_validated(nearest_neighbours(), found.voltages, found.labels, seed=0))
    low, high = right.interval()
    assert low < 0.46 < high
