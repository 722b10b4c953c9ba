"""The emulated board as a `softgrip.board.link.Link`, alone or with simulated physics at its pins.

Waiting is what lets its time pass.
"""

from dataclasses import replace

from softgrip.board.driver import FLEX, PRESSURE, Board
from softgrip.board.emulated.board import CLOCK, EmulatedBoard
from softgrip.board.errors import ConnectionLostError
from softgrip.board.firmware.config import STEPS
from softgrip.gripper.internal_model import PERIOD as LOOP_PERIOD
from softgrip.simulator.fitted_rigs import design_1, printed_gripper
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.simulation import Simulation

PERIOD = 0.005
"""At which board and physics tell each other of steps and volts, s."""
CYCLE = 1 / CLOCK
"""Time goes on by whole cycles: what is nearer than one is now."""


class EmulatedLink:
    """A line to an emulated board."""

    name, real_time = "emulated board", False

    def __init__(self, board: EmulatedBoard) -> None:
        self.board, self.closed = board, False

    def _check(self) -> None:
        if self.closed:
            raise ConnectionLostError(self.name, "the link was closed")

    def write(self, data: bytes) -> None:
        """Send bytes."""
        self._check()
        self.board.write(data)

    def read(self, timeout: float) -> bytes:
        """Return what has come; let at most `timeout` s of virtual time pass for a first byte."""
        self._check()
        return self.board.read(timeout)

    def now(self) -> float:
        """Return the virtual time, s."""
        return self.board.time

    def close(self) -> None:
        """Give the line up; the board goes on when its time does."""
        self.closed = True


def at_the_pins(parameters: RigParameters, *, seed: int = 0, position: int = 0) -> Simulation:
    """Return a rig whose motor is where it is told to be: the board's ramps are the motor's.

    Args:
        parameters: Of the rig.
        seed: Of chance.
        position: Of the plunger at the start, steps from home.
    """
    pump = replace(parameters.pump, speed_limit=1e4, acceleration_limit=1e9)
    plunger = position * pump.lead / STEPS
    stiff = replace(parameters, pump=pump)
    return Simulation(stiff, seed=seed, period=PERIOD, plunger=plunger)


def finger(seed: int = 0, *, position: int = 200) -> Simulation:
    """Return the simulated rig of Design 1, its plunger so many steps from home."""
    return at_the_pins(design_1(), seed=seed, position=position)


def gripper(seed: int = 0) -> Simulation:
    """Return the simulated gripper of two fingers, its plunger drawn out."""
    return at_the_pins(printed_gripper(), seed=seed)


class EmulatedFingers(EmulatedLink):
    """A `Link` to an emulated board that drives simulated fingers; all of it is simulated.

    Args:
        plant: Physics of one run, of `finger` or `gripper`; None for `finger`.
    """

    def __init__(self, plant: Simulation | None = None) -> None:
        self.plant = finger() if plant is None else plant
        step = self.plant.parameters.pump.lead / STEPS
        super().__init__(EmulatedBoard(position=round(float(self.plant.truth.plunger[0]) / step)))
        self._told = self.board.time

    def _exchange(self) -> None:
        """Move the plunger to where the motor is by now, and put the sensors' volts on the pins."""
        pump = self.plant.parameters.pump
        place = max(self.board.position, 0) * pump.lead / STEPS
        away = place - float(self.plant.truth.plunger[0])
        found = self.plant.advance(away / pump.advance / PERIOD)
        self.board.set_count(PRESSURE, int(found.pressure_counts[0]))
        for k, count in enumerate(found.angle_counts[:2, 0]):
            self.board.set_count(FLEX + k, int(count))
        self._told += PERIOD

    def advance(self, seconds: float) -> None:
        """Let virtual time pass."""
        self._until(self.board.time + seconds)

    def _until(self, end: float) -> None:
        while self.board.time < end - CYCLE:
            self.board.advance(min(end, self._told + PERIOD) - self.board.time)
            if self.board.time >= self._told + PERIOD - CYCLE:
                self._exchange()

    def read(self, timeout: float) -> bytes:
        """Return what has come; let at most `timeout` s of virtual time pass for a first byte."""
        self._check()
        end = self.board.time + timeout
        while not (found := self.board.read(0.0)) and self.board.time < end - CYCLE:
            self._until(min(end, self.board.time + PERIOD / 10))
        return found


def emulated_finger(*, seed: int = 0) -> Board:
    """Return a board that drives the finger of Chapters 3 to 5, sampled each 25 ms."""
    return Board(EmulatedFingers(finger(seed)))


def emulated_gripper(*, seed: int = 0) -> Board:
    """Return a board that drives the two fingers of Section 6.4, sampled each 100 ms."""
    pump = printed_gripper().pump
    return Board(EmulatedFingers(gripper(seed)), fingers=2, period=LOOP_PERIOD, pump=pump)
