"""A log as evidence: what of it is used, and what is refused."""

import numpy as np
import pytest

from softgrip.errors import DataFileError
from softgrip.provenance import data_folder
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.trial import noise_of, read_trial
from tests.logs.test_gaps import retimed, rewrite, without

FOLDER = data_folder() / "simulated"
STEP, PUSH, GRIPPER = (FOLDER / f"{name}.csv" for name in ("step-60-1", "push-a", "gripper-open-1"))


def test_a_whole_log():
    one = read_trial(STEP)
    assert (one.fingers, one.period, one.plunger, one.left_out) == (1, 0.025, 0.0, ())
    assert one.commands.shape == one.at.shape == one.measured[0].shape == (240,)
    assert one.at.tolist() == list(range(240))
    assert one.believed.all()
    # All commands go in; on a screw of 8 mm.
    assert one.deepest == pytest.approx(one.commands.sum() * 0.025 * 8e-3 / (2 * np.pi))
    assert read_trial(GRIPPER).measured.shape == (3, 61)


def test_noise_is_that_of_the_sensors():
    one = read_trial(STEP)
    sensors = design_1().sensors
    own = [sensors.pressure_noise, sensors.angle_noise]
    # And the converter's rounding. Of 240 rows the estimate is good to 10 %.
    assert one.noise == pytest.approx(np.hypot(own, one.rounding), rel=0.15)
    assert one.rounding[0] == pytest.approx(80 * 6894.757 / 818.4 / 12**0.5, rel=1e-6)


def test_noise_of_rows_with_a_gap():
    random = np.random.default_rng(0)
    at = np.delete(np.arange(4000.0), slice(100, 3900, 3))
    values = 100 * np.sin(at / 50) + random.standard_normal(at.size)
    assert noise_of(values, at) == pytest.approx(1.0, rel=0.15)
    assert noise_of(np.zeros(2), np.arange(2.0)) == 0.0


def test_a_gap_within_one_command_is_bridged(path):
    one = read_trial(without(path, PUSH, range(50, 60)))
    assert one.at[49:52].tolist() == [49, 60, 61]
    assert one.commands.tolist() == read_trial(PUSH).commands.tolist()
    assert one.left_out == ()


def test_a_gap_over_a_change_ends_the_log(path):
    def change(rows):
        later = [[row[0], "1.0", *row[2:]] for row in rows[105:]]
        return rows[:96] + later

    one = read_trial(rewrite(path, PUSH, change))
    assert one.at.size == 96
    assert "9 rows missing" in one.left_out[0]


def test_rows_that_come_late(path):
    late = read_trial(retimed(path, STEP, lambda t: t + 0.004 * (np.arange(t.size) % 2)))
    assert late.at[:3] == pytest.approx([0, 1.16, 2], abs=2e-3)  # 4 ms late in 6 s
    slow = read_trial(retimed(path, STEP, lambda t: 1.005 * t))
    assert slow.period == pytest.approx(1.005 * 0.025)
    assert slow.at == pytest.approx(np.arange(240), abs=1e-6)


def test_a_command_that_was_held_back_did_not_move(path):
    held = rewrite(path, STEP, lambda rows: [
        [*row[:-1], "held back: over pressure"] if 5 <= k < 8 else row for k, row in enumerate(rows)
    ])  # fmt: skip
    found = read_trial(held).commands
    assert np.flatnonzero(found != read_trial(STEP).commands).tolist() == [5, 6, 7]


def test_a_channel_that_tells_nothing_is_left_out(path):
    def set_cells(column, text):
        return rewrite(path, STEP, lambda rows: [
            [*row[:column], text, *row[column + 1 :]] for row in rows
        ])  # fmt: skip

    one = read_trial(set_cells(3, "500"))
    assert one.left_out == ("column 'angle' was left out: it never changes",)
    assert one.believed.any(axis=1).tolist() == [True, False]
    assert np.isinf(one.noise[1])
    one = read_trial(set_cells(2, "1023"))
    assert one.left_out == (
        "column 'pressure' was left out: it is at an end of the converter's scale",
    )


def test_clamped_and_weighted():
    one = read_trial(STEP, clamped=True, torque=0.01)
    assert (one.clamped, one.torque) == (True, 0.01)
    assert one.believed.any(axis=1).tolist() == [True, False]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda rows: rows[:20], "expected 40 rows or more, got 20"),
        (lambda rows: [[row[0], "0.0", *row[2:]] for row in rows], "column 'command': 0"),
        (lambda rows: [[*row[:4], "9000.0", *row[5:]] for row in rows], "'pressure': 9000 Pa"),
        (lambda rows: [[*row[:2], "1023", "1023", *row[4:]] for row in rows], "column 'angle' was"),
    ],
)  # fmt: skip
def test_a_log_that_cannot_be_used(path, change, words):
    with pytest.raises(DataFileError, match=words) as error:
        read_trial(rewrite(path, STEP, change))
    assert str(path) in str(error.value)


@pytest.mark.parametrize("words", ["1 mm", "", "-1 m", "two m"])
def test_a_place_of_the_plunger_that_is_none(path, words):
    text = STEP.read_text().replace(
        "plunger_at_start: 0.0 m", f"plunger_at_start: {words}".rstrip()
    )
    path.write_text(text)
    with pytest.raises(DataFileError, match="plunger_at_start: <number> m"):
        read_trial(path)


def test_a_log_of_the_pad():
    with pytest.raises(DataFileError, match="a log of the gripper, got pad"):
        read_trial(FOLDER / "pad-objects.csv")
