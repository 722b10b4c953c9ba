"""Step tests: their commands, the kept runs, and the mean."""

import shutil

import numpy as np
import pytest

from book.chapter_5.logs import ANGLES, step_plunger
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.logs.repeated_steps import read_step_test
from softgrip.provenance import data_file
from softgrip.simulator import steps
from softgrip.simulator.chance import SEED
from softgrip.simulator.fitted_rigs import design_1, design_3
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, MM

PATHS = [data_file(f"simulated/step-fx-60-{run}.csv").path for run in range(1, 8)]
"""Whose angles stay within the range of the flex sensor."""


@pytest.mark.parametrize("plunger", [0.4 * MM, 1.0 * MM, 3.3 * MM, 25.3 * MM, 60 * MM])
def test_plunger_goes_where_it_should(plunger):
    rig = Simulation(design_1())
    _, truth = rig.open_loop(steps.step_commands(plunger))
    assert truth.plunger[-1, 0] == pytest.approx(plunger, rel=1e-9)
    assert abs(truth.motor_speed).max() <= PumpParameters().speed_limit * (1 + 1e-12)


@pytest.mark.parametrize("design", [design_1, design_3])
def test_travels_of_the_logs_are_those_of_the_median_finger(design):
    for degrees in ANGLES:
        plunger = step_plunger(design, degrees)
        assert steps.travel_to(design(), degrees * DEG) == pytest.approx(plunger, abs=0.05 * MM)
        assert plunger / (0.1 * MM) == pytest.approx(round(plunger / (0.1 * MM)))


def test_simulated_runs_are_those_of_the_logs_without_sensors():
    test = read_step_test(PATHS)
    rig = design_3()
    true = steps.simulate_step_test(rig, step_plunger(design_3, 60), runs=7, seed=SEED)
    np.testing.assert_allclose(true.time, test.time)
    # While the finger moves the sensor lags: it says what was a lag ago.
    lag, late = rig.sensors.angle_lag, slice(20, None)
    shifted = [np.interp(true.time - lag, true.time, run) for run in true.angles]
    off = (test.angles - shifted)[:, late]
    noise = rig.sensors.angle_noise
    # A first-order lag is not quite a delay; and the finger turns by 1 deg in a sample.
    assert abs(off.mean(axis=1)).max() < noise
    assert np.std(off) == pytest.approx(noise, rel=0.4)


def test_mean_is_that_of_the_logs():
    test = read_step_test(PATHS[:2])
    angles = [read_log(path)["angle"] for path in PATHS[:2]]
    np.testing.assert_allclose(test.angle, (angles[0] + angles[1]) / 2)
    assert test.pressures.shape == (2, 240)


def test_logs_of_other_times_are_refused(tmp_path):
    cut = tmp_path / "cut.csv"
    shutil.copy(PATHS[0], cut)
    cut.write_text("".join(cut.read_text().splitlines(keepends=True)[:-5]))
    with pytest.raises(DataFileError, match=f"the times of {PATHS[1]}.*other times"):
        read_step_test([PATHS[1], cut])


def test_travel_must_be_above_zero():
    with pytest.raises(InvalidInputError, match="plunger"):
        steps.step_commands(0.0)
