"""Frames survive the line, and damaged ones do not."""

import binascii

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.board.framing import LARGEST, Frame, FrameReader, checksum, decode, encode

bytes_of_frame = st.binary(max_size=LARGEST - 4)
frames = st.builds(Frame, st.integers(0, 255), st.integers(0, 255), bytes_of_frame)


def test_the_checksum_is_that_of_the_catalogue():
    # The check value of CRC-16/CCITT-FALSE (also IBM-3740), and the definition bit by bit.
    assert checksum(b"123456789") == 0x29B1
    register = 0xFFFF
    for byte in b"softgrip":
        register ^= byte << 8
        for _ in range(8):
            register = (register << 1 ^ (0x1021 if register & 0x8000 else 0)) & 0xFFFF
    assert checksum(b"softgrip") == register
    assert checksum(b"softgrip") != binascii.crc_hqx(b"softgrip", 0)


@given(st.lists(frames, max_size=5), st.data())
def test_frames_come_through_in_pieces(sent, data):
    line = b"".join(encode(frame) for frame in sent)
    reader, found = FrameReader(), []
    while line:
        size = data.draw(st.integers(1, len(line)))
        found += reader.feed(line[:size])
        line = line[size:]
    assert found == sent
    assert (reader.good, reader.bad, reader.lost) == (len(sent), 0, 0)


@given(frames)
def test_only_the_end_is_zero(frame):
    line = encode(frame)
    assert line.count(0) == 1
    assert line[-1] == 0
    assert len(line) == 4 + len(frame.payload) + 2


@pytest.mark.parametrize("payload", [b"", bytes(45), bytes(range(45)), b"\xff" * 45])
def test_no_single_flipped_bit_gets_through(payload):
    frame = Frame(132, 7, payload)
    line = encode(frame)
    for bit in range(8 * len(line)):
        damaged = bytearray(line)
        damaged[bit // 8] ^= 1 << bit % 8
        reader = FrameReader()
        # What comes next is whole again, but for a frame whose end was lost.
        found = reader.feed(bytes(damaged) + b"\0" + line)
        assert found == [frame]
        assert reader.bad >= 1


@settings(max_examples=300)
@given(frames, st.data())
def test_a_cut_frame_is_thrown_away_and_counted(frame, data):
    line = encode(frame)
    cut = line[: data.draw(st.integers(1, len(line) - 2))]
    reader = FrameReader()
    # The end of a COBS block may leave a whole, shorter frame, whose checksum then is wrong.
    assert reader.feed(cut + b"\0") == [] or decode(cut) is not None
    assert reader.good + reader.bad == 1


def test_noise_is_counted_and_takes_no_memory():
    reader = FrameReader()
    assert reader.feed(b"\x55" * 100_000) == []
    assert len(reader._begun) <= LARGEST + 2
    frame = Frame(3, 1)
    assert reader.feed(b"\0" + encode(frame)) == [frame]
    assert (reader.good, reader.bad, reader.lost) == (1, 1, 100_000)


@pytest.mark.parametrize("line", [b"\0\0\0", b""])
def test_nothing_between_two_ends_is_no_damage(line):
    reader = FrameReader()
    assert reader.feed(line) == []
    assert reader.bad == 0


@pytest.mark.parametrize("stuffed", [b"", b"\x01", b"\x05\x01\x02", b"\x02\x03\x02\x00"])
def test_what_is_no_frame_is_none(stuffed):
    assert decode(stuffed) is None
