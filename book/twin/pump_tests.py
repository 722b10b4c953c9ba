"""The pushes of Chapter 4 on many rigs: how far off its pressure models are, in percent."""

import numpy as np

from book.chapter_4.pushed import ASSUMED
from book.twin.laboratory import Laboratory
from book.twin.pressure_models import filtered_pressure, fitted_capacity, modified_pressure
from book.twin.step_tests import Measures
from softgrip.units import ML, MM, REV, MPa

SETS = {
    "b": (16.62e-4, 8 * MM, 200 * ML, 1.65 * REV),
    "c": (6.61e-4, 2 * MM, 60 * ML, 1.65 * REV),
    "d": (6.61e-4, 8 * MM, 60 * ML, 3.30 * REV),
}
"""Area, lead, syringe and speed of Figure 4.4 (b) to (d)."""


def pushes(lab: Laboratory) -> Measures:
    """Return the errors of the pressure models, %: above zero where the model is above the truth.

    Figure 4.4 (a) for the constant, the modified and the filtered capacity; (b) to (d) for the
    filtered one, its size: the text has no sign for it.
    """
    levels, below = ASSUMED, lab["choice.capacity_below"] * MPa
    found: Measures = {}
    for name in ("a", *SETS):
        push = lab.default_push if name == "a" else lab.push(*SETS[name])
        capacity = fitted_capacity(push, below)
        if name == "a":
            found["constant"] = push.error(push.swept / capacity[:, None])
            found["modified"] = push.error(modified_pressure(push, capacity))
        held = filtered_pressure(push, capacity, levels, lab["choice.filter_factor"])
        found[f"filtered-{name}"] = np.abs(push.error(held))
    return {name: 100 * error for name, error in found.items()}


FAST = {"pushes": pushes}
