"""The driver of a board, against a stub that speaks the protocol."""

import time
from dataclasses import replace

import numpy as np
import pytest

from softgrip.board import errors
from softgrip.board.calibration import nominal
from softgrip.board.driver import HUNG_AFTER, Board
from softgrip.board.framing import Frame, encode
from softgrip.board.protocol import ACK, HOME, SETPOINT, TABLE, TELEMETRY_PERIOD, Flag
from softgrip.errors import InvalidInputError
from softgrip.simulator.simulation import Simulation
from softgrip.units import PSI, REV
from tests.board.stub_board import HARD, LIMITS, StubBoard
from tests.rig.test_live import until
from tests.simulator.rigs import design_1


def push_until(rig, event, samples=400):
    for _ in range(samples):
        rig.advance(4 * REV)
        if event in rig.take_event():
            return
    pytest.fail(f"no event {event!r}")


# The handshake.


def test_another_firmware_is_refused_and_what_to_flash_is_said():
    board = StubBoard(table=TABLE ^ 1)
    with pytest.raises(errors.VersionMismatchError, match=r"flash .*softgrip_rig\.ino"):
        Board(board)
    assert board.closed
    assert "setpoint" not in board.received


def test_nothing_that_answers_is_no_board(stub):
    stub.deaf = True
    with pytest.raises(errors.NoBoardError, match="flashed"):
        Board(stub)
    assert stub.closed


def test_a_board_that_is_still_in_its_boot_loader_is_waited_for(stub):
    stub.deaf, write = True, stub.write

    def later(data):
        stub.deaf = stub.now() < 1.5
        write(data)

    stub.write = later
    with Board(stub) as rig:
        assert rig.info.build == "00c0ffee"


def test_connecting_moves_nothing(stub):
    with Board(stub):
        assert "home" not in stub.received
        assert stub.speed == 0


def test_a_calibration_of_another_board_is_refused(stub):
    with pytest.raises(errors.WrongBoardError, match="calibrate this board"):
        Board(stub, calibration=replace(nominal(1), board="another"))
    with Board(StubBoard(), calibration=replace(nominal(1), board="build 00c0ffee")):
        pass


@pytest.mark.parametrize("changes", [{"period": 0.03}, {"period": 0.0}, {"fingers": 3}])
def test_arguments_out_of_range(stub, changes):
    with pytest.raises(InvalidInputError):
        Board(stub, **changes)


# Units.


def test_counts_become_pascals_and_radians(rig):
    found = rig.advance(0.0)
    # By hand: 80 psi over the 818.4 counts from 0.5 to 4.5 V of 5 V; 100 deg likewise.
    assert found.pressure == pytest.approx((found.pressure_counts - 102.3) * 80 * PSI / 818.4)
    assert found.angle == pytest.approx(np.radians((found.angle_counts - 102.3) * 100 / 818.4))


def test_a_speed_becomes_steps(rig, stub):
    rig.advance(REV)
    assert stub.speed == 800 * 256  # one turn of 800 steps, in 1/256 step


def test_a_longer_period_skips_telemetry(stub):
    with Board(stub, period=0.1) as rig:
        times = [rig.advance(0.0).time for _ in range(5)]
        assert np.diff(times) == pytest.approx(0.1, abs=1e-9)
        assert rig.session.lost == 0


def test_homing_that_is_broken_off_stops():
    board = StubBoard(rig=Simulation(design_1(), plunger=0.05))
    turned = []

    def interrupt():
        turned.append(board.rig.truth.plunger[0])
        if len(turned) == 20:
            raise KeyboardInterrupt

    with Board(board) as rig:
        sample = board._sample
        board._sample = lambda: (sample(), interrupt())
        with pytest.raises(KeyboardInterrupt):
            rig.home()
        assert turned[-1] < turned[0]
        board._sample = sample
        rig.stop()
        assert not board.flags & (Flag.HOMING | Flag.HOMED)
        place = board.rig.truth.plunger[0]
        rig.advance(0.0)
        assert board.rig.truth.plunger[0] == place > 0


