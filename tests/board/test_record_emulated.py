"""The dissertation's controllers on the real firmware, emulated, with simulated fingers."""

import numpy as np
import pytest

from book.chapter_3.regulators import regulator
from book.chapter_4.controllers import controller
from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from book.companion.simulated_logs import STEP
from softgrip.board.driver import HUNG_AFTER
from softgrip.board.errors import CommandRefusedError
from softgrip.control.rig_controller import Tracking
from softgrip.logs.fingers import fingers_of
from softgrip.logs.reader import read_log
from softgrip.rig.check import run_check
from softgrip.rig.connect import connect
from softgrip.rig.record import record
from softgrip.units import DEG
from tests.board.emulated import needs_emulator

pytestmark = needs_emulator

END_NOISE = 2 * DEG / np.sqrt(40) * 4
"""rad: four deviations of the mean of 40 samples of the flex sensor's noise."""


def test_chapter_4_pid(path):
    with connect("emulated") as rig:
        rig.home()
        record(rig, Tracking(controller("full"), STEP), 6.0, path, reference=STEP)
        assert rig.session.lost == 0
    log = read_log(path)
    # 5 % of the step, within which this PID rests by then, and the sensor's noise.
    assert log["angle"][-40:].mean() == pytest.approx(STEP, abs=0.05 * STEP + END_NOISE)
    assert (log.header.back_end, log.header.provenance) == ("emulated board", "simulated")
    assert np.diff(log["time"]) == pytest.approx(0.025, abs=1e-6)


def test_chapter_3_lqr(path):
    with connect("emulated") as rig:
        rig.home()
        record(rig, Tracking(regulator("fast"), STEP), 3.0, path, reference=STEP)
    assert read_log(path)["angle"][-40:].mean() == pytest.approx(STEP, abs=0.05 * STEP + END_NOISE)


def test_chapter_6_scheme(path):
    targets = target_angles(own_model())
    with connect("emulated:gripper") as rig:
        rig.home()
        record(rig, gripper_controller("2/s"), 7.0, path, reference=targets)
    log = read_log(path)
    assert log["time"].size == 71
    ends = fingers_of(log)[:, -20:].mean(axis=1)
    # Run to run the fingers' stiffness varies: the kept logs of this controller err by up to
    # 2.5 deg, and twenty samples of the flex sensor by 0.45 deg.
    assert ends == pytest.approx(targets, abs=4 * DEG)
    assert ends[0] > ends[1]


def test_what_the_board_counts_is_what_the_pump_does():
    with connect("emulated") as rig:
        rig.home()
        for _ in range(40):
            rig.advance(10.0)
        rig.stop()
        told = rig.scale.travel_in(rig.telemetry.position)
        plunger = float(rig.session.link.plant.truth.plunger[0])
        # 1 s of 10 rad/s; the stop takes a little more.
        assert told == pytest.approx(10 / (2 * np.pi) * 8e-3, rel=0.05)
        assert plunger == pytest.approx(told, abs=2e-5)  # two steps


def test_a_check_of_the_firmware():
    lines = []
    assert run_check(lambda: connect("emulated"), lines.append) == 0, lines
    assert any("telemetry: 40." in line and " 0 of 80 frames lost" in line for line in lines)


def test_a_host_that_hangs_stops_the_motor():
    with connect("emulated") as rig:
        rig.home()
        rig.advance(5.0)
        board = rig.session.link.board
        begin = board.time
        rig.session.wait(lambda: board.time > begin + HUNG_AFTER + 1.0, 9.0, "time")
        assert board.edges()[0][-1] - begin < HUNG_AFTER + 0.025 + 0.05 + 0.21


def test_firmware_that_hangs_is_reset_and_the_run_ends_at_rest(path):
    with connect("emulated") as rig:
        rig.home()
        board, count = rig.session.link.board, 0

        class Hangs:
            def update(self, measured):
                nonlocal count
                count += 1
                if count == 20:
                    board.hang(interrupts=False)
                return 1.0

        with pytest.raises(CommandRefusedError, match="not homed"):
            record(rig, Hangs(), 30.0, path)
        assert rig.info.reset_cause.name == "WATCHDOG"
        rig.home()
        rig.advance(1.0)
    words = " ".join(words for _, words in read_log(path).events)
    assert "found again" in words


def test_homing_that_is_broken_off_stops_the_motor():
    with connect("emulated") as rig:
        board = rig.session.link.board
        position = board.position
        read, count = rig.session.link.read, 0

        def interrupted(timeout):
            nonlocal count
            count += 1
            if board.position < position - 50:
                raise KeyboardInterrupt
            return read(timeout)

        rig.session.link.read = interrupted
        with pytest.raises(KeyboardInterrupt):
            rig.home()
        rig.session.link.read = read
        rig.stop()
        place = board.position
        rig.advance(0.0)
        assert 0 < board.position == place < position
