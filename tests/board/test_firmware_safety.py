"""What the board does when host or program fail; times are virtual."""

import random

import numpy as np
import pytest

from softgrip.board.emulated.board import PRESSURE, EmulatedBoard, Switch
from softgrip.board.protocol import (
    CLEAR,
    COUNTERS,
    ESTOP,
    HEARTBEAT,
    HOME,
    SET_LIMITS,
    SETPOINT,
    SPEED_SCALE,
    Flag,
    Reason,
    ResetCause,
)
from tests.board.emulated import needs_emulator
from tests.board.host import PHASES, Host

pytestmark = needs_emulator

FAST = 4000 * SPEED_SCALE


@pytest.mark.parametrize("phase", PHASES)
def test_a_silent_host_stops_the_motor(pushing, phase):
    pushing.board.advance(phase)
    pushing.ask(HEARTBEAT)
    heard = pushing.board.time
    pushing.run(0.5, beat=False)
    # `ask` returns within 2 ms of the frame's arrival.
    assert 0.197 < pushing.stopped_at() - heard <= 0.201
    pushing.run(0.1)  # heartbeats again
    assert not pushing.flags & (Flag.HOST_SILENT | Flag.MOVING)
    assert pushing.ask(SETPOINT, speed=FAST) is None


def test_any_valid_frame_is_a_sign_of_life(pushing):
    for _ in range(3):
        for message in (HEARTBEAT, COUNTERS):
            pushing.ask(message)
            pushing.run(0.15, beat=False)
    assert pushing.flags & Flag.MOVING


@pytest.mark.parametrize("phase", PHASES)
def test_an_emergency_stop_takes_less_than_a_millisecond(pushing, phase):
    pushing.board.advance(phase)
    pushing.say(ESTOP)
    said = pushing.board.time
    pushing.run(0.3)
    assert pushing.stopped_at() - said < 1e-3
    for message, values in ((SETPOINT, {"speed": -256}), (SETPOINT, {"speed": 256}), (HOME, {})):
        assert pushing.ask(message, **values) == Reason.ESTOPPED
    assert pushing.ask(CLEAR) is None
    assert pushing.flags & Flag.ESTOPPED  # as last told
    pushing.run(0.1)
    assert not pushing.flags & (Flag.ESTOPPED | Flag.MOVING)
    assert pushing.ask(SETPOINT, speed=256) is None


@pytest.mark.parametrize("interrupts", [True, False])
@pytest.mark.parametrize("phase", PHASES)
def test_a_program_that_hangs_stops_the_motor_and_starts_anew(pushing, interrupts, phase):
    pushing.board.advance(phase)
    hung = pushing.board.time
    place = pushing.board.position
    pushing.board.hang(interrupts=interrupts)
    pushing.run(0.3)
    # The lease of 12 steps at 4000 step/s.
    assert pushing.stopped_at() - hung < 3.1e-3
    assert pushing.board.position - place <= 12
    assert pushing.frames[-1]["time"] < 60  # ms: the watchdog takes 250 of the 300
    assert pushing.flags & (Flag.HOMED | Flag.GREETED | Flag.MOVING) == 0
    assert pushing.ask(SETPOINT, speed=256) == Reason.NOT_GREETED
    assert pushing.greet()["reset_cause"] == ResetCause.WATCHDOG
    assert pushing.ask(SETPOINT, speed=256) == Reason.NOT_HOMED


def test_a_board_without_power_forgets(pushing):
    pushing.board.power_cycle()
    pushing.run(0.1)
    assert pushing.flags & (Flag.HOMED | Flag.GREETED | Flag.MOVING) == 0
    assert pushing.greet()["reset_cause"] == ResetCause.POWER_ON
    assert pushing.ask(SETPOINT, speed=256) == Reason.NOT_HOMED


def test_a_host_that_begins_anew_begins_at_rest(pushing):
    pushing.greet()
    pushing.run(0.3)
    assert not pushing.flags & Flag.MOVING


def test_a_refused_speed_brings_the_motor_to_rest(pushing):
    assert pushing.ask(SETPOINT, speed=FAST + 1) == Reason.SPEED_LIMIT
    pushing.run(0.2)
    assert not pushing.flags & Flag.MOVING


@pytest.mark.parametrize("seed", range(6))
def test_whatever_the_host_says_the_limits_hold(seed):
    chance = random.Random(seed)
    host = Host(EmulatedBoard(position=20), closed=False)
    host.home()
    limit, speed = 700, 2500
    assert host.ask(
        SET_LIMITS, pressure=300, position=limit, speed=speed, acceleration=20000, silence=100
    ) is None  # fmt: skip
    choices = [
        *[(SETPOINT, lambda: {"speed": chance.randint(-3000, 3000) * SPEED_SCALE})] * 8,
        *[(HEARTBEAT, dict), (HOME, dict), (CLEAR, dict), (ESTOP, dict)],
    ]
    high_since, pushes = np.inf, []
    for _ in range(250):
        message, values = chance.choice(choices)
        host.say(message, **values())
        if chance.random() < 0.15:
            high = chance.random() < 0.5
            host.board.set_count(PRESSURE, 350 if high else chance.randint(120, 250))
            if high and high_since == np.inf:
                high_since = host.board.time
            elif not high and high_since < np.inf:
                pushes.append((high_since + 3e-3, host.board.time))
                high_since = np.inf
        host.board.advance(chance.expovariate(1 / 0.04))
        host.listen()
    times, ways = host.board.edges()
    assert times.size > 100
    assert pushes
    assert (20 + ways.cumsum()).max() <= limit
    assert np.diff(times).min() >= 1 / speed - 1e-6
    for start, end in pushes:
        assert not ((times > start) & (times < end) & (ways > 0)).any()


def test_the_switch_ends_drawing_back_even_without_a_position():
    host = Host(EmulatedBoard(position=100))
    host.greet()
    assert host.ask(SETPOINT, speed=-1000 * SPEED_SCALE) is None
    host.run(0.5)
    assert -5 <= host.board.position <= 0  # one tick of 1 ms at 1000 step/s
    host.board.set_switch(Switch.WORKS)
    assert host.ask(SETPOINT, speed=-1000 * SPEED_SCALE) == Reason.POSITION_LIMIT
