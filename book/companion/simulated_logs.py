"""The simulated logs that the book brings; ``python -m book.companion.simulated_logs`` makes them.

With names as arguments it makes these alone; each is the same, byte by byte, each time. A chapter
says in its file ``logs.py`` what writes each of its logs.

The rows are those of `softgrip.rig.record`: the command of a row is the one that was held until its
time. But nothing here keeps pace with a clock, loses its line, or has the interlock of a board.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from book.companion.choices import choice
from book.companion.exhibit import BOOK
from softgrip.arrays import Floats
from softgrip.control.loop import Controller
from softgrip.control.pid import PERIOD
from softgrip.control.rig_controller import RigController, Tracking
from softgrip.errors import UnknownNameError
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance, data_folder
from softgrip.rig.record import log_row, more_columns, reference_rows
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import DESIGN_1, design_1
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.simulation import Simulation, Truth, sample
from softgrip.units import DEG

FOLDER = "simulated"
COMMAND = "python -m book.companion.simulated_logs"
STEP = 60 * DEG
STEP_DURATION = 20.0
"""s: long enough for the slowest of the controllers of one finger."""


@dataclass(frozen=True)
class Recipe:
    """How a simulated log is made.

    Attributes:
        control: Makes the controller, whose log begins at rest; or the motor speeds in open loop,
            rad/s, shape (N,), whose log begins at the end of the first period; or these speeds.
        words: What the log shows.
        duration: s, under a controller, or what gives it.
        reference: As of `record`, or what gives it.
        push: As of `drive`.
        events: Words by time, s.
        notes: More for the header.
        rig: Gives the parameters of the rig.
        run: Number of the run.
        plunger: Where the plunger starts, m.
        until: Gauge pressure at which a run in open loop ends, Pa; it also ends with the stroke.
        period: s.
        calibration: Of the rig, below ``data/``.
    """

    control: Callable[[], RigController | Floats] | Floats
    words: str
    duration: float | Callable[[], float] = STEP_DURATION
    reference: Callable[[], Floats] | Floats | None = None
    push: Callable[[float], ArrayLike] | None = None
    events: Mapping[float, str] = field(default_factory=dict)
    notes: Mapping[str, str] = field(default_factory=dict)
    rig: Callable[[], RigParameters] = design_1
    run: int = 0
    plunger: float = 0.0
    until: float = np.inf
    period: float = PERIOD
    calibration: str = DESIGN_1

    def write(self, path: Path, source: str) -> None:
        """Write the log to a path, which must be free, with the command that makes it."""
        parameters = self.rig()
        rig = Simulation(
            parameters, seed=SEED, first=self.run, period=self.period, plunger=self.plunger
        )
        control = self.control() if callable(self.control) else self.control
        if not isinstance(control, np.ndarray):
            made = drive(
                rig,
                control,
                duration=self.duration() if callable(self.duration) else self.duration,
                push=self.push,
            )
            time, command, seen, events = made.time, made.command[:, 0], made.measured, self.events
        else:
            command = control
            seen, truth = rig.open_loop(command)
            time, events = _end(truth, self.until, parameters.pump.stroke)
        pump = parameters.pump
        header = LogHeader(
            provenance=Provenance.SIMULATED,
            source=source,
            back_end="simulated rig",
            period=self.period,
            calibration=f"data/{self.calibration}",
            seed=f"{SEED} run {self.run}",
            notes={
                "shows": self.words,
                **self.notes,
                "area": f"{pump.area!r} m^2",
                "lead": f"{pump.lead!r} m",
                "plunger_at_start": f"{self.plunger!r} m",
            },
        )
        reference = self.reference() if callable(self.reference) else self.reference
        fingers = len(parameters.fingers)
        followed = reference_rows(reference, fingers)
        columns = more_columns(fingers, reference=reference is not None)
        with LogWriter(path, header, more=columns) as log:
            for k in range(len(time)):
                wanted = followed[min(k, len(followed) - 1)]
                row = log_row(float(time[k]), float(command[k]), sample(seen, k), wanted)
                log.write(event=events.get(row["time"], ""), **row)


def _end(truth: Truth, until: float, stroke: float) -> tuple[Floats, dict[float, str]]:
    """Return the times of a run that ends at a pressure or with the stroke, and why it ends."""
    time, reached = np.asarray(truth.time), truth.pressure[:, 0] >= until
    over = np.flatnonzero(reached | (truth.plunger[:, 0] >= stroke))[:1]
    words = "pressure reached" if reached[over].any() else "end of stroke"
    kept = time[: over[0] + 1] if over.size else time
    return kept, {round(float(time[k]), 9): words for k in over}


def tracked(
    controller: Callable[[], Controller],
    name: str,
    gains: str,
    words: str,
    *,
    reference: Callable[[], Floats],
) -> Recipe:
    """Return the recipe of a controller of one finger.

    Args:
        controller: Makes it, with its gains.
        name: What it is called.
        gains: Where its gains stand, below ``data/``.
        words: What the log shows.
        reference: Gives what is followed, rad, shape (N,).
    """
    return Recipe(
        lambda: Tracking(controller(), reference()),
        words,
        duration=lambda: (reference().size - 1) * PERIOD,
        reference=lambda: reference()[:, None],
        notes={"controller": f"{name}; data/{gains}"},
    )


def step_of(name: str) -> Floats:
    """Return a step whose size is a choice, as a reference, rad, shape (N,)."""
    return np.full(round(STEP_DURATION / PERIOD) + 1, choice(name))


def writers() -> dict[str, Callable[[Path, str], None]]:
    """Return what writes each log to a path, with the command that makes it, by name."""
    found: dict[str, Callable[[Path, str], None]] = {}
    for file in sorted(BOOK.glob("chapter_*/logs.py")):
        found |= import_module(f"book.{file.parent.name}.logs").LOGS
    return found


def make(name: str, folder: Path | None = None) -> Path:
    """Make one log, in place of the one that is there, and return its path.

    Args:
        name: One of `writers`.
        folder: Where to write it; None for ``data/simulated/``.

    Raises:
        UnknownNameError: If there is no such log.
    """
    known = writers()
    if name not in known:
        raise UnknownNameError("simulated log", name, list(known))
    path = (data_folder() / FOLDER if folder is None else folder) / f"{name}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    known[name](path, f"{COMMAND} {name}")
    return path


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the logs that are named, or all."""
    names = list(writers())
    parser = argparse.ArgumentParser(prog=COMMAND, description="Make simulated logs.")
    parser.add_argument("name", nargs="*", help=", ".join(names))
    for name in parser.parse_args(arguments).name or names:
        print(make(name))


if __name__ == "__main__":
    main()
