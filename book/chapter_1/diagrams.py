"""Drawing of Chapter 1: the machine, and which chapter is about which of its parts."""

from matplotlib.figure import Figure
from matplotlib.patches import Circle

from book.companion.exhibit import figure
from book.companion.machine import (
    callout,
    canvas,
    device,
    gauge,
    gripper,
    hose,
    pad,
    pointer,
    pump,
    words,
)
from book.companion.style import BLUE, GREEN
from softgrip.provenance import Provenance
from softgrip.units import DEG

ENLARGED = 2.5
"""The pad, beside the rest."""


@figure("1.1", Provenance.PRINTED, drawing=True)
def figure_1_1() -> Figure:
    """Draw the gripper on its pump, the loop around them, and the pad."""
    drawn, axes = canvas((-12, 328), (-210, 104))
    driven = pump(axes, 0j)
    held = gripper(axes, 212 - 74j, (38 * DEG, 36 * DEG))
    axes.add_patch(Circle((212, -136), 21, fc="#F3E3B3", ec="black", lw=0.9))
    tee = 252 - 20j
    hose(axes, driven.nozzle, driven.nozzle + 40, tee + 70, tee)
    hose(axes, tee, tee - 20, held.inlet + 20j, held.inlet)
    gauge(axes, tee)

    board = 88 - 68j
    device(axes, board, "controller", 72 + 24j)
    pointer(axes, board - 36, 21 - 68j, 21 + 0j, colour=BLUE)
    pointer(axes, tee - 8, 104 - 20j, 104 - 56j, colour=GREEN)
    pointer(axes, 150 - 68j, 124 - 68j, colour=GREEN)

    callout(axes, 21 + 36j, "stepper motor", 26 + 58j)
    callout(axes, 70 + 24j, "screw", 80 + 44j)
    callout(axes, driven.barrel + 8, "air in a syringe", driven.barrel + 8 + 34j)
    callout(axes, tee + 6 - 5j, "pressure\nsensor", tee + 46 - 22j)
    callout(axes, held.roots[1] + 13 - 1.5j, "rubber", 302 - 84j)
    callout(axes, held.roots[1] - 7.8 - 46j, "flex sensor", 300 - 124j)

    cut = pad(axes, -6 - 190j, ENLARGED)
    callout(axes, cut["element"], "feels where", 92 - 161j)
    callout(axes, cut["Velostat"], "feels how hard", 66 - 203j)

    for place, numbers, what in (
        (88 + 88j, "Chapter 4", "the pump"),
        (268 - 189j, "Chapters 3 and 5", "a finger, and how it moves"),
        (88 - 95j, "Chapter 6", "one command,\ntwo fingers"),
        (24 - 144j, "Chapter 2", "a pad that feels"),
    ):
        words(axes, place, numbers, fontsize=9.5, weight="bold", va="bottom")
        words(axes, place, what, va="top")
    return drawn
