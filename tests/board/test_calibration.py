"""Sensor lines of a board."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from softgrip.board.calibration import (
    BoardCalibration,
    DividerCurve,
    SensorLine,
    fit_sensor,
    load,
    nominal,
    save,
)
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


FLEX = np.linspace(0, 90, 10) * DEG


def divided(value, *, flat=24e3, slope=22.9e3, fixed=10e3, top=1023, at_ground=True):
    """Return the counts of a sensor of ``flat + slope value`` ohm in a divider, by Ohm's law."""
    sensor = flat + slope * value
    return top * (fixed if at_ground else sensor) / (fixed + sensor)


@given(
    flat=st.floats(5e3, 60e3),
    slope=st.floats(5e3, 60e3),
    fixed=st.floats(5e3, 100e3),
    at_ground=st.booleans(),
    top=st.sampled_from([1023, 4095, 16383]),
)
def test_a_divider_is_found_or_so_straight_that_a_line_does(flat, slope, fixed, at_ground, top):
    counts = divided(FLEX, flat=flat, slope=slope, fixed=fixed, top=top, at_ground=at_ground)
    curve = fit_sensor(counts, FLEX, top=top)
    off = np.abs(curve.value(counts) - FLEX).max()
    assert off < (1e-6 if isinstance(curve, DividerCurve) else 0.02 * np.ptp(FLEX))
    asked = fit_sensor(counts, FLEX, curve="divider", top=top)
    assert asked.value(counts) == pytest.approx(FLEX, abs=1e-6)
    assert asked.pole == (0.0 if at_ground else top)


@pytest.mark.parametrize("at_ground", [True, False])
def test_a_line_is_refused_for_a_divider(at_ground):
    counts = np.round(divided(FLEX, at_ground=at_ground))
    curve = fit_sensor(counts, FLEX)
    # A count is 0.2 to 0.9 deg over this range.
    assert np.abs(curve.value(counts) - FLEX).max() < 1 * DEG
    with pytest.raises(InvalidInputError, match=r"on a line.*a bend of \d+\.\d% of the range off"):
        fit_sensor(counts, FLEX, curve="line")


def test_what_neither_curve_fits_is_refused():
    with pytest.raises(InvalidInputError, match=r"off a line, .* off a divider"):
        fit_sensor(COUNTS, np.sqrt(COUNTS - 100.0))


@pytest.mark.parametrize("noise", [0.5, 2.0, 5.0])
@pytest.mark.parametrize("seed", range(3))
def test_noise_alone_does_not_bend_a_line(noise, seed):
    share = noise / 100 * np.random.default_rng(seed).normal(size=9)
    known = 100 * DEG * (np.linspace(0, 1, 9) + share)
    assert isinstance(fit_sensor(np.linspace(102, 920, 9), known, curve="line"), SensorLine)


@pytest.mark.parametrize("rail", ["both", "low", "high"])
def test_readings_at_the_rails_are_left_out(rail):
    counts = np.linspace(-300, 1300, 17)
    known = 1e-3 * counts
    if rail == "low":
        counts, known = counts[counts < 1000], known[counts < 1000]
    elif rail == "high":
        counts, known = counts[counts > 20], known[counts > 20]
    line = fit_sensor(np.clip(counts, 0, 1023), known)
    assert (line.gain, line.offset) == pytest.approx((1e-3, 0.0), abs=1e-12)
    assert 0 < line.low_count < line.high_count < 1023


def test_counts_that_are_not_of_the_converter_are_refused():
    with pytest.raises(InvalidInputError, match="top=4095 for one of 12 bits"):
        fit_sensor([100, 2000, 4000], [0.0, 1.0, 2.0])
    assert fit_sensor([100, 2000, 4000], [0.0, 1.9, 3.9], top=4095).gain == pytest.approx(1e-3)
    with pytest.raises(InvalidInputError, match="0 to 1023"):
        fit_sensor([-5, 2, 4], [0.0, 1.0, 2.0])
    with pytest.raises(InvalidInputError, match="'divider'"):
        fit_sensor(COUNTS, COUNTS, curve="parabola")


def test_all_at_the_rails_is_refused_with_the_ends():
    with pytest.raises(InvalidInputError, match="between the ends of the converter, 0 and 1023"):
        fit_sensor([0, 0, 500, 600, 1023], [0.0, 0.1, 0.5, 0.6, 1.0])


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


def test_a_divider_is_saved_with_its_pole(measured, tmp_path):
    bent = replace(measured, angles=(measured.angles[0], fit_sensor(divided(FLEX), FLEX)))
    path = tmp_path / "lines.csv"
    save(bent, path, "a manometer and a protractor")
    assert load(path) == bent
    text = path.read_text()
    for old, new in ((",0.0\n", ",\n"), (",0.0\n", ",low\n"), ("pole", "post")):
        path.write_text(text.replace(old, new, 1))
        if new == ",\n":  # without its pole the row reads as a line
            assert isinstance(load(path).angles[1], SensorLine)
            continue
        with pytest.raises(DataFileError, match=r"lines\.csv"):
            load(path)
    save(replace(bent, pressure=bent.angles[1]), tmp_path / "other.csv", "no pressure sensor")
    with pytest.raises(DataFileError, match="a line for the pressure sensor"):
        load(tmp_path / "other.csv")


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
