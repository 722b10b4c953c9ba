"""How a simulated log in open loop is made, which ends where the run has reached its end."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance
from softgrip.simulator.calibration import design_1
from softgrip.simulator.calibration_table import FILE
from softgrip.simulator.chance import SEED
from softgrip.simulator.parameters import PumpParameters, RigParameters
from softgrip.simulator.simulation import Simulation


@dataclass(frozen=True)
class OpenLoopRecipe:
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
    until
        Gauge pressure at which the run ends, Pa.
    """

    pump: PumpParameters
    run: int
    commands: Floats
    words: str
    plunger: float = 0.0
    design: Callable[[], RigParameters] = design_1
    until: float = np.inf


def write_open_loop(recipe: OpenLoopRecipe, path: Path, source: str) -> None:
    """Write one log; the path must be free.

    Parameters
    ----------
    recipe
        How it is made.
    path
        Of the log.
    source
        The command that makes it.
    """
    parameters = replace(recipe.design(), pump=recipe.pump)
    rig = Simulation(parameters, seed=SEED, first=recipe.run, period=PERIOD, plunger=recipe.plunger)
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=source,
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
            reached = float(rig.truth.pressure[0]) >= recipe.until
            stopped = rig.truth.plunger[0] >= recipe.pump.stroke
            event = "pressure reached" if reached else "end of stroke" if stopped else ""
            log.write(
                time=round((k + 1) * PERIOD, 9),
                command=float(command),
                pressure_counts=int(found.pressure_counts[0]),
                angle_counts=int(found.angle_counts[0, 0]),
                pressure=float(found.pressure[0]),
                angle=float(found.angle[0, 0]),
                event=event,
            )
            if event:
                break
