"""The experiments of the live page: a step and a staircase of Chapter 4, of one moving reference.

The gains are those of `numbers.pid_gains`, designed on the simulated rig: on another rig they are a
first guess, and `python -m book.chapter_4.pid_gains` tells how they were found.
"""

from functools import partial

import numpy as np

from book.chapter_4.controllers import controller
from softgrip.control.pid import PERIOD
from softgrip.control.staircase import staircase
from softgrip.rig.live import LiveExperiment
from softgrip.units import DEG

STEP = 60 * DEG
STEP_FOR = 15.0
"""s."""


def experiments() -> dict[str, LiveExperiment]:
    """Return the experiments by name.

    >>> {name: round(one.duration, 3) for name, one in experiments().items()}
    {'step': 15.0, 'staircase': 15.575}
    """
    full = partial(controller, "full")
    step = np.full(round(STEP_FOR / PERIOD) + 1, STEP)
    found = (
        LiveExperiment("step", step, full, "a step to 60 deg; PID designed on Eq. (4.15)"),
        LiveExperiment(
            "staircase",
            staircase(period=PERIOD),
            full,
            "a staircase as in Figure 4.7; PID of Eq. (4.15)",
        ),
    )
    return {one.name: one for one in found}
