"""Boards for the tests of driver and rig: a stub in memory, and the same behind a real line."""

import os
import socket
import threading
import time

import pytest

from softgrip.board.driver import Board
from tests.board.stub_board import StubBoard


class Served:
    """A stub board in real time at the end of a line of bytes; a thread carries them."""

    def __init__(self, board, receive, send):
        self.board, self._receive, self._send, self._over = board, receive, send, False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        begun = time.monotonic() - self.board.now()
        while not self._over:
            try:
                data = self._receive()
                if data:
                    self.board.write(data)
                ahead = time.monotonic() - begun - self.board.now()
                if ahead > 0.1:
                    # The machine was busy: that must not make the host seem silent.
                    begun += ahead
                elif ahead > 0:
                    self.board.elapse(ahead)
                if self.board.out:
                    self._send(self.board.take())
            except OSError:
                return
            time.sleep(0.002)

    def stop(self):
        self._over = True
        self._thread.join()


@pytest.fixture
def stub():
    return StubBoard()


@pytest.fixture
def rig(stub):
    """The driver of a stub board, homed."""
    with Board(stub) as opened:
        opened.home()
        yield opened


@pytest.fixture
def pty_board():
    """The name of a terminal with a stub board behind it, and the board."""
    host, device = os.openpty()
    os.set_blocking(host, False)

    def receive():
        try:
            return os.read(host, 4096)
        except BlockingIOError:
            return b""

    board = StubBoard()
    served = Served(board, receive, lambda data: os.write(host, data))
    yield os.ttyname(device), board
    served.stop()
    os.close(host)
    os.close(device)


class SocketBoard:
    """A stub board behind a TCP port, whose cable can be pulled and put back."""

    def __init__(self, board):
        self.board, self.port, self._served, self._peer, self._server = board, 0, None, None, None
        self.plug()

    def plug(self):
        self._server = socket.create_server(("127.0.0.1", self.port), reuse_port=True)
        self.port = self._server.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        try:
            self._peer, _ = self._server.accept()
        except OSError:
            return
        self._peer.setblocking(False)
        self._served = Served(self.board, self._receive, self._peer.sendall)

    def _receive(self):
        try:
            return self._peer.recv(4096)
        except BlockingIOError:
            return b""

    def pull(self):
        if self._served is not None:
            self._served.stop()
            self._served = None
        for one in (self._peer, self._server):
            if one is not None:
                one.close()

    @property
    def url(self):
        return f"socket://127.0.0.1:{self.port}"


@pytest.fixture
def socket_board():
    made = SocketBoard(StubBoard())
    yield made
    made.pull()
