"""The line to a board, over pseudo-terminals and sockets."""

import os
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from softgrip.board.errors import ConnectionLostError, PortBusyError, PortUnavailableError
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.link import SerialLink
from softgrip.errors import InvalidInputError


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
    with pytest.raises(PortBusyError, match="another program"):
        SerialLink(terminal[1])
    first.close()
    SerialLink(terminal[1]).close()


# Who else has the port. The terminal's server is this process, with both ends of it; so a program
# that must not know of the server's own end runs in a process of its own.


def opens(name):
    """Whether a program that asks for no lock, and is not root's, can open a port."""
    Path(name).chmod(0o666)
    done = subprocess.run(
        ["sh", "-c", 'exec 3<>"$0"', name],
        capture_output=True, text=True, env={"LC_ALL": "C"},
        user=65534 if os.geteuid() == 0 else None,  # the kernel lets root open any port
    )  # fmt: skip
    assert done.returncode == 0 or "busy" in done.stderr
    return done.returncode == 0


def test_a_program_that_asks_for_no_lock_is_refused_as_long_as_the_port_is_open(terminal):
    assert opens(terminal[1])
    link = SerialLink(terminal[1])
    assert not opens(terminal[1])
    link.close()
    assert opens(terminal[1])
    link = SerialLink(terminal[1])
    assert not opens(terminal[1])
    del link  # dropped without being closed
    assert opens(terminal[1])


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="needs /proc, as of Linux")
def test_a_program_that_has_the_port_without_a_lock_is_found_and_named(terminal):
    has_it = ["sh", "-c", 'exec 3<>"$0"; echo; read end', terminal[1]]
    wants_it = "import sys; from softgrip.board.link import SerialLink; SerialLink(sys.argv[1])"
    with subprocess.Popen(has_it, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        other.stdout.readline()
        found = subprocess.run(
            [sys.executable, "-c", wants_it, terminal[1]], capture_output=True, text=True
        )
        other.stdin.close()
    assert f"PortBusyError: {terminal[1]}: another program has it" in found.stderr
    assert f"sh (process {other.pid}): close the port there" in found.stderr


FORKED = """
import os, sys
from softgrip.board.errors import PortUnavailableError
from softgrip.board.link import SerialLink

link = SerialLink(sys.argv[1])
if not (child := os.fork()):
    link.close()
    sys.exit()
os.waitpid(child, 0)
try:
    SerialLink(sys.argv[1])
except PortUnavailableError:
    print("a child that leaves takes no lock along")

reading, writing = os.pipe()
if not (child := os.fork()):
    os.close(writing)
    os.read(reading, 1)  # to the parent's end
    os._exit(0)
link.close()
SerialLink(sys.argv[1]).close()
print("opened again")
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_forked_child_neither_keeps_the_port_nor_frees_it(terminal):
    done = subprocess.run(
        [sys.executable, "-c", FORKED, terminal[1]], capture_output=True, text=True
    )
    said = ["a child that leaves takes no lock along", "opened again"]
    assert (done.stderr, done.stdout.splitlines()) == ("", said)


def test_no_such_port():
    with pytest.raises(PortUnavailableError, match="ttyNONE"):
        SerialLink("/dev/ttyNONE")
    with pytest.raises(PortUnavailableError):
        SerialLink("carrier-pigeon://roof")
    with pytest.raises(InvalidInputError, match="port"):
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


def received(link):
    """Return what comes over a line until it breaks."""
    found = b""
    with suppress(ConnectionLostError):
        while True:
            found += link.read(1.0)
    return found


def test_the_last_frame_before_a_peer_hangs_up_arrives():
    frames = [Frame(3, k, b"x") for k in range(3)]
    with socket.create_server(("127.0.0.1", 0)) as server:
        link = SerialLink(f"socket://127.0.0.1:{server.getsockname()[1]}")
        peer, _ = server.accept()
        peer.sendall(b"".join(map(encode, frames)))
        peer.close()
        assert FrameReader().feed(received(link)) == frames
        link.close()


def test_what_was_read_of_a_terminal_before_it_hung_up_is_kept(terminal, monkeypatch):
    host, name = terminal
    link = SerialLink(name)
    os.write(host, b"a")
    read = os.read

    def read_and_hang_up(descriptor, size):
        monkeypatch.undo()
        found = read(descriptor, size)
        os.close(host)
        return found

    monkeypatch.setattr(os, "read", read_and_hang_up)
    assert received(link) == b"a"
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
