"""Names of back ends, and the board that is found by itself."""

from types import SimpleNamespace

import pytest

from softgrip.board.calibration import nominal, save
from softgrip.board.driver import Board
from softgrip.board.emulated import build
from softgrip.board.errors import NoBoardError, PortUnavailableError
from softgrip.board.find import candidates, find_board
from softgrip.errors import UnknownNameError
from softgrip.rig.__main__ import main
from softgrip.rig.connect import connect
from softgrip.rig.simulated import SimulatedRig


def usb(device, vid=0x2341, pid=0x0042):
    return SimpleNamespace(device=device, vid=vid, pid=pid)


def test_names_of_simulated_rigs():
    with connect("simulated") as one, connect("simulated:gripper", seed=3) as two:
        assert isinstance(one, SimulatedRig)
        assert (one.fingers, one.period) == (1, 0.025)
        assert (two.fingers, two.period) == (2, 0.1)
        assert two.header().seed == "3"
    with pytest.raises(UnknownNameError, match="simulated:gripper"):
        connect("simulated:hand")


@pytest.mark.parametrize("where", ["emulated", "emulated:gripper"])
def test_an_emulator_that_is_not_installed_says_what_to_install(where, monkeypatch, capsys):
    monkeypatch.setitem(build.NEEDED, "no-such-compiler", "gcc-avr")
    build.firmware.cache_clear()
    with pytest.raises(build.EmulatorUnavailableError, match=r"apt install .*gcc-avr"):
        connect(where)
    assert main(["check", "--port", where]) == 2
    assert "apt install" in capsys.readouterr().err


def test_a_port_that_is_not_there():
    with pytest.raises(PortUnavailableError, match="ttyNONE"):
        connect("/dev/ttyNONE")


def test_a_url_and_a_calibration_file(socket_board, tmp_path):
    path = tmp_path / "lines.csv"
    save(nominal(1), path, "a data sheet")
    with connect(socket_board.url, calibration=path, period=0.05) as rig:
        assert isinstance(rig, Board)
        assert rig.header().calibration == "lines.csv"
        assert rig.header().firmware.endswith("build 00c0ffee")


def test_the_one_board_that_answers_is_found(pty_board):
    name, _ = pty_board
    ports = [usb("/dev/ttyNONE", 0x1A86), usb(name), usb("/dev/ttyS0", None, None)]
    found = find_board(ports)
    assert found.port == name
    assert str(found) == f"{name} (Arduino 2341:0042): build 00c0ffee"
    assert [one.answered for one in candidates(ports)] == [False, True]


def test_no_board_says_what_was_found():
    with pytest.raises(NoBoardError, match="no USB port"):
        find_board([usb("/dev/ttyS0", None, None), usb("/dev/mouse", 0x046D)])
    with pytest.raises(NoBoardError, match=r"ttyNONE .*cannot be opened"):
        find_board([usb("/dev/ttyNONE")])


def test_of_several_boards_none_is_guessed(monkeypatch):
    monkeypatch.setattr("softgrip.board.find._greeted", lambda port: ("build 1", True))
    with pytest.raises(NoBoardError, match="several boards"):
        find_board([usb("a"), usb("b")])


def test_without_a_name_the_found_board_is_said(monkeypatch, socket_board, capsys):
    ports = [usb(socket_board.url)]
    monkeypatch.setattr("softgrip.board.find._greeted", lambda port: ("build 00c0ffee", True))
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: ports)
    monkeypatch.setattr("softgrip.board.driver.usb_serial", lambda port: "7573")
    with connect() as rig:
        assert rig.header().board == "7573"
    assert f"found {socket_board.url}" in capsys.readouterr().err
