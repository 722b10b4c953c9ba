"""Noise on the line moves nothing, crashes nothing, and is counted: against the host's reader.

SOFTGRIP_FUZZ=1000000 in the environment makes it the full million of frames, about three minutes.
"""

import os
import random

import pytest

from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.protocol import COUNTERS, ESTOP, HEARTBEAT, HELLO, SETPOINT, Flag
from tests.board.emulated import needs_emulator
from tests.board.host import Host

pytestmark = needs_emulator

FRAMES = int(os.environ.get("SOFTGRIP_FUZZ", "24000"))
AT_ONCE = 500


def damaged(chance):
    """Return one damaged frame: noise, flipped bits, cut, joined, or too long."""
    message = chance.choice([SETPOINT, HEARTBEAT, HELLO, ESTOP])
    payload = bytes(chance.randrange(256) for _ in range(message.layout.size))
    line = bytearray(encode(Frame(message.id, chance.randrange(256), payload)))
    kind = chance.randrange(5)
    if kind == 0:
        line = bytearray(chance.randrange(1, 256) for _ in range(chance.randrange(1, 30)))
    elif kind == 1:
        for bit in chance.sample(range(8 * len(line) - 8), chance.randint(1, 3)):
            line[bit // 8] ^= 1 << bit % 8
    elif kind == 2:
        del line[chance.randrange(1, len(line) - 1) :]
    elif kind == 3:
        del line[: chance.randrange(1, len(line) - 1)]
    else:
        line = bytearray(chance.randrange(1, 256) for _ in range(chance.randrange(50, 80)))
    return bytes(line.rstrip(b"\0")) + b"\0"


@pytest.mark.parametrize("part", range(4))
def test_noise_is_counted_and_never_acted_on(part):
    chance, reader = random.Random(part), FrameReader()
    host = Host(EmulatedBoard(position=10))
    host.home()
    before, steps = host.ask(COUNTERS), host.board.edges()[0].size
    accepted = []
    for _ in range(FRAMES // 4 // AT_ONCE):
        line = b"".join(damaged(chance) for _ in range(AT_ONCE))
        accepted += reader.feed(line)
        host.board.write(line)
        host.board.flush()
        host.listen()
    # What passes a 16-bit checksum by chance, in 65536, is nothing that could move the motor here.
    assert not [frame for frame in accepted if frame.id in (SETPOINT.id, HELLO.id, ESTOP.id)]
    after = host.ask(COUNTERS)
    wrong = (after["bad"] + after["overlong"] - before["bad"] - before["overlong"]) % 65536
    # As many as the host's own reader finds in the same bytes; the counters go round at 65536.
    assert wrong == reader.bad % 65536
    assert after["good"] - before["good"] == len(accepted) + 1
    assert reader.bad > 0.99 * FRAMES // 4
    assert host.board.edges()[0].size == steps
    host.run(0.1)
    assert host.flags & Flag.HOMED
    assert not host.flags & (Flag.MOVING | Flag.ESTOPPED)


def test_noise_is_no_sign_of_life():
    chance = random.Random(9)
    host = Host(EmulatedBoard(position=10))
    host.home()
    assert host.ask(SETPOINT, speed=256 * 100) is None
    heard = host.board.time
    host.board.write(b"".join(damaged(chance) for _ in range(1000)))
    host.board.advance(0.4)
    assert host.stopped_at() - heard < 0.201


def test_a_command_in_noise_is_heard():
    chance = random.Random(3)
    host = Host(EmulatedBoard(position=10))
    host.home()
    assert host.ask(SETPOINT, speed=256 * 100) is None
    host.board.write(b"".join(damaged(chance) for _ in range(20)) + chance.randbytes(9) + b"\0")
    host.say(ESTOP)
    host.board.advance(0.05)
    host.listen()
    host.run(0.05)
    assert host.flags & Flag.ESTOPPED
