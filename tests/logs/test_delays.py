"""Delays from logs: known ones found again, by this fit and by others, and how sure it is."""

import numpy as np
import pytest

from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.delays import (
    LATEST,
    bending_delay,
    pressure_delay,
    read_delays,
    second_order,
)
from softgrip.logs.reader import read_log
from softgrip.provenance import data_file

PERIOD = 0.1
TIME = PERIOD * np.arange(50)
PUSHED = np.clip(TIME - 0.3, 0, 0.2) * 20.0
"""What the motor has turned, rad: a push of 0.2 s."""


@pytest.mark.parametrize(("w", "z"), [(1.2, 0.4), (2.0, 0.7), (5.0, 1.6)])
def test_answer_is_that_of_second_order_dynamics(w, z):
    ours = second_order(TIME, PUSHED, w, z, late=0.0)
    assert ours == pytest.approx(
        response(SecondOrder(w, z), TIME, PUSHED, initial_pressure=0.0), abs=1e-7
    )
    # Late by whole samples it is the same numbers later.
    late = second_order(TIME, PUSHED, w, z, late=3 * PERIOD)
    assert late[3:] == pytest.approx(ours[:-3], abs=1e-12)


@pytest.mark.parametrize("delay", [0.0, 0.07, 0.3])
def test_a_known_delay_is_found_without_noise(delay):
    angle = 0.1 + 0.2 * second_order(TIME, PUSHED, 2.0, 0.7, late=delay)
    found = bending_delay(TIME, PUSHED, angle)
    assert found.value == pytest.approx(delay, abs=2e-3)
    assert found.low - 2e-3 <= delay <= found.high + 2e-3


def noisy(delay, seed):
    answer = 0.2 * second_order(TIME, PUSHED, 2.0, 0.7, late=delay)
    return answer + np.random.default_rng(seed).normal(0, 0.012, TIME.size)


def test_intervals_hold_what_is_known_as_often_as_they_claim():
    found = [bending_delay(TIME, PUSHED, noisy(0.15, seed)) for seed in range(8)]
    held = sum(one.low <= 0.15 <= one.high for one in found)
    # Of 8 with a chance of 95 % each, fewer than 6 come once in two hundred times.
    assert held >= 6
    widths = [one.high - one.low for one in found]
    spread = np.std([one.value for one in found])
    assert 2 * spread < np.median(widths) < 8 * spread


def test_it_is_the_best_of_a_grid_of_all_three_numbers():
    """By brute force, with the response of `dynamics` shifted by whole fine steps."""
    angle = noisy(0.15, 3)
    fine = np.arange(0, TIME[-1] + 1e-9, 0.01)
    pushed = np.interp(fine, TIME, PUSHED)
    best = (np.inf, 0.0)
    for w in np.geomspace(1.2, 3.5, 16):
        for z in np.linspace(0.3, 1.3, 13):
            whole = response(SecondOrder(float(w), float(z)), fine, pushed, initial_pressure=0.0)
            for late in range(5, 30):
                moved = np.concatenate([np.zeros(late), whole[: whole.size - late]])[::10]
                columns = np.column_stack([moved, np.ones_like(moved)])
                left = np.linalg.lstsq(columns, angle, rcond=None)[1]
                best = min(best, (float(left[0]), 0.01 * late))
    assert bending_delay(TIME, PUSHED, angle).value == pytest.approx(best[1], abs=0.02)


LOGS = [data_file(f"simulated/gripper-open-{run}.csv").path for run in range(1, 8)]


def shifted(path, folder, rows, columns):
    """Write a log in which some columns come so many rows later, with the noise of its first."""
    lines = path.read_text().splitlines()
    start = next(k for k, line in enumerate(lines) if not line.startswith("#"))
    names = [name.partition(" ")[0] for name in lines[start].split(",")]
    cells = [line.split(",") for line in lines[start + 1 :]]
    late = [list(row) for row in cells]
    for name in columns:
        k = names.index(name)
        for j, row in enumerate(late):
            row[k] = cells[max(j - rows, 0)][k]
    file = folder / path.name
    file.write_text("\n".join([*lines[: start + 1], *map(",".join, late), ""]))
    return file


