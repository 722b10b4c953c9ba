"""A run in a thread: what it logs, and how it is stopped."""

import time
from threading import Event

import pytest

from book.chapter_4.controllers import controller
from book.live.experiments import experiments
from softgrip.board.driver import Board
from softgrip.board.emulated.link import EmulatedFingers, finger
from softgrip.board.emulated.terminal import Terminal
from softgrip.board.errors import CommandRefusedError, ConnectionLostError
from softgrip.board.protocol import Flag
from softgrip.control.rig_controller import Tracking
from softgrip.control.staircase import staircase
from softgrip.errors import InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.rig.connect import connect
from softgrip.rig.live import LiveRun
from softgrip.rig.simulated import SimulatedRig
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.simulation import Simulation
from tests.board.emulated import needs_emulator
from tests.simulator.rigs import design_1

SOON = 60.0  # s: far more than anything takes on a busy machine, so that a hang is a failure


def until(done, within=SOON):
    end = time.monotonic() + within
    while not done():
        assert time.monotonic() < end
        time.sleep(0.002)


def run_of(rig, path, name="staircase", **options):
    return LiveRun(rig, experiments()[name], path, **options)


def test_the_staircase_is_what_the_loop_of_the_logs_gives(path):
    # That loop is another one, so that it is an oracle; its references move.
    reference = staircase()
    loop = drive(
        Simulation(design_1(), seed=SEED), Tracking(controller("full"), reference), duration=15.575
    )
    with SimulatedRig(Simulation(design_1(), seed=SEED)) as rig:
        run = run_of(rig, path, real_time=False)
        run.start()
        assert run.wait(SOON).samples == 624
    made = read_log(path)
    assert made["time"] == pytest.approx(loop.time)
    assert made["reference"] == pytest.approx(reference, abs=1e-8)
    # Rounded commands move the angle by far less than a count, but one may tip over.
    assert made["command"] == pytest.approx(loop.command[:, 0], abs=1e-2)
    assert made["angle_counts"] == pytest.approx(loop.measured.angle_counts[:, 0, 0], abs=1)
    assert run.state == "done"


def test_what_is_drawn_is_what_is_logged(path):
    with connect("simulated") as rig:
        run = run_of(rig, path, "step", real_time=False)
        run.start()
        run.wait(SOON)
    log = read_log(path)
    assert [one.time for one in run.samples] == log["time"][1:].tolist()
    assert [one.pressure for one in run.samples] == log["pressure"][1:].tolist()
    assert [one.angles for one in run.samples] == [(angle,) for angle in log["angle"][1:]]
    assert [one.command for one in run.samples] == pytest.approx(log["command"][1:], abs=1e-4)


def test_a_simulated_run_keeps_the_pace_of_a_clock(path):
    with connect("simulated") as rig:
        run = run_of(rig, path)
        begun = time.monotonic()
        run.start()
        until(lambda: len(run.samples) >= 20)
        assert time.monotonic() - begun >= 0.45  # of 0.5 s: the last sample waits afterwards
        run.emergency_stop()
        run.join(SOON)


def test_nothing_moves_before_the_start(path):
    with connect("simulated") as rig:
        run = run_of(rig, path)
        assert rig.rig.time == 0
        assert run.state == "ready"
        assert not path.exists()


def test_the_stop_is_heard_while_a_simulated_run_is_on(path):
    with connect("simulated") as rig:
        run = run_of(rig, path)
        run.start()
        until(lambda: len(run.samples) > 10)
        run.emergency_stop()
        count = len(run.samples)
        with pytest.raises(CommandRefusedError, match="emergency stop"):
            run.wait(SOON)
        assert run.state == "stopped"
        assert len(run.samples) <= count + 1  # the period that was on, and none after it
        for _ in range(5):  # the motor's ramp
            rig.stop()
        place = rig.rig.truth.plunger.copy()
        rig.stop()
        assert rig.rig.truth.plunger == place
        again = run_of(rig, path.with_name("again.csv"))
        again.start()
        with pytest.raises(CommandRefusedError, match="emergency stop"):
            again.wait(SOON)
        rig.clear()
        third = run_of(rig, path.with_name("third.csv"), rest=1.0, real_time=False)
        third.start()
        assert third.wait(SOON).samples == 624
    assert "ended by CommandRefusedError" in read_log(path).events[-1][1]


