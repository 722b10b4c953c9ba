"""The simulated logs that the package brings; ``python -m softgrip.rig.simulated_logs`` makes them.

With names as arguments it makes these alone; each is the same, byte by byte, each time.
"""

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

import numpy as np

from softgrip.errors import UnknownNameError
from softgrip.materials.arrays import Floats
from softgrip.provenance import Provenance, data_folder
from softgrip.rig.calibration import design_1, design_3
from softgrip.rig.calibration_table import FILE
from softgrip.rig.closed_loop_logs import CLOSED_LOOPS, PERIOD, SEED, write_closed_loop
from softgrip.rig.gripper_logs import GRIPPER_LOGS, write_gripper_log
from softgrip.rig.log_schema import LogHeader
from softgrip.rig.logs import LogWriter
from softgrip.rig.pad_logs import write_pad_log
from softgrip.rig.pad_protocol import PAD_TESTS
from softgrip.rig.parameters import PumpParameters, RigParameters
from softgrip.rig.plant import SimulatedRig
from softgrip.rig.step_tests import step_commands
from softgrip.units import ML, MM, REV, MPa

FOLDER = "simulated"
COMMAND = "python -m softgrip.rig.simulated_logs"
STEP_RUNS = 7
STEP_PLUNGER = {60: 11.1 * MM, 90: 25.3 * MM}
STEP_PLUNGER_FX = {60: 24.1 * MM, 90: 39.2 * MM}
"""Travel of the plunger that settles the median finger at about these angles, deg: of Dragon Skin
20, and of FX-Pro. They are `step_tests.travel_to`, to a tenth of a millimetre."""


@dataclass(frozen=True)
class Recipe:
    """How a log of a run in open loop is made.

    Attributes
    ----------
    pump
        The pump used.
    run
        Number of the run.
    commands
        Motor speed in each period, rad/s, shape (samples,).
    words
        What the log shows.
    plunger
        Where the plunger starts, m.
    design
        Gives the parameters of the rig.
    """

    pump: PumpParameters
    run: int
    commands: Floats
    words: str
    plunger: float = 0.0
    design: Callable[[], RigParameters] = design_1


def _push(area: float, lead: float, syringe: float, speed: float, words: str) -> Recipe:
    """Return a push at one speed, from 60 mL of air in the syringe until these are swept."""
    pump = replace(PumpParameters(), area=area, lead=lead, syringe_volume=syringe)
    seconds = 60 * ML / (area * pump.advance * speed) + 1.0
    commands = np.full(round(seconds / PERIOD), speed)
    return Recipe(pump, 0, commands, words, plunger=(syringe - 60 * ML) / area)


def recipes() -> dict[str, Recipe]:
    """Return how each log in open loop is made, by name."""
    small, large, fast = 6.61e-4, 16.62e-4, 8 * MM
    made = {
        "push-a": _push(small, fast, 60 * ML, 1.65 * REV, "default set of Figure 4.4"),
        "push-b": _push(large, fast, 200 * ML, 1.65 * REV, "larger syringe of Figure 4.4"),
        "push-c": _push(small, 2 * MM, 60 * ML, 1.65 * REV, "smaller lead of Figure 4.4"),
        "push-d": _push(small, fast, 60 * ML, 3.30 * REV, "higher speed of Figure 4.4"),
    }
    for name, travels, design, finger in (
        ("step", STEP_PLUNGER, design_1, ""),
        ("step-fx", STEP_PLUNGER_FX, design_3, " of the finger of Dragon Skin FX-Pro"),
    ):
        for (degrees, plunger), run in product(travels.items(), range(STEP_RUNS)):
            words = f"open-loop step to about {degrees} deg{finger}"
            made[f"{name}-{degrees}-{run + 1}"] = Recipe(
                PumpParameters(), run, step_commands(plunger), words, design=design
            )
    return made


def make(name: str, folder: Path | None = None) -> Path:
    """Make one log, in place of the one that is there, and return its path.

    Parameters
    ----------
    name
        One of `recipes`, of `closed_loop_logs.CLOSED_LOOPS`, of `gripper_logs.GRIPPER_LOGS` or of
        `pad_protocol.PAD_TESTS`.
    folder
        Where to write it; None for ``data/simulated/``.

    Raises
    ------
    UnknownNameError
        If there is no such recipe.
    """
    known = recipes()
    if name not in (names := [*known, *CLOSED_LOOPS, *GRIPPER_LOGS, *PAD_TESTS]):
        raise UnknownNameError("simulated log", name, names)
    path = (data_folder() / FOLDER if folder is None else folder) / f"{name}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    if name in CLOSED_LOOPS:
        write_closed_loop(name, path, f"{COMMAND} {name}")
    elif name in GRIPPER_LOGS:
        write_gripper_log(name, path, f"{COMMAND} {name}")
    elif name in PAD_TESTS:
        write_pad_log(name, path, f"{COMMAND} {name}")
    else:
        _write_open_loop(name, known[name], path)
    return path


def _write_open_loop(name: str, recipe: Recipe, path: Path) -> None:
    parameters = replace(recipe.design(), pump=recipe.pump)
    rig = SimulatedRig(
        parameters, seed=SEED, first=recipe.run, period=PERIOD, plunger=recipe.plunger
    )
    end = 0.15 * MPa if name.startswith("push") else np.inf
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=f"{COMMAND} {name}",
        back_end="simulated rig",
        period=PERIOD,
        calibration=f"data/{FILE}",
        seed=f"{SEED} run {recipe.run}",
        notes={
            "shows": recipe.words,
            "area": f"{recipe.pump.area!r} m^2",
            "lead": f"{recipe.pump.lead!r} m",
            "plunger_at_start": f"{recipe.plunger!r} m",
        },
    )
    with LogWriter(path, header) as log:
        for k, command in enumerate(recipe.commands):
            found = rig.advance(command)
            reached = float(rig.truth.pressure[0]) >= end
            stopped = rig.truth.plunger[0] >= recipe.pump.stroke
            event = "pressure reached" if reached else "end of stroke" if stopped else ""
            log.write(
                time=round((k + 1) * PERIOD, 9),
                command=float(command),
                pressure_counts=int(found.pressure_counts[0]),
                angle_counts=int(found.angle_counts[0]),
                pressure=float(found.pressure[0]),
                angle=float(found.angle[0]),
                event=event,
            )
            if event:
                break


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the logs that are named, or all."""
    names = [*recipes(), *CLOSED_LOOPS, *GRIPPER_LOGS, *PAD_TESTS]
    parser = argparse.ArgumentParser(prog=COMMAND, description="Make simulated logs.")
    parser.add_argument("name", nargs="*", help=", ".join(names))
    for name in parser.parse_args(arguments).name or names:
        print(make(name))


if __name__ == "__main__":
    main()
