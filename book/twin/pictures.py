"""Pictures of the page *One rig for all numbers*."""

from collections.abc import Callable

import numpy as np
from IPython.display import SVG
from matplotlib.figure import Figure

from book.companion.save import svg
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, sheet, style
from book.twin import outcomes, study
from book.twin.fitted import best_rig, ensemble
from book.twin.misfit import chosen
from book.twin.recipes import ALL
from book.twin.space import Parameter, space
from softgrip.arrays import Floats

POWERS = {"Table 5.1": 2.5, "estimated": 2.365, "Table 5.2": 2.174, "linear models": 1.0}
"""What is printed of n of Dragon Skin 20, and where."""
NEAR = (5.0, 10.0)
"""Deviations that are marked, %."""


def percents(name: str) -> Floats:
    """Return how far a rig is off each target that is not zero, % of the print, sorted.

    Args:
        name: A field of `outcomes.Outcome`: "before", "best" or "nearest".
    """
    pairs = zip(outcomes.KEPT.read(), chosen(ALL), strict=True)
    found = [
        100 * abs(getattr(one, name) / target.value - 1) for one, target in pairs if target.value
    ]
    return np.sort(found)


def draw_deviations() -> Figure:
    """Draw the share of the targets over the deviation up to which they are met."""
    drawn, axes = sheet(3.4)
    curves = {
        "before": (GREY, "--", "before the fit"),
        "best": (BLUE, "-", "best rig for all"),
        "nearest": (GREEN, ":", "a rig for each alone"),
    }
    for name, (colour, dash, label) in curves.items():
        values = np.maximum(percents(name), 0.1)
        share = np.arange(1, values.size + 1) / values.size
        axes.step(values, 100 * share, where="post", color=colour, ls=dash, label=label)
    for percent in NEAR:
        axes.axvline(percent, color=BLACK, lw=0.8, ls=":")
    axes.set(
        xscale="log", xlim=(0.1, 1000), ylim=(0, 100),
        xlabel="deviation from the print (%)", ylabel="numbers (%)",
    )  # fmt: skip
    axes.legend(loc="lower right")
    return drawn


def _of_rigs() -> list[Parameter]:
    """Return the parameters of a rig that were fitted, without the choices of the experiments."""
    moved = np.ptp(ensemble(), axis=0) > 0
    known = zip(space().values(), moved, strict=True)
    return [one for one, own in known if own and not one.name.startswith("choice.")]


def draw_parameters() -> Figure:
    """Draw where in their ranges the ensemble's parameters lie."""
    known, rigs, best = _of_rigs(), ensemble(), best_rig()
    names = [*space()]
    drawn, axes = sheet(0.19 * len(known) + 0.8)
    for row, one in enumerate(known):
        k = names.index(one.name)
        low, middle, high = np.percentile(one.share(rigs[:, k]), [5, 50, 95])
        axes.plot([0, 1], [row, row], color="#E3E3E3", lw=4, solid_capstyle="butt")
        axes.plot([low, high], [row, row], color=BLUE, lw=3, solid_capstyle="butt")
        axes.plot(middle, row, "|", color="white", ms=7)
        axes.plot(one.share(best[k]), row, "o", color=VERMILION, ms=4)
    axes.set_yticks(range(len(known)), [one.name for one in known], fontsize=8)
    axes.set(xlim=(0, 1), ylim=(len(known) - 0.5, -0.5), xlabel="share of the declared range")
    axes.grid(visible=False)
    return drawn


def draw_powers() -> Figure:
    """Draw the ensemble's power of the rubber beside what is printed."""
    drawn, axes = sheet(2.8)
    k = [*space()].index("rubber.power")
    axes.hist(ensemble()[:, k], bins=24, color=BLUE, label="ensemble")
    top = axes.get_ylim()[1]
    styles = zip(POWERS.items(), ("-", "--", "-.", ":"), strict=True)
    for (where, value), dash in styles:
        axes.axvline(value, color=ORANGE, ls=dash, label=f"{where}: {value:g}")
    axes.set(xlabel="power n", ylabel="rigs", xlim=(0.95, 3.0), ylim=(0, top))
    axes.legend(loc="upper left")
    return drawn


def draw_predictions() -> Figure:
    """Draw what is predicted of the numbers that had no say, over what is printed."""
    rows = [one for one in study.TABLES["predictions"].read() if one.printed]
    drawn, axes = sheet(0.2 * len(rows) + 1.0)
    for row, one in enumerate(rows):
        low, middle, high = (x / one.printed for x in (one.low, one.middle, one.high))
        colour, dash = (BLUE, "-") if one.holds else (VERMILION, ":")
        axes.plot([low, high], [row, row], color=colour, ls=dash, lw=2)
        axes.plot(middle, row, "o", color=colour, ms=3)
    axes.axvline(1, color=BLACK, lw=0.8)
    axes.set_yticks(range(len(rows)), [one.id for one in rows], fontsize=7)
    axes.set(xscale="symlog", xlim=(-1, 30), ylim=(len(rows) - 0.5, -0.5))
    axes.set_xlabel("predicted over printed")
    return drawn


def show(draw: Callable[[], Figure]) -> SVG:
    """Show a picture in the book's style."""
    with style():
        return SVG(svg(draw()))  # type: ignore[no-untyped-call]
