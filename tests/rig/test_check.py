"""The diagnosis of a rig."""

import pytest

from softgrip.board.driver import Board
from softgrip.board.protocol import Flag
from softgrip.provenance import data_folder
from softgrip.rig.__main__ import main
from softgrip.rig.check import run_check
from softgrip.simulator.simulation import Simulation
from tests.board.stub_board import StubBoard


def checked(board, **options):
    lines = []
    code = run_check(lambda: Board(board, **options), lines.append)
    return code, "\n".join(lines)


def lose(stub, frames):
    """Let a stub lose so many frames of telemetry at its fortieth sample."""
    sample, count = stub.rig.advance, [0]

    def dropping(*arguments):
        count[0] += 1
        stub.swallow = frames if count[0] == 40 else stub.swallow
        return sample(*arguments)

    stub.rig.advance = dropping


@pytest.mark.parametrize("name", ["simulated", "simulated:gripper"])
def test_simulated_rigs_are_good(name, capsys):
    assert main(["check", "--port", name]) == 0
    assert capsys.readouterr().out.endswith("all good\n")


def test_a_replay_can_be_checked(capsys):
    path = data_folder() / "simulated" / "step-60-1.csv"
    assert main(["check", "--port", f"replay:{path}"]) in (0, 1)
    assert "noise" in capsys.readouterr().out


def test_a_good_board(stub):
    code, text = checked(stub)
    assert code == 0, text
    assert "telemetry: 40.00 Hz, 0 of 80 frames lost" in text
    assert "limits: 0.200 MPa, 90 mm, 31.4 rad/s, silence 200 ms" in text
    assert "FAIL" not in text


def test_nothing_moves(stub):
    checked(stub)
    assert stub.rig.truth.plunger.tolist() == [0.0]
    assert "home" not in stub.received


def test_a_broken_wire_is_seen(stub):
    sample = stub.rig.advance

    def railed(*arguments):
        found = sample(*arguments)
        found.angle_counts[:] = 1023
        return found

    stub.rig.advance = railed
    code, text = checked(stub)
    assert code == 1
    assert "FAIL  angle 1" in text
    assert "counts 1023 to 1023" in text


def test_a_finger_that_is_not_there_is_seen(stub):
    assert "angle 2" in checked(stub, fingers=2)[1]


def test_lost_telemetry_is_seen(stub):
    lose(stub, 1)
    code, text = checked(stub)
    assert code == 1
    assert "FAIL  telemetry" in text
    assert "1 of 81 frames lost" in text


def test_latched_faults_are_seen(stub):
    stub.flags |= Flag.SENSOR_STUCK
    code, text = checked(stub)
    assert code == 1
    assert "FAIL  faults" in text
    assert "sensor stuck" in text


def test_noise_is_seen():
    from dataclasses import replace

    from tests.simulator.rigs import design_1

    known = design_1()
    loud = replace(known, sensors=replace(known.sensors, pressure_noise=5e3))
    code, text = checked(StubBoard(rig=Simulation(loud)))
    assert code == 1
    assert "FAIL  pressure" in text


def test_no_rig_is_another_exit_code(stub, capsys):
    stub.deaf = True
    code, text = checked(stub)
    assert code == 2
    assert "no board answered" in text
    assert main(["check", "--port", "/dev/ttyNONE"]) == 2
    assert main(["check", "--port", "simulated:hand"]) == 2


def test_find_says_what_is_there(monkeypatch, capsys):
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: [])
    assert main(["find"]) == 1
    assert "no USB port" in capsys.readouterr().out
