"""Sensor lines of a board."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from softgrip.board.calibration import BoardCalibration, fit_sensor, load, nominal, save
from softgrip.board.errors import WrongBoardError
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.sensors import from_counts
from softgrip.units import DEG

COUNTS = np.array([102, 300, 500, 700, 920])


def test_the_fit_is_that_of_another_library():
    known = np.array([0.0, 133e3, 268e3, 402e3, 551e3])
    line = fit_sensor(COUNTS, known)
    other = Polynomial.fit(COUNTS, known, 1).convert()
    assert (line.offset, line.gain) == pytest.approx(tuple(other.coef))
    rest = known - other(COUNTS)
    assert line.residual == pytest.approx(np.sqrt(rest @ rest / 3))
    assert (line.low_count, line.high_count) == (102, 920)


def test_residual_is_the_noise_of_the_sensor():
    rng = np.random.default_rng(1)
    counts = np.tile(COUNTS, 400)
    line = fit_sensor(counts, 1e-3 * counts + 2 * DEG * rng.standard_normal(counts.size))
    # The relative deviation of a root mean square over 2000 samples is 1.6 %.
    assert line.residual == pytest.approx(2 * DEG, rel=0.06)


@given(gain=st.floats(1e-3, 1e4), offset=st.floats(-1e5, 1e5), count=st.integers(0, 1023))
def test_a_line_without_noise_is_found(gain, offset, count):
    line = fit_sensor(COUNTS, offset + gain * COUNTS)
    assert line.value(count) == pytest.approx(offset + gain * count, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    ("counts", "known"),
    [
        ([1, 2], [1, 2]),
        ([5, 5, 5], [1, 2, 3]),
        ([1, 2, 3], [1, 2]),
        ([1, 2, np.nan], [1, 2, 3]),
        ([1, 2, 3], [1, np.inf, 3]),
    ],
)
def test_pairs_that_fix_no_line_are_refused(counts, known):
    with pytest.raises(InvalidInputError, match="three pairs"):
        fit_sensor(counts, known)


def test_nominal_lines_are_those_of_the_simulated_converter():
    lines, sensors = nominal(2), SensorParameters()
    assert len(lines.angles) == 2
    assert lines.pressure.value(COUNTS) == pytest.approx(
        from_counts(COUNTS, sensors.pressure_range, sensors)
    )
    assert lines.angles[1].value(COUNTS) == pytest.approx(
        from_counts(COUNTS, sensors.angle_range, sensors)
    )


@pytest.fixture
def measured():
    pressure = fit_sensor(COUNTS, 700.1 * COUNTS - 7e4)
    angles = tuple(fit_sensor(COUNTS, slope * COUNTS) for slope in (1 / 3, 2 / 7))
    return BoardCalibration("7573530", pressure, angles, "lines.csv")


def test_what_is_saved_is_loaded_exactly(measured, tmp_path):
    path = tmp_path / "lines.csv"
    save(measured, path, "a manometer and a protractor")
    assert load(path) == measured
    assert path.read_text().startswith("# provenance: logged\n# source: a manometer")
    with pytest.raises(FileExistsError):
        save(measured, path, "again")


def test_another_board_is_refused(measured):
    assert measured.for_board("7573530", "COM3") is measured
    with pytest.raises(WrongBoardError, match=r"COM3.*7573530.*this one is 1"):
        measured.for_board("1", "COM3")
    assert replace(measured, board="any").for_board("1", "COM3").angles == measured.angles


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("# board: 7573530\n", ""),
        ("# provenance: logged\n", ""),
        ("sensor,gain", "sensor,slope"),
        ("pressure [Pa]", "pressure [psi]"),
        ("angle_2", "angle_3"),
        (",102.0,920.0", ",102.0"),
        (",102.0,920.0", ",low,920.0"),
    ],
)
def test_a_damaged_file_is_refused(measured, tmp_path, old, new):
    path = tmp_path / "lines.csv"
    save(measured, path, "a manometer")
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    with pytest.raises(DataFileError, match=r"lines\.csv"):
        load(path)
