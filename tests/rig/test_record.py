"""Runs that are logged, on what goes well and on what does not."""

import signal
import subprocess
import sys
import threading
import time
from contextlib import suppress

import numpy as np
import pytest

from book.chapter_3.regulators import regulator
from book.chapter_4.controllers import controller
from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from book.companion.choices import choice
from book.companion.simulated_logs import STEP, make
from softgrip.board.driver import Board
from softgrip.board.errors import CommandRefusedError, ConnectionLostError
from softgrip.board.protocol import Flag
from softgrip.control.rig_controller import Tracking
from softgrip.errors import InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.provenance import data_folder
from softgrip.rig.connect import connect
from softgrip.rig.record import record, show_progress
from softgrip.rig.simulated import SimulatedRig, simulated_gripper
from softgrip.simulator import fitted_rigs
from softgrip.simulator.chance import SEED
from softgrip.simulator.simulation import Simulation
from tests.simulator.rigs import design_1

FOLDER = data_folder() / "simulated"


def finger():
    return SimulatedRig(Simulation(design_1(), seed=SEED))


class After:
    """A controller that turns slowly, and does something once at a sample."""

    def __init__(self, sample, action):
        self.sample, self.action, self.count = sample, action, 0

    def update(self, measured):
        self.count += 1
        if self.count == self.sample:
            self.action()
        return 0.5


def stop_with(error):
    def action():
        raise error

    return action


# The controllers of the chapters, through the driver's interface. The logs that the package brings
# were made by other loops, so that they are an oracle.


def fitted_finger():
    return SimulatedRig(Simulation(fitted_rigs.design_1(), seed=SEED))


def test_chapter_4_pid_gives_the_log_of_its_own_loop(path):
    step = choice("pid_step")
    with fitted_finger() as connection:
        connection.home()
        record(connection, Tracking(controller("full"), step), 5.0, path, reference=step)
    made, kept = read_log(path), read_log(FOLDER / "pid-full.csv")
    assert made["time"].tolist() == kept["time"][:201].tolist()
    for name in kept.columns:
        assert made[name].tolist() == kept[name][:201].tolist()


def test_chapter_3_lqr_gives_the_log_of_its_own_loop(path):
    kept = read_log(FOLDER / "lqr-fast.csv")
    step = choice("lqr_step")
    with fitted_finger() as connection:
        connection.home()
        record(connection, Tracking(regulator("fast"), step), 5.0, path, reference=step)
    assert read_log(path)["angle"].tolist() == kept["angle"][:201].tolist()


def test_chapter_6_scheme_gives_the_log_of_its_own_loop(path, tmp_path):
    # Made here, not the kept one: another numpy rounds some of its commands otherwise.
    own = read_log(make("gripper-fast-1", tmp_path / "own"))
    targets = np.round(target_angles(own_model()), 9)  # as the log's
    with simulated_gripper(seed=SEED) as gripper:
        gripper.home()
        record(gripper, gripper_controller("4.8/s"), 3.0, path, reference=targets)
    made = read_log(path)
    assert set(made.columns) == set(own.columns)
    for name in own.columns:
        assert made[name].tolist() == own[name][:31].tolist()


def test_chapter_4_pid_runs_through_the_driver(rig, path):
    record(rig, Tracking(controller("full"), STEP), 6.0, path, reference=STEP)
    log = read_log(path)
    # The stub drives a simulated finger, which rests at the reference; its noise is 2 deg.
    assert log["angle"][-40:].mean() == pytest.approx(STEP, abs=np.radians(6))
    assert log.header.provenance == "simulated"


def test_a_reference_that_moves_reaches_all_fingers_and_is_held_at_its_end(path):
    with simulated_gripper() as gripper:
        gripper.home()
        record(gripper, [0.0], 0.5, path, reference=[[0.1], [0.3], [0.2]])
    log = read_log(path)
    for name in ("reference", "reference_2"):
        assert log[name].tolist() == [0.1, 0.3, 0.2, 0.2, 0.2, 0.2]


def test_a_reference_of_other_fingers_is_refused(path):
    with simulated_gripper() as gripper, pytest.raises(InvalidInputError, match="reference"):
        record(gripper, [0.0], 0.5, path, reference=[0.1, 0.2, 0.3])
    assert not path.exists()


# What goes wrong.


def test_a_log_is_never_written_over(path):
    path.write_text("precious")
    with connect("simulated") as one, pytest.raises(InvalidInputError, match="does not exist"):
        record(one, [0.0], 0.1, path)
    assert path.read_text() == "precious"


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ValueError("no, not this")])
def test_an_error_stops_the_motor_and_the_log_says_it(rig, stub, path, error):
    with pytest.raises(type(error)):
        record(rig, After(8, stop_with(error)), 10.0, path)
    assert stub.speed == 0
    log = read_log(path)
    assert log["time"].size == 8
    assert f"ended by {type(error).__name__}" in log.events[-1][1]