def test_a_board_hears_the_stop_at_once(pty_board, path):
    port, board = pty_board
    with Board(port, emulated=True) as rig:
        assert rig.real_time
        run = run_of(rig, path)
        advance, within, go_on = rig.advance, Event(), Event()

        def held(command):
            if len(run.samples) > 10:
                within.set()
                go_on.wait(SOON)
            return advance(command)

        rig.advance = held
        run.start()
        assert within.wait(SOON)
        run.emergency_stop()
        # It is acknowledged by now, though the run is held up within its period.
        assert board.flags & Flag.ESTOPPED
        assert board.speed == 0
        go_on.set()
        with pytest.raises(CommandRefusedError, match="estopped"):
            run.wait(SOON)
        assert board.speed == 0


def test_a_stop_that_was_not_heard_is_said_again_when_the_line_is_back(socket_board, path):
    with Board(socket_board.url, emulated=True) as rig:
        run = run_of(rig, path)
        run.start()
        until(lambda: len(run.samples) > 10)
        socket_board.pull()
        with pytest.raises(ConnectionLostError):
            run.emergency_stop()
        assert not socket_board.board.flags & Flag.ESTOPPED
        socket_board.plug()
        with pytest.raises(CommandRefusedError, match="estopped"):
            run.wait(SOON)
        assert socket_board.board.flags & Flag.ESTOPPED
        assert socket_board.board.speed == 0


@needs_emulator
def test_the_firmware_hears_the_stop_while_it_homes(path):
    emulated = EmulatedFingers(finger(position=3000))  # 7.5 s from its switch
    with Terminal(emulated) as port, Board(port, emulated=True) as rig:
        run = run_of(rig, path)
        run.start()
        until(lambda: rig.telemetry.flags & Flag.HOMING and emulated.board.position < 2990)
        run.emergency_stop()
        with pytest.raises(CommandRefusedError, match="homing failed"):
            run.wait(SOON)
        place, stopped = emulated.board.position, emulated.now()
        assert run.state == "stopped"
        assert place > 1000
        until(lambda: emulated.now() > stopped + 0.2)
        assert emulated.board.position == place
        assert rig.telemetry.flags & Flag.ESTOPPED
    assert not path.exists()


def test_a_line_in_virtual_time_is_told_between_periods(stub, path):
    with Board(stub) as rig:
        assert not rig.real_time
        run = run_of(rig, path)
        run.emergency_stop()
        assert "estop" not in stub.received
        run.start()
        with pytest.raises(CommandRefusedError, match="estopped"):
            run.wait(SOON)
        assert "estop" in stub.received


def test_an_error_of_the_thread_is_told(path):
    path.write_text("precious")
    with connect("simulated") as rig:
        run = run_of(rig, path, real_time=False)
        run.start()
        with pytest.raises(InvalidInputError, match="does not exist"):
            run.wait(SOON)
        assert run.state == "failed"
    assert path.read_text() == "precious"


def test_a_run_that_goes_on_is_not_over(path):
    with connect("simulated") as rig:
        run = run_of(rig, path)
        run.start()
        with pytest.raises(TimeoutError, match="staircase"):
            run.wait(0.05)
        other = run_of(rig, path.with_name("other.csv"))
        with pytest.raises(InvalidInputError, match="no other run"):
            other.start()
        run.emergency_stop()
        run.join(SOON)


def test_what_cannot_be_driven_is_refused(path):
    with connect("simulated:gripper") as gripper, pytest.raises(InvalidInputError, match="period"):
        run_of(gripper, path)


def test_a_log_is_named_after_what_was_run(tmp_path):
    made = experiments()["step"].log_path(tmp_path / "runs")
    assert made.parent.is_dir()
    assert made.name.startswith("step-20")
    assert experiments()["step"].log_path(tmp_path / "runs") != made  # within the same second
