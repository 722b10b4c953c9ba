"""The emulated board as others use it: repeatable, behind a driver, behind a terminal."""

import numpy as np
import pytest

from softgrip.board.driver import Board
from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.emulated.link import EmulatedFingers, emulated_finger, finger, gripper
from softgrip.board.emulated.terminal import Terminal
from softgrip.board.firmware.config import STEPS
from softgrip.board.protocol import CHANNELS, SETPOINT
from softgrip.units import REV
from tests.board.emulated import needs_emulator
from tests.board.host import Host

pytestmark = needs_emulator


def test_two_runs_are_the_same_to_the_cycle():
    runs = []
    for _ in range(2):
        host = Host(EmulatedBoard(position=50))
        host.home()
        host.ask(SETPOINT, speed=256 * 1234)
        host.run(0.5)
        runs.append((host.frames, host.board.edges()[0].tolist()))
    assert runs[0] == runs[1]
    assert len(runs[0][1]) > 500


@pytest.mark.parametrize("count", [0, 1, 102, 511, 1022, 1023])
def test_a_count_reads_as_itself(count):
    host = Host(EmulatedBoard(), closed=False)
    for channel in range(len(CHANNELS)):
        host.board.set_count(channel, count)
    host.run(0.1)
    assert set(host.telemetry["channels"]) == {count}


def test_the_emulated_rig_moves_as_the_simulated_one():
    speed = 8.0  # rad/s
    with emulated_finger() as rig:
        rig.home()
        homed_in = rig.time
        seen = [rig.advance(speed) for _ in range(80)]
        pushed_in = rig.time - homed_in
        truth = rig.session.link.plant.truth
        assert rig.info.bounds.speed == pytest.approx(5 * REV)
        assert STEPS == 800 == rig.scale.steps
    # The same plunger without a board: drawn out, and pushed as far in the same times.
    alone = finger(position=200)
    advance = alone.parameters.pump.advance
    for travel, time in ((-200 * REV / STEPS, homed_in), (truth.plunger[0] / advance, pushed_in)):
        periods = round(time / alone.period)
        felt = [alone.advance(travel / periods / alone.period) for _ in range(periods)]
    assert truth.plunger[0] / advance == pytest.approx(speed * 2.0, rel=0.02)
    assert truth.angle[0, 0] == pytest.approx(alone.truth.angle[0, 0], rel=0.01)
    # The mean of 0.2 s, of which the board gives 8 readings with a noise of 2 deg.
    told, alone_told = (np.mean([np.ravel(one.angle)[0] for one in part]) for part in (
        seen[-8:], felt[-40:]
    ))  # fmt: skip
    assert told == pytest.approx(alone_told, abs=0.06)


def test_a_gripper_has_two_fingers():
    link = EmulatedFingers(gripper())
    with Board(link, fingers=2, emulated=True) as rig:
        rig.home()
        # At rest in the end, since the flex sensors lag.
        seen = np.mean([rig.advance(3.0 * (k < 60)).angle for k in range(160)][-8:], axis=0)
        left, right = link.plant.truth.angle[:, 0]
    assert left > right > 0.2  # the left finger is the softer one
    assert seen[:, 0] == pytest.approx([left, right], abs=0.1)


def test_pyserial_opens_it():
    # Real time: what is asserted is that it works, not how fast on a busy machine.
    with Terminal(EmulatedFingers()) as port, Board(port, emulated=True) as rig:
        rig.home()
        first, last = rig.advance(5.0), rig.advance(5.0)
        assert last.time > first.time
        assert rig.telemetry.channels[CHANNELS.index("pressure")] > 50
