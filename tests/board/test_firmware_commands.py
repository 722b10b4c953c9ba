"""The firmware's answers, on the emulated board in virtual time."""

import numpy as np
import pytest

from book.live.emulated import EMULATED_BITS
from softgrip.board import protocol
from softgrip.board.emulated.board import CLOCK, EmulatedBoard
from softgrip.board.firmware.header import build
from softgrip.board.framing import Frame, encode
from softgrip.board.protocol import HOME, SET_LIMITS, SETPOINT, SPEED_SCALE, Flag, Reason, SetUp
from tests.board.emulated import needs_emulator
from tests.board.host import Host
from tests.board.stub_board import HARD, LIMITS

pytestmark = needs_emulator


@pytest.fixture
def host():
    return Host(EmulatedBoard())


@pytest.fixture
def homed(host):
    host.home()
    return host


@pytest.mark.parametrize("set_up", SetUp)
def test_the_board_says_who_it_is(set_up):
    answer = Host(EmulatedBoard(set_up)).greet()
    hard = {f"hard_{name}": value for name, value in HARD.items()}
    assert answer == {
        **{"version": protocol.PROTOCOL_VERSION, "table": protocol.TABLE, "build": build()},
        **{"set_up": set_up, "reset_cause": protocol.ResetCause.POWER_ON, "valve": 0, "steps": 800},
        **LIMITS,
        **hard,
    }


def test_full_scale_pressure_bounds_are_what_they_mean():
    # 0.5 V + 4 V * p / 80 psi of 5 V = 1023 counts: by hand, 300 kPa and 200 kPa.
    for kilopascals, count in ((300, HARD["pressure"]), (200, LIMITS["pressure"])):
        assert (0.5 + 4 * kilopascals / 551.58) / 5 * 1023 == pytest.approx(count, abs=1)


@pytest.mark.parametrize(
    ("version", "table"), [(2, protocol.TABLE), (protocol.PROTOCOL_VERSION, protocol.TABLE ^ 1)]
)
def test_another_protocol_is_refused_and_moves_nothing(host, version, table):
    assert host.ask(protocol.HELLO, version=version, table=table) == Reason.WRONG_VERSION
    for message, values in ((SETPOINT, {"speed": -256}), (HOME, {}), (SET_LIMITS, LIMITS)):
        assert host.ask(message, **values) == Reason.NOT_GREETED
    host.run(0.3)
    assert host.board.edges()[0].size == 0


def test_the_pad_has_no_pump():
    host = Host(EmulatedBoard(SetUp.PAD), closed=False)
    host.greet()
    assert host.ask(SETPOINT, speed=-256) == Reason.NO_PUMP
    assert host.ask(HOME) == Reason.NO_PUMP
    assert host.ask(protocol.CLEAR) is None  # no pressure sensor that could be at fault
    host.run(0.3)
    assert host.flags == Flag.GREETED
    assert host.board.edges()[0].size == 0


@pytest.mark.parametrize("set_up", SetUp)
def test_telemetry_has_each_channel_at_40_hz(set_up):
    host = Host(EmulatedBoard(set_up), closed=False)
    counts = tuple(150 + 60 * k for k in range(len(protocol.CHANNELS)))
    for channel, count in enumerate(counts):
        host.board.set_count(channel, count)
    host.run(1.0)
    assert host.telemetry["channels"] == counts
    assert len(host.frames) == 1 / protocol.TELEMETRY_PERIOD
    assert np.unique(np.diff([frame["time"] for frame in host.frames])) == [25]
    assert np.unique(np.diff([frame["number"] for frame in host.frames])) == [1]


def test_a_channel_is_read_at_its_time_before_the_frame(host):
    # A step of all voltages in the middle between two samples splits the frame by channel.
    host.board.advance(0.1055 - host.board.time)
    for channel in range(len(protocol.CHANNELS)):
        host.board.set_count(channel, 900)
    host.board.advance(0.06)
    host.listen()
    after = next(frame for frame in host.frames if max(frame["channels"]) >= 900)
    edge = 105.5  # ms
    for k, count in enumerate(after["channels"]):
        ago = 0 if protocol.CHANNELS[k] == "pressure" else 13 - k if k < 9 else 14 - k
        assert (count == 900) == (after["time"] - ago > edge), protocol.CHANNELS[k]


def test_a_repeated_command_is_acknowledged_and_not_carried_out_again(homed):
    assert homed.ask(SETPOINT, speed=100 * SPEED_SCALE) is None
    assert homed.ask(SETPOINT, speed=0) is None
    homed.run(0.1)
    steps = homed.board.edges()[0].size
    again = homed._sequence
    assert homed.ask(SETPOINT, sequence=again, speed=100 * SPEED_SCALE) is None
    homed.run(0.1)
    assert homed.board.edges()[0].size == steps


