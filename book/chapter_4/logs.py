"""How the simulated logs of Chapter 4 are made: pushes, two PID controllers, a staircase."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from book.chapter_4.controllers import Name, controller
from book.chapter_4.pid_gains import FILE
from book.companion.choices import choice
from book.companion.simulated_logs import Recipe, step_of, tracked
from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.control.staircase import staircase
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.parameters import PumpParameters, RigParameters
from softgrip.units import ML, MM, REV, MPa

LARGEST = 0.15 * MPa
"""Gauge pressure at which a push ends, Pa."""


def _push(area: float, lead: float, syringe: float, speed: float, words: str) -> Recipe:
    """Return a push at one speed, from 60 mL of air in the syringe until these are swept."""
    sizes = {"area": area, "lead": lead, "syringe_volume": syringe}
    pump = PumpParameters(**sizes)
    seconds = 60 * ML / (area * pump.advance * speed) + 1.0

    def rig() -> RigParameters:
        own = design_1()
        return replace(own, pump=replace(own.pump, **sizes))

    return Recipe(
        np.full(round(seconds / PERIOD), speed),
        words,
        rig=rig,
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


def _stairs() -> Floats:
    increment = choice("stair_increment")
    return staircase(increment=increment, top=6 * increment, period=PERIOD)


def _pid(design: Name, words: str, reference: Callable[[], Floats]) -> Recipe:
    return tracked(partial(controller, design), design, FILE, words, reference=reference)


_step = partial(step_of, "pid_step")


CONTROLLED = {
    "pid-actuator": _pid("actuator", "Figure 4.5 (a): PID designed on Eq. (4.14)", _step),
    "pid-full": _pid("full", "Figure 4.5 (b): PID designed on Eq. (4.15)", _step),
    "staircase": _pid("full", "Figure 4.7: staircase, PID designed on Eq. (4.15)", _stairs),
}
LOGS = {name: recipe.write for name, recipe in (PUSHES | CONTROLLED).items()}
"""What writes each log, by name, to a path, with the command that makes it."""
