"""Blocks, sums and arrows of block diagrams: patches alone, which hold no numbers."""

from collections.abc import Iterable
from typing import Any

from matplotlib.patches import Circle, FancyArrowPatch, Rectangle
from matplotlib.path import Path

from book.companion.style import GREY

LINE = 1.4
SUM_RADIUS = 0.14
"""Of the circle of a sum, in the units of the axes."""


def block(
    axes: Any,
    x: float,
    y: float,
    text: str,
    colour: str,
    *,
    width: float = 1.5,
    height: float = 0.7,
) -> None:
    """Draw a block about a middle."""
    corner = (x - width / 2, y - height / 2)
    axes.add_patch(Rectangle(corner, width, height, fc="white", ec=colour, lw=LINE))
    axes.text(x, y, text, ha="center", va="center", fontsize=9)


def sum_point(axes: Any, x: float, y: float) -> None:
    """Draw the circle in which signals add up."""
    axes.add_patch(Circle((x, y), SUM_RADIUS, fc="white", ec=GREY, lw=LINE))


def arrow(axes: Any, *points: tuple[float, float], colour: str = GREY, style: str = "-|>") -> None:
    """Draw a line through points, with its head at the last."""
    axes.add_patch(
        FancyArrowPatch(
            path=Path(points),
            arrowstyle=style,
            mutation_scale=10,
            color=colour,
            lw=LINE,
            fill=False,
        )
    )


def words(axes: Any, labels: Iterable[tuple[float, float, str]]) -> None:
    """Write signals' names at their places."""
    for x, y, text in labels:
        axes.text(x, y, text, ha="center", va="center")


def finish(axes: Any, across: tuple[float, float], up: tuple[float, float]) -> None:
    """Set the view, and take the axes away."""
    axes.set(xlim=across, ylim=up, aspect="equal")
    axes.set_axis_off()
