"""The line to a board, over pseudo-terminals and sockets."""

import os
import socket
import time
from contextlib import suppress

import pytest

from softgrip.errors import InvalidInputError
from softgrip.rig.board_errors import ConnectionLostError, PortUnavailableError
from softgrip.rig.link import SerialLink


@pytest.fixture
def terminal():
    host, device = os.openpty()
    yield host, os.ttyname(device)
    for one in (host, device):
        with suppress(OSError):  # the test may have closed it
            os.close(one)


def test_bytes_go_both_ways(terminal):
    host, name = terminal
    link = SerialLink(name)
    link.write(b"\x01\x00\xff")
    assert os.read(host, 10) == b"\x01\x00\xff"
    os.write(host, b"\x02\x00\x0d\x0a")  # not a line discipline's business
    assert link.read(1.0) == b"\x02\x00\x0d\x0a"
    link.close()


def test_a_reading_waits_no_longer_than_told(terminal):
    link = SerialLink(terminal[1])
    begin = time.monotonic()
    assert link.read(0.05) == b""
    assert time.monotonic() - begin > 0.04  # that it comes back at all is the other bound
    link.close()


def test_a_second_host_is_refused(terminal):
    first = SerialLink(terminal[1])
    with pytest.raises(PortUnavailableError, match="another program"):
        SerialLink(terminal[1])
    first.close()
    SerialLink(terminal[1]).close()


def test_no_such_port():
    with pytest.raises(PortUnavailableError, match="ttyNONE"):
        SerialLink("/dev/ttyNONE")
    with pytest.raises(PortUnavailableError):
        SerialLink("carrier-pigeon://roof")
    with pytest.raises(InvalidInputError, match="url"):
        SerialLink("")


def test_a_peer_that_goes_is_a_lost_line():
    with socket.create_server(("127.0.0.1", 0)) as server:
        link = SerialLink(f"socket://127.0.0.1:{server.getsockname()[1]}")
        peer, _ = server.accept()
        peer.sendall(b"abc")
        found = b""
        while len(found) < 3:
            found += link.read(1.0)
        assert found == b"abc"
        peer.close()
        with pytest.raises(ConnectionLostError, match="lost"):
            link.read(1.0)
        link.close()
        link.close()


def test_a_closed_terminal_is_a_lost_line(terminal):
    host, name = terminal
    link = SerialLink(name)
    os.close(host)
    with pytest.raises(ConnectionLostError):
        link.read(0.05)
    with pytest.raises(ConnectionLostError):
        link.write(b"x")
    link.close()


def test_a_closed_link_is_a_lost_line(terminal):
    link = SerialLink(terminal[1])
    link.close()
    with pytest.raises(ConnectionLostError):
        link.write(b"x")
    with pytest.raises(ConnectionLostError):
        link.read(0.01)
