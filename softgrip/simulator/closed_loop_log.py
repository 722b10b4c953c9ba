"""How a simulated log of a controller is made.

It has one column more than other logs, the reference. As in these, the command of a row is the one
that was held until its time.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import Controller
from softgrip.control.pid import PERIOD
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance
from softgrip.simulator.calibration import design_1
from softgrip.simulator.calibration_table import FILE
from softgrip.simulator.chance import SEED
from softgrip.simulator.closed_loop import run_on_rig
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG

STEP = 60 * DEG
STEP_DURATION = 20.0
"""s: long enough for the slowest of the controllers."""


@dataclass(frozen=True)
class ClosedLoopRecipe:
    """How a log of a controller is made.

    Attributes
    ----------
    controller
        Makes it, with its gains.
    name
        What it is called.
    gains
        Where its gains stand, below ``data/``.
    words
        What the log shows.
    reference
        rad, shape (N,); by default a step.
    """

    controller: Callable[[], Controller]
    name: str
    gains: str
    words: str
    reference: Floats = field(
        default_factory=lambda: np.full(round(STEP_DURATION / PERIOD) + 1, STEP)
    )


def write_closed_loop(recipe: ClosedLoopRecipe, path: Path, source: str) -> None:
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
    count = recipe.reference.size
    rig = Simulation(design_1(), seed=SEED, period=PERIOD)
    loop = run_on_rig(rig, recipe.controller(), recipe.reference, duration=(count - 1) * PERIOD)
    pump = rig.parameters.pump
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=source,
        back_end="simulated rig",
        period=PERIOD,
        calibration=f"data/{FILE}",
        seed=f"{SEED} run 0",
        notes={
            "shows": recipe.words,
            "controller": f"{recipe.name}; data/{recipe.gains}",
            "area": f"{pump.area!r} m^2",
            "lead": f"{pump.lead!r} m",
            "plunger_at_start": "0.0 m",
        },
    )
    seen = loop.measured
    held = np.concatenate([[0.0], loop.result.command[0, :-1]])
    with LogWriter(path, header, more={"reference": "rad"}) as log:
        for k in range(count):
            log.write(
                time=round(k * PERIOD, 9),
                command=float(held[k]),
                pressure_counts=int(seen.pressure_counts[k, 0]),
                angle_counts=int(seen.angle_counts[k, 0, 0]),
                pressure=float(seen.pressure[k, 0]),
                angle=float(seen.angle[k, 0, 0]),
                reference=float(recipe.reference[k]),
            )
