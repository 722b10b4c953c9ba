"""How the simulated logs of Chapter 5 are made: seven steps of two fingers to two angles each."""

from collections.abc import Callable
from functools import partial

from book.companion.simulated_logs import Recipe
from softgrip.arrays import Floats
from softgrip.reads import remembered
from softgrip.simulator.fitted_rigs import design_1, design_3
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.steps import step_commands, travel_to
from softgrip.units import DEG, MM

RUNS = 7
ANGLES = (60, 90)
"""deg."""


@remembered
def step_plunger(design: Callable[[], RigParameters], degrees: int) -> float:
    """Return the travel of the plunger that ends a median finger's step at about an angle, m.

    To a tenth of a millimetre.
    """
    return round(travel_to(design(), degrees * DEG) / (0.1 * MM)) * 0.1 * MM


def _commands(design: Callable[[], RigParameters], degrees: int) -> Floats:
    return step_commands(step_plunger(design, degrees))


STEPS = {
    f"{name}-{degrees}-{run + 1}": Recipe(
        partial(_commands, design, degrees),
        f"open-loop step to about {degrees} deg{finger}",
        rig=design,
        run=run,
    )
    for name, design, finger in (
        ("step", design_1, ""),
        ("step-fx", design_3, " of the finger of Dragon Skin FX-Pro"),
    )
    for degrees in ANGLES
    for run in range(RUNS)
}
LOGS = {name: recipe.write for name, recipe in STEPS.items()}
"""What writes each log, by name, to a path, with the command that makes it."""
