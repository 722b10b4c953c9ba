"""What the board does when the pressure or its sensor is not as it should be; times are virtual."""

import pytest

from softgrip.board.emulated.board import PRESSURE
from softgrip.board.protocol import CLEAR, SETPOINT, SPEED_SCALE, Flag, Reason
from tests.board.emulated import needs_emulator
from tests.board.host import PHASES

pytestmark = needs_emulator


def may_draw(host):
    """Whether the plunger can be drawn back."""
    before = host.board.position
    assert host.ask(SETPOINT, speed=-400 * SPEED_SCALE) is None
    host.run(0.1)
    host.ask(SETPOINT, speed=0)
    host.run(0.05)
    return host.board.position < before


@pytest.mark.parametrize("phase", PHASES)
def test_over_pressure_stops_pushing_and_allows_drawing_back(pushing, phase):
    pushing.board.advance(phase)
    pushing.closed = False
    pushing.board.set_count(PRESSURE, 399)
    risen = pushing.board.time
    pushing.run(0.1)
    assert pushing.stopped_at() - risen < 3e-3
    assert pushing.flags & Flag.OVER_PRESSURE
    assert pushing.ask(SETPOINT, speed=256) == Reason.OVER_PRESSURE
    assert may_draw(pushing)
    # Released below the limit only, and not by itself.
    for count, blocked in ((395, True), (390, False)):
        pushing.board.set_count(PRESSURE, count)
        pushing.run(0.05)
        assert bool(pushing.flags & Flag.OVER_PRESSURE) == blocked
    stopped = pushing.stopped_at()
    pushing.run(0.2)
    assert pushing.stopped_at() == stopped
    assert pushing.ask(SETPOINT, speed=256) is None


def test_a_spark_stops_nothing(pushing):
    pushing.closed = False
    pushing.board.set_count(PRESSURE, 1000)
    pushing.board.advance(0.9e-3)  # one sample, or none
    pushing.board.set_count(PRESSURE, 200)
    pushing.run(0.05)
    assert pushing.flags & Flag.MOVING
    assert not pushing.flags & (Flag.OVER_PRESSURE | Flag.SENSOR_RANGE)


@pytest.mark.parametrize("volts", [0.0, 0.24, 4.76, 5.0])
def test_a_sensor_out_of_its_range_stops_pushing(pushing, volts):
    pushing.closed = False
    pushing.board.set_volts(PRESSURE, volts)
    broken = pushing.board.time
    pushing.run(0.1)
    assert pushing.stopped_at() - broken < 3e-3
    assert pushing.flags & Flag.SENSOR_RANGE
    assert pushing.ask(SETPOINT, speed=256) == Reason.SENSOR_FAULT
    assert may_draw(pushing)
    assert pushing.ask(CLEAR) == Reason.STILL_FAULTY
    pushing.board.set_count(PRESSURE, 150)
    pushing.run(0.05)
    assert pushing.ask(SETPOINT, speed=256) == Reason.SENSOR_FAULT  # latched
    assert pushing.ask(CLEAR) is None
    assert pushing.ask(SETPOINT, speed=256) is None


@pytest.mark.parametrize("count", [110, 300])
@pytest.mark.parametrize("noise", [0, 1])
def test_a_sensor_that_does_not_follow_the_plunger_stops_pushing(pushing, count, noise):
    # Stuck, its tube off, or its wire floating at what it last was; a count of noise hides nothing.
    pushing.closed = False
    pushing.board.set_count(PRESSURE, count)
    pushing.run(0.02)
    begun = pushing.board.position
    for k in range(30):
        pushing.board.set_count(PRESSURE, count + noise * (k % 2))
        pushing.run(0.01)
    assert pushing.flags & Flag.SENSOR_STUCK
    assert pushing.board.position - begun <= 400
    assert pushing.ask(SETPOINT, speed=256) == Reason.SENSOR_FAULT
    assert may_draw(pushing)
    assert pushing.ask(CLEAR) is None
    assert pushing.ask(SETPOINT, speed=256) is None
