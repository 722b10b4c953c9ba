"""How the simulated logs of Chapter 5 are made: seven steps of two fingers to two angles each."""

from book.companion.simulated_logs import Recipe
from softgrip.simulator.calibration import design_1, design_3
from softgrip.simulator.steps import step_commands
from softgrip.units import MM

RUNS = 7
STEP_PLUNGER = {60: 11.1 * MM, 90: 25.3 * MM}
STEP_PLUNGER_FX = {60: 24.1 * MM, 90: 39.2 * MM}
"""Travel of the plunger that settles the median finger at about these angles, deg: of Dragon Skin
20, and of FX-Pro. They are `steps.travel_to`, to a tenth of a millimetre."""

STEPS = {
    f"{name}-{degrees}-{run + 1}": Recipe(
        step_commands(plunger),
        f"open-loop step to about {degrees} deg{finger}",
        rig=design,
        run=run,
    )
    for name, travels, design, finger in (
        ("step", STEP_PLUNGER, design_1, ""),
        ("step-fx", STEP_PLUNGER_FX, design_3, " of the finger of Dragon Skin FX-Pro"),
    )
    for degrees, plunger in travels.items()
    for run in range(RUNS)
}
LOGS = {name: recipe.write for name, recipe in STEPS.items()}
"""What writes each log, by name, to a path, with the command that makes it."""