def test_limits_are_told_and_set_in_si(rig, stub):
    limits = rig.info.limits
    assert limits.travel == pytest.approx(9000 / 800 * 8e-3)
    assert limits.speed == pytest.approx(5 * REV)
    now = rig.set_limits(replace(limits, pressure=100e3, speed=REV, travel=0.05, silence=0.1))
    assert (now.travel, now.speed, now.silence) == pytest.approx((0.05, REV, 0.1))
    assert 0 <= 100e3 - now.pressure < 80 * PSI / 818.4  # rounded to the safe side
    assert stub.limits["silence"] == 100
    rig.advance(5 * REV)
    assert stub.speed == 800 * 256  # cut to the new limit


def test_limits_beyond_the_bounds_are_refused(rig, stub):
    with pytest.raises(errors.CommandRefusedError, match="hard bound"):
        rig.set_limits(replace(rig.info.limits, travel=rig.info.bounds.travel + 1e-3))
    assert stub.limits == LIMITS
    assert rig.set_limits(rig.info.bounds) == rig.info.bounds
    assert stub.limits == HARD


# What happens under way.


def test_over_pressure_holds_a_push_back_and_allows_to_retract(rig, stub):
    rig.set_limits(replace(rig.info.limits, pressure=4e3))
    push_until(rig, "held back: over pressure")
    rig.advance(REV)
    assert stub.speed == 0
    rig.advance(-REV)
    assert stub.speed < 0


def test_lost_telemetry_is_counted_and_told(rig, stub):
    rig.take_event()
    stub.swallow = 3
    begin = rig.measure().time
    assert rig.advance(0.0).time == pytest.approx(begin + 4 * TELEMETRY_PERIOD)
    assert rig.session.lost == 3
    assert "telemetry lost: 3" in rig.take_event()
    assert "lost" not in rig.take_event()


def test_numbers_of_telemetry_go_round(rig, stub):
    stub.number = 65533
    rig.advance(0.0)
    rig.session.lost = 0
    for _ in range(6):
        rig.advance(0.0)
    assert rig.session.lost == 0


def test_an_answer_that_is_lost_is_asked_for_again(rig, stub):
    sent = len(stub.received)
    stub.deaf, write = True, stub.write

    def deaf_once(data):
        stub.write = write
        write(data)
        stub.deaf = False

    stub.write = deaf_once
    rig.advance(0.0)
    assert stub.received[sent:].count("setpoint") == 2


def test_homing_goes_on_though_its_answer_is_lost():
    board = StubBoard(rig=Simulation(design_1(), plunger=0.05))
    say, lost = board._say, []

    def losing(message, sequence, **values):
        if message is ACK and values["id"] == HOME.id and not lost:
            lost.append(sequence)
        else:
            say(message, sequence, **values)

    board._say = losing
    with Board(board) as rig:
        rig.home()
        assert rig.telemetry.flags & Flag.HOMED
    assert lost
    assert board.received.count("home") == 2


def test_a_board_that_falls_silent_is_a_typed_error_with_its_state(rig, stub):
    stub.deaf = True
    with pytest.raises(errors.NoAnswerError) as caught:
        rig.advance(0.0)
    assert (caught.value.port, caught.value.command) == ("stub", "setpoint")
    assert "homed" in caught.value.state
    assert isinstance(caught.value, errors.ConnectionLostError)
    stub.deaf = False


def test_noise_on_the_line_is_thrown_away(rig, stub):
    stub.out += (
        bytes(range(1, 60)) + b"\0" + encode(Frame(200, 0, b"what?")) + encode(Frame(130, 1))
    )
    rig.advance(0.0)
    assert rig.session.reader.bad == 1
    assert rig.session.lost == 0


def test_a_reset_of_the_board_is_seen_and_asks_for_homing(rig, stub):
    for _ in range(3):
        rig.advance(REV)
    stub.reset()
    with pytest.raises(errors.BoardResetError):
        rig.advance(REV)
    before = rig.measure().time
    rig.reconnect(5.0)
    assert rig.measure().time > before
    with pytest.raises(errors.CommandRefusedError, match="not homed"):
        rig.advance(REV)
    rig.home()
    rig.advance(REV)