def test_a_late_command_is_stale_and_skipped_ones_are_counted(homed):
    before = homed.ask(protocol.COUNTERS)
    now = homed._sequence
    late = (now - 3) % 256
    assert homed.ask(SETPOINT, sequence=late, speed=100 * SPEED_SCALE) == Reason.STALE
    assert homed.ask(protocol.HEARTBEAT, sequence=(now + 5) % 256) is None
    after = homed.ask(protocol.COUNTERS, sequence=(now + 6) % 256)
    assert (after["stale"] - before["stale"], after["lost"] - before["lost"]) == (1, 4)
    homed._sequence = (now + 6) % 256
    homed.run(0.2)
    assert not homed.flags & Flag.MOVING
    # The last number of a lap is followed by 0.
    for sequence in (100, 200, 255, 0, 1):
        assert homed.ask(protocol.HEARTBEAT, sequence=sequence) is None


@pytest.mark.parametrize("greeted", [True, False])
def test_an_emergency_stop_is_obeyed_whatever_its_number(host, greeted):
    if greeted:
        host.greet()
        host.run(0.2)
    assert host.ask(protocol.ESTOP, sequence=(host._sequence - 9) % 256) is None
    host.run(0.05)
    assert host.flags & Flag.ESTOPPED
    # And leaves the count of the others where it was; before HELLO a heartbeat is refused.
    assert host.ask(protocol.COUNTERS)["lost"] == (0 if greeted else 1)


@pytest.mark.parametrize(
    ("frame", "reason"),
    [
        (Frame(77, 1), Reason.UNKNOWN_MESSAGE),
        (Frame(protocol.TELEMETRY.id, 1, bytes(45)), Reason.UNKNOWN_MESSAGE),
        (Frame(SETPOINT.id, 1, bytes(3)), Reason.WRONG_LENGTH),
        (Frame(HOME.id, 1, b"\1"), Reason.WRONG_LENGTH),
    ],
)
def test_what_is_no_command_is_refused(host, frame, reason):
    host.greet()
    host.board.write(encode(frame))
    host.board.advance(0.005)
    (answer,) = host.listen()
    assert (answer.sequence, answer.payload) == (1, bytes((frame.id, reason)))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *((name, value + 1) for name, value in HARD.items()),
        *(("pressure", 109), ("position", -1), ("speed", 0), ("acceleration", 99), ("silence", 19)),
    ],
)
def test_limits_beyond_the_hard_bounds_are_refused_whole(host, name, value):
    host.greet()
    asked = {**dict.fromkeys(LIMITS, 0), "pressure": 200, "position": 100, "speed": 300}
    asked |= {"acceleration": 4000, "silence": 100, name: value}
    assert host.ask(SET_LIMITS, **asked) == Reason.HARD_BOUND
    assert {one: host.greet()[one] for one in LIMITS} == LIMITS


def test_limits_within_them_are_in_force(host):
    host.greet()
    asked = {"pressure": 547, "position": 12000, "speed": 1, "acceleration": 100, "silence": 20}
    assert host.ask(SET_LIMITS, **asked) is None
    told = host.greet()
    assert {one: told[one] for one in LIMITS} == asked
    assert host.ask(SETPOINT, speed=-SPEED_SCALE - 1) == Reason.SPEED_LIMIT


def test_limits_are_set_at_rest_only(homed):
    assert homed.ask(SETPOINT, speed=300 * SPEED_SCALE) is None
    homed.run(0.05)
    assert homed.ask(SET_LIMITS, **LIMITS) == Reason.MOVING


def test_the_valve_is_there_or_not(host):
    host.greet()
    assert host.ask(protocol.VENT, open=1) == Reason.NO_VALVE
    with_valve = Host(EmulatedBoard(valve=True))
    assert with_valve.greet()["valve"] == 1
    for is_open in (1, 0):
        assert with_valve.ask(protocol.VENT, open=is_open) is None
        with_valve.run(0.05)
        assert with_valve.board.valve_open == bool(is_open)
        assert bool(with_valve.flags & Flag.VALVE_OPEN) == bool(is_open)


def test_the_emulated_line_is_as_slow_as_the_book_says_and_telemetry_keeps_its_rate(host):
    host.board.advance(1.0)
    data, times = host.board.read_timed()
    cycles = np.rint(np.diff(times) * CLOCK)
    assert np.median(cycles) == EMULATED_BITS * CLOCK / protocol.BAUD
    # A frame begins after a pause. A timer of the chip says when, to the cycles of an interrupt;
    # so no rate that is judged hangs on how long a byte takes.
    begins = times[1:][cycles > 2 * np.median(cycles)]
    assert data.count(0) > 35
    assert np.diff(begins) == pytest.approx(protocol.TELEMETRY_PERIOD, abs=1e-6)
