"""The author's force readings: that they are read whole, or refused."""

import numpy as np
import pytest

from softgrip.errors import DataFileError, DataUnavailableError, InvalidInputError
from softgrip.tactile import published_readings
from softgrip.tactile.published_readings import ForceReadings, parse

ROWS = ("1.5,2,3", "0.981,0.981,0", "2,,1")


@pytest.fixture
def file(tmp_path):
    def write(*rows):
        (tmp_path / "mine.csv").write_text("\r\n".join(rows) + "\r\n")
        return tmp_path / "mine.csv"

    return write


def test_rows_are_signals_and_forces(file):
    found = parse(file(*ROWS))
    assert found.signal.tolist() == [1.5, 2.0, 3.0]
    assert found.force.tolist() == [0.981, 0.981, 0.0]
    assert found.levels.tolist() == [0.0, 0.981]
    assert not found.signal.flags.writeable


@pytest.mark.parametrize(("place", "row"), [(0, "1.5,2"), (1, "0.981,0,0"), (2, "3")])
def test_rows_that_do_not_fit_each_other_are_refused(file, place, row):
    rows = [*ROWS]
    rows[place] = row
    with pytest.raises(DataFileError, match="counts"):
        parse(file(*rows))


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (ROWS[:2], "three rows of numbers, got 2"),
        ((*ROWS, "1"), "three rows of numbers, got 4"),
        (("1.5,x,3", *ROWS[1:]), "line 1: expected finite numbers"),
        (('1.5,"2', *ROWS[1:]), "cells parted by commas"),
    ],
)
def test_other_files_are_refused(file, rows, words):
    with pytest.raises(DataFileError, match=words):
        parse(file(*rows))


def test_arrays_of_two_lengths_are_refused():
    with pytest.raises(InvalidInputError, match="one shape"):
        ForceReadings(np.zeros(3), np.zeros(2))


@pytest.mark.usefixtures("published_readings")
def test_the_published_readings_are_weights_of_up_to_a_hundred_gram_force():
    found = published_readings.load()
    assert found.force.size == 100
    # He took 9.81 m/s^2: the levels are whole multiples of 5 gf with it.
    steps = found.levels / (9.81 * 5e-3)
    assert np.abs(steps - steps.round()).max() < 1e-9
    assert (steps.round()[0], steps.round()[-1], len(steps)) == (0, 20, 13)
    assert (found.signal.min(), found.signal.max()) == (0.64, 11.44)


def test_without_them_the_statement_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(published_readings, "available", lambda: False)
    assert "SOFTGRIP_AUTHOR_DIR" in published_readings.statement()
    monkeypatch.undo()
    monkeypatch.setenv("SOFTGRIP_AUTHOR_DIR", str(tmp_path))
    with pytest.raises(DataUnavailableError, match=r"force-sensor-2020-09-14\.csv"):
        published_readings.statement()
