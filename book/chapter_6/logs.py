"""How the simulated logs of the gripper are made: Figures 6.4, 6.5 and 6.7.

They start with a row at rest. As in all logs, the command of a row was held until its time. The
left finger is the first. What a controller knows comes from the logs in open loop.
"""

from dataclasses import replace

import numpy as np

from book.chapter_6.controllers import (
    gripper_controller,
    open_loop_commands,
    own_model,
    target_angles,
)
from book.companion.choices import choice
from book.companion.simulated_logs import Recipe
from softgrip.arrays import Floats
from softgrip.control.rig_controller import CommandSequence
from softgrip.gripper.internal_model import PERIOD
from softgrip.simulator.fitted_rigs import GRIPPER, printed_gripper
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.laws import settled_torque

RUNS = 7
REST = 5.0
"""Time that a finger is given after a push, s."""
PUSH_FROM, PUSH_UNTIL = 5.0, 5.5
"""s. Section 6.4 pushes at 1.4 s, when its fingers are at rest; here they rest later."""
PUSH_SHARE = 0.2
"""Of what the air bends the left finger with, at its target (assumed)."""


def push_left(time: float) -> Floats:
    """Return the torque of a hand on the left finger, N m, shape (2, 1)."""
    pushed = PUSH_FROM - PERIOD / 2 < time < PUSH_UNTIL - PERIOD / 2
    held = settled_torque(_target()[0], printed_gripper().fingers[0])
    return np.array([[-PUSH_SHARE * held * pushed], [0.0]])


def low_speed_commands() -> Floats:
    """Return the commands that push as far as the open-loop step does, at low speed, rad/s."""
    return open_loop_commands(choice("low_speed"))


def _target() -> Floats:
    # The last bits of linear algebra differ from machine to machine.
    return np.round(target_angles(own_model()), 9)


_OPEN = Recipe(
    lambda: gripper_controller("open loop"),
    "Figures 6.4 (a) 6.5 (a) and 6.7 (a), step in open loop at high speed",
    duration=OPEN_LOOP_DURATION,
    notes={"fingers": "left, right"},
    rig=printed_gripper,
    period=PERIOD,
    calibration=GRIPPER,
)
_FAST = replace(
    _OPEN,
    control=lambda: gripper_controller("4.8/s"),
    words="Figure 6.7 (b), scheme of Figure 6.3 with the H(s) for 4.8/s",
    reference=_target,
)
_SLOW = replace(
    _FAST,
    control=lambda: gripper_controller("2/s"),
    words="Figure 6.7 (b), scheme of Figure 6.3 with the H(s) for 2/s",
)
_RECIPES = {
    "open": _OPEN,
    "low-speed": replace(
        _OPEN,
        control=lambda: CommandSequence(low_speed_commands()),
        duration=lambda: PERIOD * low_speed_commands().size + REST,
        words="Figure 6.5 (a), step in open loop at low speed",
    ),
    "fast": _FAST,
    "slow": _SLOW,
    "push": replace(
        _SLOW,
        words="Figure 6.7 (c), as gripper-slow with a push on the left finger",
        duration=9.0,
        push=push_left,
        events={PUSH_FROM: "push on the left finger", PUSH_UNTIL: "released"},
    ),
}


def names_of(kind: str) -> tuple[str, ...]:
    """Return the names below ``data/`` of the logs of a kind, such as "open"."""
    return tuple(f"simulated/gripper-{kind}-{run + 1}.csv" for run in range(RUNS))


LOGS = {
    f"gripper-{name}-{run + 1}": replace(recipe, run=run).write
    for name, recipe in _RECIPES.items()
    for run in range(RUNS)
}
"""What writes each log, by name, to a path, with the command that makes it; open loop first."""
