"""A log as a rig."""

import numpy as np
import pytest

from book.chapter_4.controllers import controller
from book.companion.choices import choice
from softgrip.board.errors import EndOfReplayError
from softgrip.control.rig_controller import Tracking
from softgrip.errors import DataFileError
from softgrip.logs.reader import read_log
from softgrip.provenance import data_folder
from softgrip.rig.connect import connect
from softgrip.rig.record import record
from softgrip.rig.replay import Replay

FOLDER = data_folder() / "simulated"
PATH = FOLDER / "pid-full.csv"


@pytest.fixture
def replay():
    with Replay(PATH) as opened:
        opened.home()
        yield opened


def test_a_replay_says_what_was_recorded(replay):
    log = read_log(PATH)
    for row in range(1, 6):
        found = replay.advance(log["command"][row])
        assert found.time == log["time"][row]
        assert found.pressure.tolist() == [log["pressure"][row]]
        assert found.angle.tolist() == [[log["angle"][row]]]
        assert found.angle_counts.tolist() == [[log["angle_counts"][row]]]
    assert replay.difference == 0.0


def test_a_recorded_controller_does_again_what_it_did(replay, tmp_path):
    path = tmp_path / "again.csv"
    step = choice("pid_step")
    record(replay, Tracking(controller("full"), step), 5.0, path, reference=step)
    assert replay.difference == 0.0
    old, new = read_log(PATH), read_log(path)
    assert new["angle"].tolist() == old["angle"][:201].tolist()
    assert new.header.back_end == "replay"
    assert new.header.provenance == old.header.provenance


def test_a_replay_does_not_answer_to_another_command(replay):
    replay.advance(0.0)
    assert replay.difference == pytest.approx(read_log(PATH)["command"][1])


def test_a_replay_ends(replay):
    rows = read_log(PATH)["time"].size
    for _ in range(rows - 1):
        replay.advance(0.0)
    with pytest.raises(EndOfReplayError, match=f"row {rows}"):
        replay.advance(0.0)


def test_a_log_that_ends_early_ends_the_run_and_its_log_is_whole(replay, tmp_path):
    path = tmp_path / "log.csv"
    with pytest.raises(EndOfReplayError):
        record(replay, np.zeros(9), 1e3, path)
    log = read_log(path)
    assert log["time"].size == read_log(PATH)["time"].size
    assert "ended by EndOfReplayError" in log.events[-1][1]


def test_events_come_again():
    with connect(f"replay:{FOLDER / 'gripper-push-1.csv'}") as rig:
        assert rig.fingers == 2
        words = []
        for _ in range(60):
            rig.advance(0.0)
            words.append(rig.take_event())
    assert [one for one in words if one] == ["push on the left finger", "released"]


def test_a_file_that_is_no_log_is_refused(tmp_path):
    with pytest.raises(DataFileError):
        connect(f"replay:{data_folder() / 'materials/table_5_1.csv'}")
    empty = tmp_path / "empty.csv"
    lines = PATH.read_text().splitlines(keepends=True)
    empty.write_text("".join(line for line in lines if line.startswith(("#", "time"))))
    with pytest.raises(DataFileError, match="rows"):
        connect(f"replay:{empty}")