def test_a_refused_command_ends_the_run_at_rest(rig, stub, path):
    with pytest.raises(CommandRefusedError, match="estopped"):
        record(rig, After(8, rig.emergency_stop), 10.0, path)
    assert "refused: estopped" in read_log(path).events[-1][1]


def test_a_cable_pulled_and_put_back_costs_a_gap_that_is_said(rig, stub, path):
    made = record(rig, After(20, lambda: stub.pull(1.0)), 3.0, path)
    log = read_log(path)
    assert len(made.reconnections) == 1
    step = np.diff(log["time"])
    assert (step > 0.03).sum() == 1
    assert step.max() == pytest.approx(1.0, abs=0.1)
    words = " ".join(words for _, words in log.events)
    assert "cable pulled" in words
    assert "found again" in words
    # Meanwhile the board stopped the motor by itself; afterwards the run went on.
    assert log["command"][np.argmax(step) + 1] == 0
    assert log["command"][-1] == 0.5
    assert log["time"][-1] == pytest.approx(3.0, abs=0.03)


def test_a_cable_that_stays_away_ends_the_run_in_time(rig, stub, path):
    with pytest.raises(ConnectionLostError, match="not found again in 2 s"):
        record(rig, After(20, lambda: stub.pull(30.0)), 60.0, path, reconnect_within=2.0)
    log = read_log(path)
    assert log["time"].size == 20
    assert "not found again" in log.events[-1][1]
    stub.pull(0.0)
    rig.reconnect(1.0)
    assert stub.speed == 0


def test_a_reset_under_way_ends_the_run_since_the_place_is_lost(rig, stub, path):
    with pytest.raises(CommandRefusedError, match="not homed"):
        record(rig, After(20, stub.reset), 60.0, path)
    assert stub.speed == 0
    words = " ".join(words for _, words in read_log(path).events)
    assert "the board was reset" in words
    assert "refused: not homed" in words


def test_a_real_line_pulled_and_put_back(socket_board, path):
    def pull():
        socket_board.pull()
        threading.Timer(0.4, socket_board.plug).start()

    with Board(socket_board.url, emulated=True) as rig:
        rig.home()
        made = record(rig, After(10, pull), 4.0, path)
    log = read_log(path)
    assert made.reconnections  # on a busy machine perhaps one more
    assert np.diff(log["time"]).max() > 0.3
    assert log["time"][-1] >= 3.9
    assert socket_board.board.speed == 0
    assert not socket_board.board.flags & Flag.MOVING


KILLED = """
import sys, time
from softgrip.rig.connect import connect
from softgrip.rig.record import record

class Slow:
    def update(self, measured):
        time.sleep(0.005)
        return 0.1

def say(row, duration):
    print(row["time"], flush=True)

with connect("simulated") as rig:
    rig.home()
    record(rig, Slow(), 1e4, sys.argv[1], progress=say)
"""


def a_second_before_the_last(told):
    """Return what was told until then, of pairs of when and what."""
    return [what for when, what in told if when < told[-1][0] - 1.0]


def test_a_killed_host_leaves_a_log_that_lacks_a_second_at_most(path):
    child = subprocess.Popen(
        [sys.executable, "-c", KILLED, str(path)], stdout=subprocess.PIPE, text=True
    )
    try:
        told = []
        for line in child.stdout:
            told.append((time.monotonic(), float(line)))
            if len(a_second_before_the_last(told)) > 5:
                break
    finally:
        child.send_signal(signal.SIGKILL)
        child.wait()
        child.stdout.close()
    log = read_log(path)
    assert log["time"][-1] >= a_second_before_the_last(told)[-1]
    assert np.diff(log["time"]) == pytest.approx(0.025)


FULL_DISK = """
import resource, sys
from softgrip.rig.connect import connect
from softgrip.rig.record import record

resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
with connect("simulated") as rig:
    rig.home()
    made = record(rig, [0.1] * 400, 10.0, sys.argv[1])
    assert rig.rig.time >= 10.0
print(made.samples, made.log_failure)
"""


def test_a_full_disk_ends_the_log_and_not_the_run(path):
    done = subprocess.run(
        [sys.executable, "-c", FULL_DISK, str(path)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.startswith("401 OSError: ")
    assert done.stderr.count("the run goes on") == 1
    assert "Traceback" not in done.stderr
    assert path.stat().st_size == 4000
    assert 10 < read_log(path)["time"].size < 100  # and what is there can be read


def test_progress_is_shown_of_long_runs_on_a_terminal(capsys, monkeypatch):
    show_progress({"time": 1.0}, 10.0)
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    show_progress({"time": 1.0}, 2.0)
    assert capsys.readouterr().err == ""
    show_progress({"time": 5.0}, 10.0)
    assert "###" in (shown := capsys.readouterr().err)
    assert "5 of 10 s" in shown
    with suppress(KeyboardInterrupt):
        show_progress({"time": 10.0}, 10.0)
    assert capsys.readouterr().err.endswith("\n")
