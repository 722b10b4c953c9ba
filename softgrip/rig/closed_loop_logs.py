"""How the simulated logs of the controllers are made: Figures 3.12, 4.5 and 4.7.

They have one column more than other logs, the reference. As in these, the command of a row is the
one that was held until its time.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softgrip.materials.arrays import Floats
from softgrip.provenance import Provenance
from softgrip.rig.calibration import design_1
from softgrip.rig.calibration_table import FILE
from softgrip.rig.closed_loop import Name, controller, run_on_rig
from softgrip.rig.log_schema import LogHeader
from softgrip.rig.logs import LogWriter
from softgrip.rig.lqr_gains import FILE as LQR_FILE
from softgrip.rig.pid_gains import FILE as GAINS_FILE
from softgrip.rig.plant import SimulatedRig
from softgrip.rig.staircase import staircase
from softgrip.units import DEG

PERIOD = 0.025
SEED = 2024
STEP = 60 * DEG
STEP_DURATION = 20.0
"""s: long enough for the slowest of the controllers."""


@dataclass(frozen=True)
class ClosedLoopRecipe:
    """How a log of a controller is made.

    Attributes
    ----------
    controlled_by
        Name of the controller.
    reference
        rad, shape (N,).
    words
        What the log shows.
    gains
        Where its gains stand, below ``data/``.
    """

    controlled_by: Name
    reference: Floats
    words: str
    gains: str = GAINS_FILE


def _step(name: Name, words: str, gains: str = GAINS_FILE) -> ClosedLoopRecipe:
    return ClosedLoopRecipe(name, np.full(round(STEP_DURATION / PERIOD) + 1, STEP), words, gains)


CLOSED_LOOPS: dict[str, Callable[[], ClosedLoopRecipe]] = {
    "pid-actuator": lambda: _step("actuator", "Figure 4.5 (a): 60 deg, PID designed on Eq. (4.14)"),
    "pid-full": lambda: _step("full", "Figure 4.5 (b): 60 deg, PID designed on Eq. (4.15)"),
    "staircase": lambda: ClosedLoopRecipe(
        "full", staircase(period=PERIOD), "Figure 4.7: staircase, PID designed on Eq. (4.15)"
    ),
    "lqr-printed": lambda: _step(
        "lqr printed", "Figure 3.12: 60 deg, LQR with the weights of Eq. (3.29)", LQR_FILE
    ),
    "lqr-fast": lambda: _step("lqr fast", "Figure 3.12: 60 deg, LQR made faster", LQR_FILE),
}
"""What makes the recipe of each log, by name."""


def write_closed_loop(name: str, path: Path, source: str) -> None:
    """Write one log; the path must be free.

    Parameters
    ----------
    name
        A key of `CLOSED_LOOPS`.
    path
        Of the log.
    source
        The command that makes it.
    """
    recipe = CLOSED_LOOPS[name]()
    count = recipe.reference.size
    rig = SimulatedRig(design_1(), seed=SEED, period=PERIOD)
    loop = run_on_rig(
        rig, controller(recipe.controlled_by), recipe.reference, duration=(count - 1) * PERIOD
    )
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
            "controller": f"{recipe.controlled_by}; data/{recipe.gains}",
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
                angle_counts=int(seen.angle_counts[k, 0]),
                pressure=float(seen.pressure[k, 0]),
                angle=float(seen.angle[k, 0]),
                reference=float(recipe.reference[k]),
            )
