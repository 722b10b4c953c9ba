"""One suite for all back ends: what a script can rely on whatever it drives.

The board itself is tested where SOFTGRIP_RIG_PORT names its port; its motor then turns.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
import pytest

from softgrip.board.driver import Board
from softgrip.board.emulated.build import missing
from softgrip.board.errors import CommandRefusedError
from softgrip.board.protocol import Flag
from softgrip.errors import InvalidInputError
from softgrip.logs.fingers import column
from softgrip.logs.reader import read_log
from softgrip.provenance import Provenance, data_folder
from softgrip.rig.connect import connect
from softgrip.rig.record import record
from softgrip.rig.simulated import SimulatedRig
from softgrip.simulator.simulation import Simulation
from tests.board.stub_board import StubBoard
from tests.simulator.rigs import design_1, printed_gripper

PORT = os.environ.get("SOFTGRIP_RIG_PORT", "")
SPEED = 6.0  # rad/s
LOW = 6e3  # Pa, of the about 10 kPa that bend the finger by 60 deg


@dataclass
class BackEnd:
    """How to open one, what its logs say, and how fast its motor turns (None if unknowable)."""

    open: Callable
    low: Callable  # the same, with a low limit of pressure
    back_end: str
    provenance: Provenance
    speed: Callable = field(default=lambda rig: None)
    tolerance: float = 1e-9  # s, of the period


def stub_rig():
    return Board(StubBoard())


def emulated_rig(where):
    if missing():
        pytest.skip(f"the emulated board needs: apt install {missing()}")
    return connect(where)


def lowered(open_rig):
    def open_low():
        rig = open_rig()
        rig.set_limits(replace(rig.info.limits, pressure=LOW))
        return rig

    return open_low


def low_finger():
    return SimulatedRig(Simulation(design_1()), pressure_limit=LOW)


def low_gripper():
    return SimulatedRig(Simulation(printed_gripper(), period=0.1), pressure_limit=LOW)


def no_limit():
    pytest.skip("a replay has no pressure of its own")


def the_board():
    return connect(PORT)


def true_speed(rig):
    return float(rig.rig.truth.motor_speed[0])


def told_speed(rig):
    return rig.telemetry.speed


SIMULATED = Provenance.SIMULATED
REPLAYED = f"replay:{data_folder() / 'simulated/pid-full.csv'}"
BACK_ENDS = {
    "simulated": BackEnd(
        lambda: connect("simulated"), low_finger, "simulated rig", SIMULATED, true_speed
    ),
    "simulated gripper": BackEnd(
        lambda: connect("simulated:gripper"), low_gripper, "simulated rig", SIMULATED, true_speed
    ),
    "replay": BackEnd(lambda: connect(REPLAYED), no_limit, "replay", SIMULATED),
    "stub board": BackEnd(
        stub_rig, lowered(stub_rig), "emulated board", SIMULATED, told_speed, 1e-6
    ),
    **{
        where: BackEnd(
            partial(emulated_rig, where),
            lowered(partial(emulated_rig, where)),
            "emulated board",
            SIMULATED,
            told_speed,
            1e-6,
        )
        for where in ("emulated", "emulated:gripper")
    },
    "board": BackEnd(the_board, lowered(the_board), "board", Provenance.LOGGED, told_speed, 0.03),
}


@pytest.fixture(params=BACK_ENDS)
def back_end(request):
    if request.param == "board" and not PORT:
        pytest.skip("needs a rig: SOFTGRIP_RIG_PORT")
    return BACK_ENDS[request.param]


@pytest.fixture
def rig(back_end):
    with back_end.open() as opened:
        yield opened


@pytest.fixture
def homed(rig):
    rig.home()
    return rig


def test_a_measurement_has_one_pressure_and_an_angle_a_finger(homed):
    for found in (homed.measure(), homed.advance(SPEED)):
        assert found.pressure.shape == found.pressure_counts.shape == (1,)
        assert found.angle.shape == found.angle_counts.shape == (homed.fingers, 1)
        assert found.pressure_counts.dtype.kind == found.angle_counts.dtype.kind == "i"
        assert np.isfinite(found.pressure).all()
        assert np.isfinite(found.angle).all()


def test_a_sample_comes_each_period(homed, back_end):
    times = [float(homed.advance(SPEED).time) for _ in range(8)]
    assert np.diff(times) == pytest.approx(homed.period, abs=back_end.tolerance)


def test_measuring_takes_the_last_sample(homed):
    last = homed.advance(0.0)
    if not PORT:
        assert homed.measure().time == last.time


def test_a_push_before_homing_is_refused(rig):
    if isinstance(rig, Board) and rig.telemetry.flags & Flag.HOMED:
        pytest.skip("this port does not reset its board, which was homed before")
    with pytest.raises(CommandRefusedError, match="hom"):
        rig.advance(SPEED)
    rig.advance(0.0)


def test_the_motor_turns_and_stops(homed, back_end):
    for _ in range(4):
        homed.advance(SPEED)
    if back_end.speed(homed) is not None:
        assert back_end.speed(homed) > 0
    homed.stop()
    homed.advance(0.0)
    assert back_end.speed(homed) in (0, None)


def test_over_pressure_holds_a_push_back_and_allows_to_retract(back_end):
    with back_end.low() as rig:
        rig.home()
        words = ""
        for _ in range(400):
            rig.advance(3 * SPEED)
            words += rig.take_event()
            if "held back: over pressure" in words:
                break
        assert "held back: over pressure" in words
        for _ in range(4):
            rig.advance(-SPEED)
        assert back_end.speed(rig) < 0


def test_an_emergency_stop_is_latched(homed, back_end):
    homed.advance(SPEED)
    homed.emergency_stop()
    for _ in range(2):
        with pytest.raises(CommandRefusedError, match=r"emergency|estop"):
            homed.advance(SPEED)
    with pytest.raises(CommandRefusedError):
        homed.advance(-SPEED)
    homed.stop()  # is no fault
    assert back_end.speed(homed) in (0, None)
    homed.clear()
    homed.home()
    homed.advance(SPEED)


@pytest.mark.parametrize("command", [np.nan, np.inf, [1.0, 2.0], []])
def test_a_command_is_one_finite_number(homed, command):
    with pytest.raises(InvalidInputError, match="command"):
        homed.advance(command)


def test_a_command_beyond_the_limit_is_cut(homed):
    homed.advance(1e6)
    homed.advance(-1e6)


@pytest.mark.parametrize("error", [None, RuntimeError, KeyboardInterrupt])
def test_the_motor_is_at_rest_afterwards(back_end, error):
    opened = back_end.open()

    def run():
        with opened as rig:
            rig.home()
            for _ in range(4):
                rig.advance(SPEED)
            if error is not None:
                raise error

    if error is None:
        run()
    else:
        with pytest.raises(error):
            run()
    assert back_end.speed(opened) in (0, None)


def test_the_header_says_what_it_is(homed, back_end):
    header = homed.header()
    assert (header.back_end, header.provenance) == (back_end.back_end, back_end.provenance)
    assert header.period == homed.period


def test_a_recording_can_be_read(homed, back_end, tmp_path):
    path = tmp_path / "log.csv"
    duration = 20 * homed.period
    made = record(homed, [SPEED] * 10, duration, path, shows="a push", reference=None)
    log = read_log(path)
    assert made.samples == log["time"].size == 21
    assert (made.log_failure, made.reconnections, log.repairs) == ("", (), ())
    assert log.header.back_end == back_end.back_end
    assert log["time"] == pytest.approx(homed.period * np.arange(21), abs=30 * back_end.tolerance)
    assert log["command"].tolist() == [0.0] + [SPEED] * 10 + [0.0] * 10
    assert {column("angle", finger) for finger in range(homed.fingers)} <= set(log.columns)


def test_nothing_is_lost_or_reconnected(homed):
    for _ in range(10):
        homed.advance(0.0)
    assert "lost" not in homed.take_event()
    assert homed.take_event() == ""