def test_what_comes_later_in_logs_of_the_simulated_gripper_is_found(tmp_path):
    as_it_is = read_delays(LOGS)
    for own in as_it_is.whole:
        assert 0.1 < own.low < own.value < own.high < 0.35
    late = read_delays([shifted(one, tmp_path, 2, ["angle_2"]) for one in LOGS])
    assert late.whole[0].value == pytest.approx(as_it_is.whole[0].value, abs=1e-3)
    # The end of the record is cut; a delay moves by less than a quarter of its interval for that.
    assert late.whole[1].value - as_it_is.whole[1].value == pytest.approx(0.2, abs=0.015)


def test_cross_correlation_finds_the_same_shift(tmp_path):
    """Without any model: the lag at which the rates of both logs agree best."""
    (first,) = [shifted(LOGS[0], tmp_path, 3, ["angle", "angle_2"])]
    rates = [np.diff(read_log(path)["angle"]) for path in (LOGS[0], first)]
    lag = int(np.argmax(np.correlate(rates[1], rates[0], "full"))) - (rates[0].size - 1)
    moved = [read_delays([path]).whole[0].value for path in (LOGS[0], first)]
    assert moved[1] - moved[0] == pytest.approx(lag * PERIOD, abs=0.03)  # of one noisy run
    assert lag == 3


STEPS = [data_file(f"simulated/step-60-{run}.csv").path for run in range(1, 8)]


def test_transport_is_told_from_response_by_the_pressure(tmp_path):
    """The simulated finger has no transport delay; eight rows of 25 ms are put into its logs."""
    as_it_is = read_delays(STEPS)
    late = read_delays([shifted(one, tmp_path, 8, ["pressure", "angle"]) for one in STEPS])
    assert as_it_is.transport.low == 0 <= as_it_is.transport.high < 0.06
    assert late.transport.low < 0.2 < late.transport.high + 0.02
    assert late.transport.value == pytest.approx(0.2, abs=0.025)
    (one,), (other,) = as_it_is.response, late.response
    assert other.value == pytest.approx(one.value, abs=0.03)
    assert other.low < one.value < other.high


def test_pressure_of_a_plunger_alone_is_late_by_what_is_put_in():
    """Of a push of many samples: two on its way could not tell a delay from a bend of the line."""
    pushed = np.clip(TIME - 0.3, 0, 1.0) * 4.0
    swept = np.interp(TIME - 0.13, TIME, pushed)
    noise = np.random.default_rng(0).normal(0, 30.0, TIME.size)
    found = pressure_delay(TIME, pushed, 2000.0 * swept + 40.0 * swept**2 + noise, TIME[None] * 0)
    assert found.value == pytest.approx(0.13, abs=0.02)
    assert found.low < 0.13 < found.high < found.low + 0.05


def test_a_record_that_tells_nothing_says_so():
    angle = np.random.default_rng(0).normal(0, 0.01, TIME.size)
    assert not bending_delay(TIME, PUSHED, angle).told
    assert bending_delay(TIME, PUSHED, angle).high <= LATEST


def test_records_that_cannot_be_read_are_refused(tmp_path):
    with pytest.raises(InvalidInputError, match="motion"):
        bending_delay(TIME, PUSHED, np.zeros(TIME.size))
    with pytest.raises(InvalidInputError, match="N >="):
        bending_delay(TIME[:5], PUSHED[:5], PUSHED[:5])
    bare = tmp_path / "bare.csv"
    bare.write_text("time [s],pressure [Pa]\n" + "".join(f"{k / 10},{k}\n" for k in range(20)))
    with pytest.raises(DataFileError, match="command"):
        read_delays([bare])
