"""The pad on a board: logged and checked, with the real firmware, emulated."""

import numpy as np
import pytest

from softgrip.board.driver import Rig
from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.emulated.link import EmulatedLink
from softgrip.board.protocol import SetUp
from softgrip.errors import InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.check import check
from softgrip.rig.record_pad import record_pad
from tests.board.emulated import needs_emulator

pytestmark = needs_emulator

COUNTS = [512 + 20 * k for k in range(len(PAD_CHANNELS))]


@pytest.fixture
def board():
    board = EmulatedBoard(SetUp.PAD)
    for channel, count in enumerate(COUNTS):
        board.set_count(channel, count)
    return board


def test_log_holds_the_nine_channels_at_40_hz(board, tmp_path):
    path = tmp_path / "pad.csv"
    with Rig(EmulatedLink(board), emulated=True) as rig:
        made = record_pad(rig, 1.0, path, shows="nothing")
        with pytest.raises(InvalidInputError, match="does not exist"):
            record_pad(rig, 1.0, path)
    log = read_log(path)
    assert (log.header.set_up, str(log.header.provenance)) == ("pad", "simulated")
    assert made.samples == log["time"].size == 41
    assert np.diff(log["time"]) == pytest.approx(0.025, abs=1e-6)
    for name, count in zip(PAD_CHANNELS, COUNTS, strict=True):
        assert set(log[f"{name}_counts"]) == {count}
        assert log[name] == pytest.approx(count * 5 / 1024)
    assert not log.repairs


def test_check_looks_at_the_pad_and_finds_a_dead_channel(board):
    board.set_count(3, 0)
    with Rig(EmulatedLink(board), emulated=True) as rig:
        found = {one.what: one for one in check(rig)}
    assert found["telemetry"].good
    assert {name for name in PAD_CHANNELS if not found[name].good} == {"element_4"}
