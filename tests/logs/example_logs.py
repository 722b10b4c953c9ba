"""Chapter 4's pushes and a staircase with the example rig's finger, as logs that hang on no fit."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from book.chapter_4.logs import PUSHES
from book.companion.simulated_logs import Recipe
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.control.rig_controller import Tracking
from softgrip.control.staircase import staircase
from tests.simulator.rigs import design_1

_FOLDER = TemporaryDirectory()
GAINS = Gains(11.9576, 0.104356, 9.13495, 0.0522317)
"""rad/s by rad: of the least time-weighted error on what steps of the example rig identify."""


@cache
def push_log(name):
    """Write the log of a push, one of `PUSHES`, and return its path."""
    sizes = {one: getattr(PUSHES[name].rig().pump, one) for one in ("area", "lead")}
    sizes["syringe_volume"] = PUSHES[name].rig().pump.syringe_volume
    rig = replace(design_1(), pump=replace(design_1().pump, **sizes))
    return _written(name, replace(PUSHES[name], rig=lambda: rig))


@cache
def staircase_log():
    """Write the log of a staircase in steps of 10 deg, and return its path."""
    stairs = staircase(period=PERIOD)
    pid = PID(GAINS, limits=(-SPEED_LIMIT, SPEED_LIMIT))
    recipe = Recipe(
        lambda: Tracking(pid, stairs),
        "a staircase",
        duration=(stairs.size - 1) * PERIOD,
        reference=stairs[:, None],
        rig=design_1,
    )
    return _written("staircase", recipe)


def _written(name, recipe):
    path = Path(_FOLDER.name) / f"{name}.csv"
    recipe.write(path, "the example rig")
    return path
