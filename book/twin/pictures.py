"""Pictures of the page *One rig for all numbers*."""

from collections.abc import Callable, Mapping

import matplotlib as mpl
import numpy as np
from IPython.display import SVG
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from book.companion.save import svg
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, WIDTH, sheet, style
from book.twin import outcomes, study, walk
from book.twin.fitted import best_rig, ensemble
from book.twin.misfit import chosen
from book.twin.prediction import chapter
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
    what = {one.id: f"{one.section.removeprefix('Section ')}: {one.what}" for one in chosen()}
    rows = [one for one in study.TABLES["predictions"].read() if one.interval.actual]
    drawn, axes = sheet(0.2 * len(rows) + 1.0)
    for row, one in enumerate(rows):
        own = one.interval
        low, middle, high = (x / own.actual for x in (own.low, own.middle, own.high))
        colour, dash = (BLUE, "-") if own.holds else (VERMILION, ":")
        axes.plot([low, high], [row, row], color=colour, ls=dash, lw=2)
        axes.plot(middle, row, "o", color=colour, ms=3)
    axes.axvline(1, color=BLACK, lw=0.8)
    axes.set_yticks(range(len(rows)), [shortened(what[one.id]) for one in rows], fontsize=7)
    axes.set(xscale="symlog", xlim=(-1, 30), ylim=(len(rows) - 0.5, -0.5))
    axes.set_xlabel("predicted over printed")
    return drawn


HEAD, TAIL = 20, 26
"""Characters of a long label that are left at its two ends."""


def shortened(text: str) -> str:
    """Return a label whose middle is left out if it is long."""
    if len(text) <= HEAD + TAIL:
        return text
    return f"{text[:HEAD].rstrip()} … {text[-TAIL:].lstrip()}"


SHOWN = {
    "rubber.power": "power n",
    "finger.full_angle": "angle at 0.15 MPa",
    "finger.frequency": "frequency",
    "finger.damping_ratio": "damping ratio",
    "rubber.memory_slow": "slow memory",
    "rubber.friction": "dry friction",
    "finger.rest_volume": "volume at rest",
    "gas.dead_volume": "dead volume",
    "pump.acceleration_limit": "motor's ramp",
    "spread.stiffness": "spread of stiffness",
}
"""Parameters of a rig of the walk that are drawn."""
FURTHEST = 8.0
"""Errors, beyond which a miss is drawn at the edge."""


def powers() -> list[float]:
    """Return the powers of the rigs of the walk, as its slider shows them."""
    column = ensemble()[walk.places(), [*space()].index("rubber.power")]
    return [float(f"{value:.3f}") for value in column]


def draw_walk(power: float) -> Figure:
    """Draw a rig of the walk: its parameters in their ranges, and its misses chapter by chapter.

    Args:
        power: One of `powers`.
    """
    place = powers().index(power)
    rig = dict(zip(space(), ensemble()[walk.places()[place]], strict=True))
    at = {one.id: chapter(one) for one in chosen()}
    given: dict[int, list[float]] = {number: [] for number in sorted(set(at.values()))}
    for one in study.TABLES["walk"].read():
        if one.place == place:
            given[at[one.id]].append(one.errors)
    with style(), mpl.rc_context({"figure.constrained_layout.use": False}):
        # Axes at fixed places: a layout engine would move them from frame to frame.
        drawn = Figure(figsize=(WIDTH, 3.2))
        left = drawn.add_axes((0.24, 0.17, 0.24, 0.73))
        right = drawn.add_axes((0.62, 0.17, 0.36, 0.73))
        _draw_parameters_of(left, rig)
        _draw_misses(right, given)
    return drawn


def _draw_parameters_of(axes: Axes, rig: Mapping[str, float]) -> None:
    shares = [float(space()[name].share(rig[name])) for name in SHOWN]
    axes.barh(range(len(SHOWN)), shares, color=BLUE, height=0.6)
    axes.set_yticks(range(len(SHOWN)), [*SHOWN.values()], fontsize=8)
    axes.set(xlim=(0, 1), ylim=(len(SHOWN) - 0.5, -0.5), xlabel="share of the range")


def _draw_misses(axes: Axes, given: Mapping[int, list[float]]) -> None:
    axes.axvspan(-1, 1, color="#E3E3E3")
    for row, own in enumerate(given.values()):
        errors, at = np.array(own), row + np.linspace(-0.3, 0.3, len(own))
        inside = np.abs(errors) <= 1
        for which, colour, mark in ((inside, BLUE, "o"), (~inside, VERMILION, "x")):
            drawn = np.clip(errors[which], -FURTHEST, FURTHEST)
            axes.plot(drawn, at[which], mark, color=colour, ms=4)
    every = np.abs(np.concatenate([*given.values()])) <= 1
    axes.set_yticks(range(len(given)), [f"Chapter {number}" for number in given], fontsize=8)
    axes.set(
        xlim=(-FURTHEST - 0.5, FURTHEST + 0.5), ylim=(len(given) - 0.5, -0.5),
        xlabel="miss (errors)",
    )  # fmt: skip
    axes.set_title(f"{every.sum()} of {every.size} within their errors", fontsize=9.5)


def show(draw: Callable[[], Figure]) -> SVG:
    """Show a picture in the book's style."""
    with style():
        return SVG(svg(draw()))  # type: ignore[no-untyped-call]
