"""The emulated board: the firmware on simavr, stepped in virtual time."""

import ctypes
from enum import IntEnum

import numpy as np

from softgrip.board.emulated.build import firmware, library, symbol
from softgrip.board.protocol import CHANNELS, SetUp

CLOCK = 16_000_000
"""Cycles per second."""
ROOM = 4096
"""Bytes that are taken from the harness at once."""
PRESSURE = CHANNELS.index("pressure")
FULL_VOLTS, FULL_COUNT = 5.0, 1023


class Switch(IntEnum):
    """How the home switch is: it works, or its wire is broken or shorted."""

    WORKS = 0
    BROKEN = 1
    SHORTED = 2


class EmulatedBoard:
    """A board with a motor on its STEP and DIR pins, a home switch at 0 and voltages on A0 to A13.

    Times are virtual and count from its making; a power cycle does not set them back.

    Args:
        set_up, valve: What the firmware is built for.
        position: Of the plunger at the start, steps from the home switch, positive into the
            syringe.
    """

    def __init__(
        self, set_up: SetUp = SetUp.GRIPPER, *, valve: bool = False, position: int = 200
    ) -> None:
        self._board = None  # first: `__del__` follows a firmware that cannot be built
        self.elf, self._c = firmware(set_up, valve=valve), library()
        self._volts = [0.5 if k == PRESSURE else 0.0 for k in range(len(CHANNELS))]
        self._switch, self._before = Switch.WORKS, 0
        self._old_edges: list[tuple[np.ndarray, np.ndarray]] = []
        self._bytes, self._times = ctypes.create_string_buffer(ROOM), (ctypes.c_double * ROOM)()
        self._start(position)

    def _start(self, position: int) -> None:
        self._board = self._c.board_new(str(self.elf).encode())
        if not self._board:
            raise RuntimeError(f"simavr does not take {self.elf}")
        self._c.board_place(self._board, position)
        self._c.board_switch(self._board, self._switch)
        for channel, volts in enumerate(self._volts):
            self.set_volts(channel, volts)

    def close(self) -> None:
        """Free it."""
        if self._board:
            self._c.board_free(self._board)
        self._board = None

    __del__ = close

    @property
    def time(self) -> float:
        """Virtual time, s."""
        return float(self._before + self._c.board_cycle(self._board)) / CLOCK

    @property
    def position(self) -> int:
        """Place of the plunger, steps, as the motor was turned."""
        return int(self._c.board_position(self._board))

    @property
    def valve_open(self) -> bool:
        """Whether the valve's pin is high."""
        return bool(self._c.board_valve(self._board))

    def advance(self, seconds: float) -> None:
        """Let virtual time pass."""
        self._run(self._c.board_cycle(self._board) + round(seconds * CLOCK))

    def _run(self, until: int) -> None:
        if self._c.board_run(self._board, until):
            raise RuntimeError("the firmware crashed")

    def write(self, data: bytes) -> None:
        """Send bytes to the board, at 250 kBd from now or from the end of those on the way."""
        self._c.board_write(self._board, data, len(data))

    def flush(self) -> None:
        """Let time pass until all that was written has come."""
        while self._c.board_pending(self._board):
            self.advance(0.001)
        self.advance(0.004)

    def read_timed(self) -> tuple[bytes, np.ndarray]:
        """Return the bytes that have come, and when the last bit of each came, s."""
        found, times = b"", list[float]()
        while count := self._c.board_read(self._board, self._bytes, self._times, ROOM):
            found += self._bytes.raw[:count]
            times += self._times[:count]
        return found, np.array(times) + self._before / CLOCK

    def read(self, timeout: float = 0.0) -> bytes:
        """Return the bytes that have come; let at most `timeout` s pass for a first one."""
        end = self._c.board_cycle(self._board) + round(timeout * CLOCK)
        while not (found := self.read_timed()[0]):
            now, due = self._c.board_cycle(self._board), self._c.board_due(self._board)
            if now >= end:
                break
            # A byte that is on its way is waited for to its end; else in steps of half a byte.
            self._run(min(end, due if due > now else now + 320))
        return found

    def set_volts(self, channel: int, volts: float) -> None:
        """Put a voltage on a channel of the converter, 0 to 5 V."""
        self._volts[channel] = volts
        self._c.board_volts(self._board, channel, round(1e3 * min(max(volts, 0.0), FULL_VOLTS)))

    def set_count(self, channel: int, count: int) -> None:
        """Put the voltage on a channel that reads as a count."""
        self.set_volts(channel, (count + 0.5) * FULL_VOLTS / FULL_COUNT)

    def set_switch(self, switch: Switch) -> None:
        """Break the home switch's wire, short it, or mend it."""
        self._switch = switch
        self._c.board_switch(self._board, switch)

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the times of all rising edges of STEP, s, and the way of each, +1 or -1."""
        parts = [*self._old_edges, self._edges()]
        times, ways = (np.concatenate(part) for part in zip(*parts, strict=True))
        return times, ways

    def _edges(self) -> tuple[np.ndarray, np.ndarray]:
        count = self._c.board_edges(self._board)
        if not count:
            return np.empty(0), np.empty(0, np.int8)
        times = np.ctypeslib.as_array(self._c.board_edge_times(self._board), (count,))
        ways = np.ctypeslib.as_array(self._c.board_edge_ways(self._board), (count,))
        return (times + self._before) / CLOCK, ways.copy()

    def hang(self, *, interrupts: bool) -> None:
        """Let the program run in circles from now on, its interrupts served or not."""
        loop = symbol(self.elf, "__stop_program")
        self._c.board_hang(self._board, loop, int(interrupts))

    def power_cycle(self) -> None:
        """Take the power away and give it back; the plunger stays."""
        position, edges = self.position, self._edges()
        self._old_edges.append(edges)
        self._before += self._c.board_cycle(self._board)
        self.close()
        self._start(position)
