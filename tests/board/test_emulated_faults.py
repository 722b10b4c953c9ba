"""What must be survived between host and board, with the real firmware, emulated."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from softgrip.board.driver import Board
from softgrip.board.emulated.link import EmulatedFingers
from softgrip.board.emulated.terminal import Terminal
from softgrip.board.errors import ConnectionLostError, PortUnavailableError
from softgrip.logs.reader import read_log
from softgrip.rig.record import record
from tests.board.emulated import needs_emulator
from tests.rig.test_record import a_second_before_the_last

pytestmark = needs_emulator

ROOT = Path(__file__).parents[2]
SILENCE = 0.2
SPEED = 1.0
"""rad/s: 127 steps a second, so that the last step tells the end of motion to 8 ms."""


class Cable(EmulatedFingers):
    """A line that can be pulled for some seconds; the board's time goes on meanwhile."""

    pulled_at = pulled_until = -1.0

    def pull(self, seconds):
        self.pulled_at, self.pulled_until = self.now(), self.now() + seconds

    def _check(self):
        super()._check()
        if self.now() < self.pulled_until:
            self.advance(0.01)
            raise ConnectionLostError("emulated board", "cable pulled")


def test_a_cable_pulled_and_put_back(tmp_path):
    line, path = Cable(), tmp_path / "log.csv"

    class Pulls:
        count = 0

        def update(self, measured):
            self.count += 1
            if self.count == 20:
                line.pull(1.0)
            return SPEED

    with Board(line, emulated=True) as rig:
        rig.home()
        line.board.edges()
        made = record(rig, Pulls(), 3.0, path)
        steps = np.asarray(line.board.edges()[0])
    before = steps[steps < line.pulled_until]
    # The last word of the host may have been a heartbeat just before.
    assert before[-1] < line.pulled_at + SILENCE + 0.01
    assert before[-1] > line.pulled_at + SILENCE - 0.075
    assert steps[-1] > line.pulled_until  # put back, the run went on
    log = read_log(path)
    assert len(made.reconnections) == 1
    assert "found again" in " ".join(words for _, words in log.events)
    assert (log["time"][-1], log["command"][-1]) == (pytest.approx(3.0, abs=0.03), SPEED)


class Listened(EmulatedFingers):
    """A line that knows when the host's bytes came, by the board's time."""

    def __init__(self):
        super().__init__()
        self.heard = []

    def write(self, data):
        super().write(data)
        self.heard.append(self.now())


DRIVEN = """
import sys
from softgrip.board.driver import Board
from softgrip.rig.record import record

def say(row, duration):
    print(row["time"], flush=True)

rig = Board(sys.argv[1], emulated=True)
rig.home()
record(rig, [1.0] * 10_000, 250.0, sys.argv[2], progress=say)
"""


def test_a_killed_host_stops_the_board_and_leaves_a_log_that_lacks_a_second_at_most(tmp_path):
    path, line = tmp_path / "log.csv", Listened()
    with Terminal(line) as port:
        child = subprocess.Popen(
            [sys.executable, "-c", DRIVEN, port, str(path)], stdout=subprocess.PIPE, text=True
        )
        told = []
        try:
            for word in child.stdout:
                told.append((time.monotonic(), float(word)))
                if len(a_second_before_the_last(told)) > 5:
                    break
        finally:
            child.send_signal(signal.SIGKILL)
            killed = line.now()
            child.wait()
            child.stdout.close()
        # By the board's time, which a busy machine lets pass more slowly.
        deadline = time.monotonic() + 30
        while line.now() < killed + SILENCE + 0.3 and time.monotonic() < deadline:
            time.sleep(0.05)
    steps = np.asarray(line.board.edges()[0])
    assert line.now() > killed + SILENCE + 0.2
    heard, last = np.asarray(line.heard), steps[-1]
    assert heard[-1] < killed + 0.1  # bytes were under way
    # From the last of them on the patience of the board counts, and its motor was turning; unless a
    # busy machine had kept the host silent for so long that the board had stopped.
    before, after = heard[heard < last], heard[heard >= last]
    assert last < before[-1] + SILENCE + 0.03
    assert after.size == 0 or last > before[-1] + SILENCE - 0.03
    log = read_log(path)
    assert log["time"][-1] >= a_second_before_the_last(told)[-1]


FULL_DISK = """
import resource, sys
from softgrip.rig.record import record
from softgrip.board.emulated.link import emulated_finger

with emulated_finger() as rig:
    rig.home()
    resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
    begin = rig.time
    made = record(rig, [0.1] * 200, 5.0, sys.argv[1])
    assert rig.time - begin > 4.9
print(made.samples, made.log_failure)
"""


def test_a_full_disk_ends_the_log_and_not_the_run(tmp_path):
    path = tmp_path / "log.csv"
    done = subprocess.run(
        [sys.executable, "-c", FULL_DISK, str(path)],
        capture_output=True, text=True, check=True, cwd=ROOT,
    )  # fmt: skip
    assert done.stdout.startswith("201 OSError: ")
    assert done.stderr.count("the run goes on") == 1
    assert 10 < read_log(path)["time"].size < 100


def test_a_second_host_is_refused_and_the_first_goes_on():
    with Terminal(EmulatedFingers()) as port, Board(port, emulated=True) as first:
        with pytest.raises(PortUnavailableError, match="another program"):
            Board(port, emulated=True)
        first.home()
        before = first.time
        first.advance(SPEED)
        assert first.time > before
