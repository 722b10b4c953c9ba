"""One style: readable at 400 px, safe for colour-blind readers, the same colour for the same thing.

The colours are those of Okabe and Ito, which stay apart under the common kinds of colour
blindness; lines differ in dash too, so that they stay apart in grey.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"
GREY = "#767676"

MEASURED = BLACK
"""What was measured (or stands in for it), in all chapters."""
PRINTED = GREY
"""What the dissertation prints."""
LINEAR = ORANGE
"""The linear model."""
LUDWICK = BLUE
"""The model by Ludwick's law."""
OTHER = GREEN
"""A model of ours, for comparison."""

WIDTH = 4.8
"""Width of every figure in inches: scaled to a screen of 400 px, its text is still 9 px high."""

SETTINGS: dict[Any, Any] = {
    "figure.figsize": (WIDTH, 3.4),
    "figure.dpi": 150,
    "figure.constrained_layout.use": True,
    "font.family": "DejaVu Sans",
    "font.size": 10.5,
    "axes.labelsize": 10.5,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "legend.fontsize": 9.5,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "lines.linewidth": 1.6,
    "lines.markersize": 5.5,
    "savefig.facecolor": "white",
    "svg.fonttype": "path",
    # Without a fixed salt the ids inside an SVG differ from run to run.
    "svg.hashsalt": "softgrip",
}


@contextmanager
def style() -> Iterator[None]:
    """Draw in the style of the book, and leave the reader's own settings as they were."""
    with mpl.rc_context(SETTINGS):
        yield


def sheet(height: float, rows: int = 1, columns: int = 1, **shared: Any) -> tuple[Figure, Any]:
    """Return a figure of the book's width, ``height`` inches high, and its axes.

    They are one, or an array of several; ``shared`` is as for `Figure.subplots`.
    """
    drawn = Figure(figsize=(WIDTH, height))
    return drawn, drawn.subplots(rows, columns, **shared)


def still(height: float, *, left: float = 0.14) -> tuple[Figure, Any]:
    """Return a figure and its axes for frames that are shown one after the other.

    The axes keep their place, where a layout engine would move them from frame to frame; and a
    frame is drawn in half the time.

    Args:
        height: Inches.
        left: Room for the labels on the left, as a part of the width.
    """
    with mpl.rc_context({"figure.constrained_layout.use": False}):
        figure = Figure(figsize=(WIDTH, height))
    axes = figure.subplots()
    figure.subplots_adjust(left=left, right=0.97, bottom=0.5 / height, top=1 - 0.3 / height)
    return figure, axes
