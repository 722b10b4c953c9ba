"""How the simulated logs of the gripper are made: Figures 6.4, 6.5 and 6.7.

They start with a row at rest. As in all logs, the command of a row was held until its time. The
left finger is the first. What a controller knows comes from the logs in open loop.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from softgrip.arrays import Floats
from softgrip.gripper.internal_model import PERIOD
from softgrip.logs.fingers import column
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance
from softgrip.simulator.chance import SEED
from softgrip.simulator.gripper_calibration import OPEN_LOOP_DURATION, push_commands
from softgrip.simulator.gripper_calibration_table import FILE
from softgrip.simulator.gripper_loop import CommandSequence, GripperController, drive_gripper
from softgrip.simulator.gripper_parameters import TRAVEL, printed_gripper
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV

RUNS = 7
LOW_SPEED = 0.1 * REV
"""rad/s, of the slow steps (assumed; no speed is printed)."""
REST = 5.0
"""Time that a finger is given after a push, s."""
PUSH_FROM, PUSH_UNTIL = 5.0, 5.5
"""s. Section 6.4 pushes at 1.4 s, when its fingers are at rest; here they rest later."""
PUSH_TORQUE = -1e-3
"""N m on the left finger (assumed): a fifth of what the air bends it with."""


@dataclass(frozen=True)
class GripperRecipe:
    """How a log of the gripper is made.

    Attributes
    ----------
    controller
        Makes what gives the commands.
    duration
        s.
    words
        What the log shows.
    references
        rad, shape (fingers,); None in open loop.
    push
        As of `drive_gripper`.
    """

    controller: Callable[[], GripperController]
    duration: float
    words: str
    references: Callable[[], Floats] | None = None
    push: Callable[[float], ArrayLike] | None = None


def push_left(time: float) -> Floats:
    """Return the torque of a hand on the left finger, N m, shape (2, 1)."""
    pushed = PUSH_FROM - PERIOD / 2 < time < PUSH_UNTIL - PERIOD / 2
    return np.array([[PUSH_TORQUE if pushed else 0.0], [0.0]])


def low_speed_commands(speed: float = LOW_SPEED) -> Floats:
    """Return the commands that push as far as the open-loop step does, at a speed in rad/s."""
    return push_commands(TRAVEL, printed_gripper().pump, speed)


def _target() -> Floats:
    return target_angles(own_model())


_RECIPES = {
    "open": GripperRecipe(
        lambda: gripper_controller("open loop"),
        OPEN_LOOP_DURATION,
        "Figures 6.4 (a) 6.5 (a) and 6.7 (a): step in open loop at high speed",
    ),
    "low-speed": GripperRecipe(
        lambda: CommandSequence(low_speed_commands()),
        PERIOD * low_speed_commands().size + REST,
        "Figure 6.5 (a): step in open loop at 0.1 rev/s",
    ),
    "fast": GripperRecipe(
        lambda: gripper_controller("H 4.8/s"),
        OPEN_LOOP_DURATION,
        "Figure 6.7 (b): scheme of Figure 6.3 with the H(s) for 4.8/s",
        _target,
    ),
    "slow": GripperRecipe(
        lambda: gripper_controller("H 2/s"),
        OPEN_LOOP_DURATION,
        "Figure 6.7 (b): scheme of Figure 6.3 with the H(s) for 2/s",
        _target,
    ),
    "push": GripperRecipe(
        lambda: gripper_controller("H 2/s"),
        9.0,
        "Figure 6.7 (c): as gripper-slow with a push on the left finger",
        _target,
        push_left,
    ),
}


def names_of(kind: str) -> tuple[str, ...]:
    """Return the names below ``data/`` of the logs of a kind, such as "open"."""
    return tuple(f"simulated/gripper-{kind}-{run + 1}.csv" for run in range(RUNS))


def write_gripper_log(recipe: GripperRecipe, run: int, path: Path, source: str) -> None:
    """Write one log; the path must be free.

    Parameters
    ----------
    recipe, run
        How it is made, and the number of the run.
    path
        Of the log.
    source
        The command that makes it.
    """
    rig = Simulation(printed_gripper(), seed=SEED, first=run, period=PERIOD)
    made = drive_gripper(rig, recipe.controller(), duration=recipe.duration, push=recipe.push)
    pump, fingers = rig.parameters.pump, range(len(rig.parameters.fingers))
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=source,
        back_end="simulated rig",
        period=PERIOD,
        calibration=f"data/{FILE}",
        seed=f"{SEED} run {run}",
        notes={
            "shows": recipe.words.replace(":", ","),
            "fingers": "left, right",
            "area": f"{pump.area!r} m^2",
            "lead": f"{pump.lead!r} m",
            "plunger_at_start": "0.0 m",
        },
    )
    units: dict[str, str] = {}
    for finger in fingers[1:]:
        units |= {column("angle_counts", finger): "count", column("angle", finger): "rad"}
    references = None if recipe.references is None else recipe.references()
    if references is not None:
        units |= {column("reference", finger): "rad" for finger in fingers}
    seen = made.measured
    with LogWriter(path, header, more=units) as log:
        for k, time in enumerate(made.time):
            values = {
                "time": round(float(time), 9),
                "command": float(made.command[k, 0]),
                "pressure_counts": int(seen.pressure_counts[k, 0]),
                "pressure": float(seen.pressure[k, 0]),
            }
            for finger in fingers:
                values[column("angle_counts", finger)] = int(seen.angle_counts[k, finger, 0])
                values[column("angle", finger)] = float(seen.angle[k, finger, 0])
                if references is not None:
                    values[column("reference", finger)] = round(float(references[finger]), 9)
            log.write(event=_event(recipe, float(time)), **values)


def _event(recipe: GripperRecipe, time: float) -> str:
    if recipe.push is None:
        return ""
    if abs(time - PUSH_FROM) < PERIOD / 2:
        return "push on the left finger"
    return "released" if abs(time - PUSH_UNTIL) < PERIOD / 2 else ""


LOGS = {
    f"gripper-{name}-{run + 1}": partial(write_gripper_log, recipe, run)
    for name, recipe in _RECIPES.items()
    for run in range(RUNS)
}
"""What writes each log, by name, to a path, with the command that makes it; open loop first."""
