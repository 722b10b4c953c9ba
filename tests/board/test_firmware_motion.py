"""The motor as the firmware drives it, by the edges on the emulated board's pins."""

import numpy as np
import pytest

from softgrip.board.emulated.board import EmulatedBoard, Switch
from softgrip.board.protocol import HOME, SET_LIMITS, SETPOINT, SPEED_SCALE, Flag, Reason
from tests.board.emulated import needs_emulator
from tests.board.host import Host
from tests.board.stub_board import LIMITS

pytestmark = needs_emulator

TICK = 0.5e-6
"""Of the timer that makes STEP, s."""


def host(**board):
    return Host(EmulatedBoard(**board))


def homed(**limits):
    found = host(position=20)
    found.home()
    if limits:
        assert found.ask(SET_LIMITS, **(LIMITS | limits)) is None
    return found


def turn(host, speed, seconds):
    assert host.ask(SETPOINT, speed=round(speed * SPEED_SCALE)) is None
    host.run(seconds)


def edges_after(host, start):
    times, ways = host.board.edges()
    return times[times > start], ways[times > start]


@pytest.mark.parametrize(
    ("speed", "seconds"), [(0.8, 4.0), (1.0, 3.1), (37.0, 0.5), (400.0, 0.3), (3999.5, 0.5)]
)
def test_the_rate_is_exact(speed, seconds):
    found = homed()
    turn(found, speed, seconds)
    times, _ = found.board.edges()
    # Periods are cut to ticks of the timer; the emulator adds a cycle of 1/16 us.
    exact = SPEED_SCALE / round(speed * SPEED_SCALE)
    assert times[-1] - times[-2] == pytest.approx(exact, abs=TICK + 2e-7)


def test_too_slow_a_speed_is_rest():
    found = homed()
    before = found.board.edges()[0].size
    turn(found, 0.2, 1.0)
    assert found.board.edges()[0].size == before


def test_position_is_what_was_stepped():
    found = homed()
    for speed in (2000, -1500, 3000, -100, 700):
        turn(found, speed, 0.3)
    turn(found, 0, 0.3)
    assert found.telemetry["position"] == found.board.position
    assert found.board.edges()[1].sum() == found.board.position - 20


@pytest.mark.parametrize(("speed", "acceleration"), [(4000, 40000), (1000, 5000)])
def test_speed_and_acceleration_stay_within_their_limits(speed, acceleration):
    found = homed(speed=speed, acceleration=acceleration, position=6000)
    start = found.board.time
    # Up, against it through rest, and to an end of the stroke.
    for wanted, seconds in ((speed, 0.6), (-speed, 0.3), (speed, 3.0)):
        turn(found, wanted, seconds)
    times, ways = edges_after(found, start)
    gaps = np.diff(times)
    assert gaps.min() >= 1 / speed - TICK - 2e-7
    # The speed of each pair of edges holds somewhere between them; it is changed at ticks of 1 ms.
    speeds, middles = ways[1:] / gaps, (times[1:] + times[:-1]) / 2
    same = ways[1:] == ways[:-1]
    speeds, middles, gaps = speeds[same], middles[same], gaps[same]
    for apart in (1, 5, 20, 80):
        change = np.abs(speeds[apart:] - speeds[:-apart])
        within = middles[apart:] - middles[:-apart] + (gaps[apart:] + gaps[:-apart]) / 2 + 1e-3
        rounding = (speeds[apart:] ** 2 + speeds[:-apart] ** 2) * (TICK + 2e-7)
        assert (change <= acceleration * within + rounding).all()
    # And it is used: full speed is reached in little more than the least time.
    reached = times[1:][np.diff(times) <= 1.01 / speed][0]
    assert reached - times[0] == pytest.approx(speed / acceleration, rel=0.1)


@pytest.mark.parametrize("limit", [0, 1, 777])
def test_the_ends_of_the_stroke_are_never_passed(limit):
    found = homed(position=limit)
    found.run(0.1)
    if limit:
        turn(found, 4000, 1.5)
        # Braked for: two steps before the end, v**2 = 2 a d gives 400 step/s; a tick of 1 ms, 40.
        assert np.diff(found.board.edges()[0])[-1] > 1 / 440
    assert found.board.position == limit
    assert found.flags & Flag.POSITION_LIMIT
    assert found.ask(SETPOINT, speed=SPEED_SCALE) == Reason.POSITION_LIMIT
    if limit:
        turn(found, -4000, 1.5)
    assert found.board.position == 0
    assert found.ask(SETPOINT, speed=-SPEED_SCALE) == Reason.POSITION_LIMIT
    assert found.board.edges()[1].cumsum().max() + 20 <= max(limit, 20)


def test_homing_is_needed_to_push_and_not_to_draw():
    found = host(position=500)
    found.greet()
    assert found.ask(SETPOINT, speed=SPEED_SCALE) == Reason.NOT_HOMED
    turn(found, -100, 0.3)
    assert found.board.position < 500
    assert not found.flags & Flag.HOMED


@pytest.mark.parametrize("position", [600, 1, 0, -30])
def test_homing_finds_the_switch(position):
    found = host(position=position)
    found.home()
    assert found.telemetry["position"] == found.board.position == 0
    way = found.board.edges()[1]
    # On the switch it is left first, and then drawn back on.
    assert (way[0] > 0) == (position <= 0)


def homing_with(switch, seconds):
    found = host(position=600)
    found.board.set_switch(switch)
    found.greet()
    assert found.ask(HOME) is None
    found.run(seconds)
    assert found.flags & Flag.SWITCH_FAULT
    return found


def test_a_switch_that_never_opens_is_not_believed():
    found = homing_with(Switch.BROKEN, 2.0)
    assert not found.flags & Flag.HOMED
    assert found.board.position <= 600 + 400
    assert found.ask(SETPOINT, speed=SPEED_SCALE) == Reason.NOT_HOMED


def test_a_switch_that_never_closes_ends_the_search():
    found = homing_with(Switch.SHORTED, 33.0)  # the longest stroke and a little, at 400 step/s
    assert not found.flags & (Flag.HOMED | Flag.HOMING)
    assert found.ask(HOME) == Reason.SENSOR_FAULT


def test_a_switch_where_none_is_ends_trust_in_the_position():
    found = homed()
    turn(found, 2000, 0.6)
    assert found.board.position > 401
    found.board.set_switch(Switch.BROKEN)
    broken = found.board.time
    found.run(0.1)
    assert found.flags & Flag.SWITCH_FAULT
    assert not found.flags & Flag.HOMED
    assert found.stopped_at() - broken < 4e-3
    assert found.ask(SETPOINT, speed=SPEED_SCALE) == Reason.NOT_HOMED


def test_homing_is_not_disturbed_by_a_speed():
    found = host(position=300)
    found.greet()
    assert found.ask(HOME) is None
    assert found.ask(SETPOINT, speed=-SPEED_SCALE) == Reason.MOVING
    found.run(1.2)
    assert found.flags & Flag.HOMED


def test_homing_twice_is_homing():
    found = homed()
    found.home()
    assert found.board.position == 0
