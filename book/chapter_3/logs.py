"""How the simulated logs of Chapter 3 are made: the regulators of Figure 3.12."""

from functools import partial

from book.chapter_3.regulators import FILE, regulator
from book.companion.simulated_logs import step_of, tracked

RECIPES = {
    f"lqr-{design}": tracked(
        partial(regulator, design),
        f"lqr {design}",
        FILE,
        words,
        reference=partial(step_of, "lqr_step"),
    )
    for design, words in (
        ("printed", "Figure 3.12: LQR with the weights of Eq. (3.29)"),
        ("fast", "Figure 3.12: LQR made faster"),
    )
}
LOGS = {name: recipe.write for name, recipe in RECIPES.items()}
"""What writes each log, by name, to a path, with the command that makes it."""
