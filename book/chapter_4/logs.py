"""How the simulated logs of Chapter 4 are made: pushes, two PID controllers, a staircase."""

from dataclasses import replace
from functools import partial

import numpy as np

from book.chapter_4.controllers import controller
from book.chapter_4.pid_gains import FILE
from softgrip.control.pid import PERIOD
from softgrip.control.staircase import staircase
from softgrip.simulator.closed_loop_log import ClosedLoopRecipe, write_closed_loop
from softgrip.simulator.open_loop_log import OpenLoopRecipe, write_open_loop
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import ML, MM, REV, MPa

LARGEST = 0.15 * MPa
"""Gauge pressure at which a push ends, Pa."""


def _push(area: float, lead: float, syringe: float, speed: float, words: str) -> OpenLoopRecipe:
    """Return a push at one speed, from 60 mL of air in the syringe until these are swept."""
    pump = replace(PumpParameters(), area=area, lead=lead, syringe_volume=syringe)
    seconds = 60 * ML / (area * pump.advance * speed) + 1.0
    commands = np.full(round(seconds / PERIOD), speed)
    start = (syringe - 60 * ML) / area
    return OpenLoopRecipe(pump, 0, commands, words, plunger=start, until=LARGEST)


_SMALL, _LARGE, _FAST = 6.61e-4, 16.62e-4, 8 * MM
PUSHES = {
    "push-a": _push(_SMALL, _FAST, 60 * ML, 1.65 * REV, "default set of Figure 4.4"),
    "push-b": _push(_LARGE, _FAST, 200 * ML, 1.65 * REV, "larger syringe of Figure 4.4"),
    "push-c": _push(_SMALL, 2 * MM, 60 * ML, 1.65 * REV, "smaller lead of Figure 4.4"),
    "push-d": _push(_SMALL, _FAST, 60 * ML, 3.30 * REV, "higher speed of Figure 4.4"),
}
_FULL = ClosedLoopRecipe(
    partial(controller, "full"), "full", FILE, "Figure 4.5 (b): 60 deg, PID designed on Eq. (4.15)"
)
CONTROLLED = {
    "pid-actuator": ClosedLoopRecipe(
        partial(controller, "actuator"),
        "actuator",
        FILE,
        "Figure 4.5 (a): 60 deg, PID designed on Eq. (4.14)",
    ),
    "pid-full": _FULL,
    "staircase": replace(
        _FULL,
        words="Figure 4.7: staircase, PID designed on Eq. (4.15)",
        reference=staircase(period=PERIOD),
    ),
}
LOGS = {
    **{name: partial(write_open_loop, recipe) for name, recipe in PUSHES.items()},
    **{name: partial(write_closed_loop, recipe) for name, recipe in CONTROLLED.items()},
}
"""What writes each log, by name, to a path, with the command that makes it."""
