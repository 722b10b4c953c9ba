"""Does speed narrow the spread of a finger, as Remark 3 and Figure 6.5 say? Steps at many speeds.

``python -m book.chapter_6.speed`` writes ``data/gripper/speed_spread.csv``: for pushes of one
travel at several motor speeds, where the left finger of the simulated gripper comes to rest in each
run, less the mean over the runs. The mean of its last second, as it is and as its sensor has it.
"""

from collections.abc import Iterator
from dataclasses import astuple, dataclass
from typing import Literal

import numpy as np

from book.chapter_6.controllers import open_loop_commands
from book.chapter_6.logs import REST
from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.rig_controller import CommandSequence
from softgrip.gripper.internal_model import PERIOD
from softgrip.kept import Kept
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, REV

SPEEDS = (5.0, 1.0, 0.5, 0.2, 0.1, 0.05)
"""rev/s, besides the fitted ones of the text."""
RUNS = 200
END = 1.0
"""Over which the angle is averaged, s."""


@dataclass(frozen=True)
class SpeedSpread:
    """Errors of the angle at rest at one speed, deg, shape (runs,).

    Attributes:
        speed: rev/s.
        true: Without the sensor.
        measured: With it.
    """

    speed: float
    true: Floats
    measured: Floats


def printed_speed(name: Literal["high", "low"]) -> float:
    """Return one of the two speeds of the text, rev/s; they are fitted, as none is printed."""
    named = {"high": "gripper_speed", "low": "low_speed"}
    return round(choice(named[name]) / REV, 6)


def speeds() -> tuple[float, ...]:
    """Return all speeds, rev/s, the highest first."""
    return tuple(sorted({*SPEEDS, printed_speed("high"), printed_speed("low")}, reverse=True))


def errors_at(speed: float, *, runs: int = RUNS, seed: int = SEED) -> SpeedSpread:
    """Simulate steps of the left finger at a speed, rev/s."""
    commands = open_loop_commands(speed * REV)
    rig = Simulation(printed_gripper(), runs=runs, seed=seed, period=PERIOD)
    made = drive(rig, CommandSequence(commands), duration=PERIOD * commands.size + REST)
    last = round(END / PERIOD)
    true, measured = (
        angle[-last:, 0].mean(axis=0) / DEG for angle in (made.truth.angle, made.measured.angle)
    )
    return SpeedSpread(speed, true - true.mean(), measured - measured.mean())


@dataclass(frozen=True)
class RunError:
    """Errors of one run, as of `SpeedSpread`."""

    speed: float
    run: int
    true: float
    measured: float


def run_errors() -> Iterator[RunError]:
    """Simulate the steps at all speeds."""
    for found in map(errors_at, speeds()):
        for run, errors in enumerate(zip(found.true, found.measured, strict=True)):
            yield RunError(found.speed, run, *errors)


KEPT = Kept(
    "gripper/speed_spread.csv",
    RunError,
    run_errors,
    "python -m book.chapter_6.speed",
    notes="rev/s, then deg",
    number=".3f",
    exact=("speed",),
)


def kept_errors() -> tuple[SpeedSpread, ...]:
    """Read the kept errors, the highest speed first."""
    table = np.array([astuple(row) for row in KEPT.read()])
    return tuple(SpeedSpread(speed, *table[table[:, 0] == speed][:, 2:].T) for speed in speeds())


if __name__ == "__main__":
    KEPT.main()
