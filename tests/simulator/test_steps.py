"""Step tests: their commands, the kept runs, and the mean."""

import shutil

import numpy as np
import pytest

from book.chapter_5.logs import STEP_PLUNGER, STEP_PLUNGER_FX
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.logs.repeated_steps import read_step_test
from softgrip.provenance import data_file
from softgrip.simulator import steps
from softgrip.simulator.calibration import design_1, design_3
from softgrip.simulator.chance import SEED
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, MM

PATHS = [data_file(f"simulated/step-fx-90-{run}.csv").path for run in range(1, 8)]


@pytest.mark.parametrize("plunger", [0.4 * MM, 1.0 * MM, 3.3 * MM, 25.3 * MM, 60 * MM])
def test_plunger_goes_where_it_should(plunger):
    rig = Simulation(design_1())
    _, truth = rig.open_loop(steps.step_commands(plunger))
    assert truth.plunger[-1, 0] == pytest.approx(plunger, rel=1e-9)
    assert abs(truth.motor_speed).max() <= PumpParameters().speed_limit * (1 + 1e-12)


@pytest.mark.parametrize(
    ("design", "kept"), [(design_1, STEP_PLUNGER), (design_3, STEP_PLUNGER_FX)]
)
def test_kept_travels_are_those_of_the_median_finger(design, kept):
    for degrees, plunger in kept.items():
        assert steps.travel_to(design(), degrees * DEG) == pytest.approx(plunger, abs=0.05 * MM)


def test_simulated_runs_are_those_of_the_logs_without_sensors():
    test = read_step_test(PATHS)
    true = steps.simulate_step_test(design_3(), STEP_PLUNGER_FX[90], runs=7, seed=SEED)
    np.testing.assert_allclose(true.time, test.time)
    # Noise of 2 deg over 240 samples; the sensor lags by 0.04 s while the finger moves.
    off = (test.angles - true.angles)[:, -100:].mean(axis=1)
    assert abs(off).max() < 5 * 2 * DEG / 10
    assert np.std(test.angles - true.angles) == pytest.approx(2 * DEG, rel=0.2)


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
