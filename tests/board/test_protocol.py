"""The table of messages."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.board import protocol
from softgrip.board.protocol import BAUD, CHANNELS, MESSAGES, SETPOINT, TELEMETRY, TELEMETRY_PERIOD
from softgrip.errors import InvalidInputError

BITS = {"B": (0, 8), "H": (0, 16), "I": (0, 32), "i": (-(2**31), 31)}


def values_of(message):
    def number(field):
        low, bits = BITS[field.code]
        one = st.integers(low, 2**bits - 1)
        return one if field.count == 1 else st.tuples(*[one] * field.count)

    return st.fixed_dictionaries({field.name: number(field) for field in message.fields})


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: message.name)
def test_what_is_packed_is_unpacked(message):
    @given(values_of(message))
    def check(values):
        payload = message.pack(**values)
        assert len(payload) == message.layout.size
        assert message.unpack(payload) == values

    check()


def test_bytes_are_little_endian_and_unpadded():
    assert SETPOINT.pack(speed=-2) == bytes.fromhex("feffffff")
    assert TELEMETRY.layout.size == 2 + 4 + 2 * 14 + 4 + 4 + 2 + 1


def test_each_id_is_one_message_and_tells_its_way():
    assert len({message.id for message in MESSAGES}) == len(MESSAGES)
    from_host = {message.name for message in MESSAGES if message.id < 128}
    assert from_host == {
        *("hello", "setpoint", "heartbeat", "estop", "clear", "home", "set_limits", "vent"),
        "counters",
    }


def test_the_channels_are_those_of_the_rig():
    assert len(CHANNELS) == 14
    assert CHANNELS.index("pressure") == 9  # after the nine of the pad


def test_telemetry_takes_less_than_a_quarter_of_the_line():
    assert (TELEMETRY.layout.size + 6) * 10 / TELEMETRY_PERIOD < BAUD / 4


def test_a_table_that_changes_is_another_version():
    # Raise PROTOCOL_VERSION when this fails, then note the new checksum.
    assert (protocol.PROTOCOL_VERSION, protocol.TABLE) == (1, 0x9EB5765D)


@pytest.mark.parametrize("values", [{}, {"speed": 1, "more": 2}, {"speed": 2**31}, {"speed": 0.5}])
def test_values_that_do_not_fit_are_refused(values):
    with pytest.raises(InvalidInputError, match="setpoint"):
        SETPOINT.pack(**values)


def test_a_payload_of_another_length_is_refused():
    with pytest.raises(InvalidInputError, match="4 bytes"):
        SETPOINT.unpack(b"\0\0\0")
