"""Drawings of Chapter 2: elements under load, the classifier's code, the loop of the gripper."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from book.companion.block_diagram import arrow, block, finish, sum_point, words
from book.companion.exhibit import figure
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, sheet
from softgrip.provenance import Provenance
from softgrip.tactile.element_table import PYRAMID_CUT

RUBBER = "#E8EEF4"


def _profiles() -> dict[str, Any]:
    """Return the side views, corners (x, y), 2 wide and 1 high."""
    turn = np.linspace(0, np.pi, 60)
    return {
        "cylinder": np.array([(-1, 0), (-1, 1), (1, 1), (1, 0)]),
        "hemisphere": np.stack([np.cos(turn), np.sin(turn)], axis=1),
        "pyramid": np.array([(-1, 0), (-PYRAMID_CUT, 1), (PYRAMID_CUT, 1), (1, 0)]),
    }


@figure("2.4", Provenance.PRINTED, drawing=True)
def figure_2_4() -> Figure:
    """Draw the elements under load."""
    drawn, axes = sheet(2.1)
    y = 0.45
    for k, (name, corners) in enumerate(_profiles().items()):
        middle = 3.0 * k
        axes.add_patch(Polygon(corners + np.array((middle, 0)), fc=RUBBER, ec=BLACK, lw=1.2))
        half = {
            "cylinder": 1.0,
            "hemisphere": (1 - y**2) ** 0.5,
            "pyramid": 1 - (1 - PYRAMID_CUT) * y,
        }[name]
        axes.plot((middle - half, middle + half), (y, y), color=BLUE, lw=1.8)
        axes.text(middle, y + 0.05, "$A(y)$", color=BLUE, ha="center", va="bottom", fontsize=9)
        arrow(axes, (middle, 1.6), (middle, 1.02), colour=VERMILION)
        axes.text(middle + 0.12, 1.4, "$F$", color=VERMILION)
        axes.text(middle, -0.62, name, ha="center", va="top")
    axes.plot((-1.3, 7.3), (0, 0), color=GREY, lw=1.4)
    arrow(axes, (-1.35, 0.0), (-1.35, 1.0), style="<|-|>")
    axes.text(-1.5, 0.5, "$L$", ha="right", va="center")
    arrow(axes, (5.0, -0.25), (7.0, -0.25), style="<|-|>")
    axes.text(6, -0.3, "$w$", ha="center", va="top")
    arrow(axes, (1.3, 0.0), (1.3, y), style="<|-|>", colour=BLUE)
    axes.text(1.38, y / 2, "$y$", color=BLUE, va="center")
    finish(axes, (-1.9, 7.4), (-1.0, 1.75))
    return drawn


@figure("2.6", Provenance.PRINTED, drawing=True)
def figure_2_6() -> Figure:
    """Draw the classifier's input and output."""
    drawn, axes = sheet(1.8)
    axes.text(0.75, 0, "$V = [v_1, \\ldots, v_8]^T$\n$0 \\leq v_i \\leq 1$", ha="center",
              va="center", linespacing=1.8)  # fmt: skip
    arrow(axes, (1.9, 0), (2.55, 0))
    block(axes, 3.35, 0, "classifier", BLUE, width=1.6)
    codes = (("point", "1\\ 0\\ 0", ORANGE), ("line", "0\\ 1\\ 0", GREEN),
             ("surface", "0\\ 0\\ 1", VERMILION))  # fmt: skip
    for row, (kind, code, colour) in enumerate(codes):
        height = 0.8 * (1 - row)
        arrow(axes, (4.15, 0.2 * (1 - row)), (5.0, height), colour=colour)
        axes.text(5.1, height, f"{kind}: $C_f = [{code}]^T$", va="center", color=BLACK)
    finish(axes, (-0.5, 7.6), (-1.2, 1.2))
    return drawn


@figure("2.12", Provenance.PRINTED, drawing=True)
def figure_2_12() -> Figure:
    """Draw the scheme of the force control."""
    drawn, axes = sheet(2.2)
    arrow(axes, (-0.1, 2), (0.6, 2), colour=BLUE)
    block(axes, 1.45, 2, "$F_l / 2\\mu$", BLUE, width=1.7)
    arrow(axes, (2.3, 2), (3.06, 2), colour=BLUE)
    sum_point(axes, 3.2, 2)
    arrow(axes, (3.34, 2), (4.0, 2))
    block(axes, 4.5, 2, "PD", BLUE, width=1.0)
    arrow(axes, (5.0, 2), (5.7, 2))
    block(axes, 6.65, 2, "servomotor", GREY, width=1.9)
    arrow(axes, (7.6, 2), (8.3, 2), (8.3, 0.5), (7.6, 0.5))
    block(axes, 6.65, 0.5, "object", GREY, width=1.9)
    arrow(axes, (5.7, 0.5), (5.0, 0.5))
    block(axes, 4.5, 0.5, "pad", GREEN, width=1.0)
    arrow(axes, (4.0, 0.5), (3.2, 0.5), (3.2, 1.86), colour=GREEN)
    words(axes, (
        (0.15, 2.25, "$F_l$"), (2.65, 2.25, "$F_c$"), (3.65, 2.25, "$e$"), (5.33, 2.25, "$C$"),
        (8.05, 2.25, "$P$"), (3.6, 0.75, "$F_m$"), (3.0, 1.65, "$-$"),
    ))  # fmt: skip
    finish(axes, (-0.2, 8.5), (0, 2.6))
    return drawn