def test_time_goes_on_over_a_reset_that_telemetry_tells(rig, stub):
    for _ in range(20):
        rig.advance(0.0)
    before, clock = rig.measure().time, stub.now()
    stub.reset()
    with pytest.raises(errors.BoardResetError):
        rig.listen()
    assert rig.measure().time == before
    rig.reconnect(5.0)
    assert rig.measure().time - before == pytest.approx(stub.now() - clock, abs=TELEMETRY_PERIOD)


def test_an_answer_that_came_before_a_fault_counts(rig, stub):
    handle = stub._handle

    def answer_and_begin_anew(frame):
        handle(frame)
        answer = stub.take()
        stub.reset()
        stub.elapse(TELEMETRY_PERIOD)
        stub.out[:0] = answer

    stub._handle = answer_and_begin_anew
    assert rig.session.ask(SETPOINT, speed=0) == {"id": SETPOINT.id}
    stub._handle = handle
    with pytest.raises(errors.BoardResetError):
        rig.listen()
    rig.reconnect(5.0)


def test_other_firmware_after_a_lost_line_is_refused(rig, stub):
    stub.build = 1
    with pytest.raises(errors.WrongBoardError):
        rig.reconnect(5.0)


def test_a_line_that_stays_lost_is_given_up(rig, stub):
    stub.pull(60.0)
    begin = stub.now()
    with pytest.raises(
        errors.ConnectionLostError, match=r"not found again in 2 s; at last: .*pulled"
    ):
        rig.reconnect(2.0)
    assert 2.0 <= stub.now() - begin < 2.5
    stub.pull(0.0)
    rig.reconnect(2.0)


# The heartbeat.


def test_the_heart_beats_while_nothing_is_asked(rig, stub):
    rig.session.wait(lambda: stub.now() > 3.0, 10.0, "time")
    assert not rig.telemetry.flags & Flag.HOST_SILENT


def test_a_program_that_hangs_does_not_keep_the_motor_turning(rig, stub):
    rig.advance(REV)
    begin = stub.now()
    rig.session.wait(lambda: stub.speed == 0, 5.0, "stop")
    # The lease of the command, the silence that the board allows, and the grain of the stub.
    assert stub.now() - begin < HUNG_AFTER + TELEMETRY_PERIOD + 0.2 + 0.06
    assert stub.flags & Flag.HOST_SILENT


# The way out.


def test_leaving_stops_vents_and_closes():
    board = StubBoard(valve=True)
    with Board(board) as rig:
        rig.home()
        assert not board.flags & Flag.VALVE_OPEN
        rig.advance(REV)
    assert board.speed == 0
    assert board.flags & Flag.VALVE_OPEN
    assert board.closed


def test_without_a_valve_nothing_is_vented(rig, stub):
    rig.vent(open_valve=True)
    assert "vent" not in stub.received


def test_the_first_error_is_the_one_told(stub):
    def run():
        with Board(stub) as rig:
            rig.home()
            stub.deaf = True
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run()
    assert stub.closed


def test_a_stop_that_is_not_heard_is_an_error(stub):
    with pytest.raises(errors.NoAnswerError), Board(stub):
        stub.deaf = True
    assert stub.closed


def test_counters_of_the_board(rig, stub):
    assert rig.counters()["good"] == len(stub.received)


# A real line, in real time.


def test_over_a_terminal(pty_board):
    name, board = pty_board
    with Board(name, emulated=True) as rig:
        rig.home()
        begin = time.monotonic()
        found = [rig.advance(REV) for _ in range(8)]
        # The first sample is the next one, at most a period away.
        assert time.monotonic() - begin > 0.17
        assert np.diff([one.time for one in found]).min() > 0
        with pytest.raises(errors.PortUnavailableError, match="another program"):
            Board(name)
        rig.stop()
        begin = board.now()
        until(lambda: board.now() > begin + 0.5)  # longer than the board's patience
        # The heart beats in the background; without it the board would stay as it is.
        until(lambda: not rig.telemetry.flags & Flag.HOST_SILENT)
        rig.advance(REV)
    assert board.speed == 0


def test_over_a_socket(socket_board):
    with Board(socket_board.url, emulated=True) as rig:
        rig.home()
        assert rig.advance(REV).pressure.shape == (1,)
        rig.advance(REV)
        # A program that hangs, its thread beating on.
        until(lambda: socket_board.board.flags & Flag.HOST_SILENT)
        assert socket_board.board.speed == 0
