"""How the simulated logs of Chapter 4 are made: pushes, two PID controllers, a staircase."""

from dataclasses import replace
from functools import partial

import numpy as np

from book.chapter_4.controllers import Name, controller
from book.chapter_4.pid_gains import FILE
from book.companion.simulated_logs import Recipe, tracked
from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.control.staircase import staircase
from softgrip.simulator.calibration import design_1
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import ML, MM, REV, MPa

LARGEST = 0.15 * MPa
"""Gauge pressure at which a push ends, Pa."""


def _push(area: float, lead: float, syringe: float, speed: float, words: str) -> Recipe:
    """Return a push at one speed, from 60 mL of air in the syringe until these are swept."""
    pump = replace(PumpParameters(), area=area, lead=lead, syringe_volume=syringe)
    seconds = 60 * ML / (area * pump.advance * speed) + 1.0
    return Recipe(
        np.full(round(seconds / PERIOD), speed),
        words,
        rig=lambda: replace(design_1(), pump=pump),
        plunger=(syringe - 60 * ML) / area,
        until=LARGEST,
    )


_SMALL, _LARGE, _FAST = 6.61e-4, 16.62e-4, 8 * MM
PUSHES = {
    "push-a": _push(_SMALL, _FAST, 60 * ML, 1.65 * REV, "default set of Figure 4.4"),
    "push-b": _push(_LARGE, _FAST, 200 * ML, 1.65 * REV, "larger syringe of Figure 4.4"),
    "push-c": _push(_SMALL, 2 * MM, 60 * ML, 1.65 * REV, "smaller lead of Figure 4.4"),
    "push-d": _push(_SMALL, _FAST, 60 * ML, 3.30 * REV, "higher speed of Figure 4.4"),
}


def _pid(design: Name, words: str, reference: Floats | None = None) -> Recipe:
    return tracked(partial(controller, design), design, FILE, words, reference=reference)


CONTROLLED = {
    "pid-actuator": _pid("actuator", "Figure 4.5 (a): 60 deg, PID designed on Eq. (4.14)"),
    "pid-full": _pid("full", "Figure 4.5 (b): 60 deg, PID designed on Eq. (4.15)"),
    "staircase": _pid(
        "full", "Figure 4.7: staircase, PID designed on Eq. (4.15)", staircase(period=PERIOD)
    ),
}
LOGS = {name: recipe.write for name, recipe in (PUSHES | CONTROLLED).items()}
"""What writes each log, by name, to a path, with the command that makes it."""
