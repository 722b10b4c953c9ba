"""Figure of Chapter 6 on the grasp, in place of photographs."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from book.chapter_6.figures_rig import SIDES
from book.chapter_6.grasps import DRIVES, STIFFNESS, Grasp, grasp
from book.companion.exhibit import figure
from book.companion.style import BLUE, GREEN, GREY, ORANGE, VERMILION, WIDTH
from softgrip.provenance import Provenance
from softgrip.units import MM


def _hand(axes: Any, held: Grasp) -> None:
    """Draw fingers and disc at the end of a grasp, mm."""
    length, gap = held.contact.length, held.contact.gap
    along = np.linspace(0, 1, 60)
    for k, (side, colour, dash) in enumerate(SIDES):
        turned = held.angles[k, -1] * along
        radius, sign = length / held.angles[k, -1], 1 - 2 * k
        across = sign * (radius * (1 - np.cos(turned)) - gap / 2)
        down = -radius * np.sin(turned)
        look = {"color": colour, "lw": 5, "solid_capstyle": "round", "label": side}
        axes.plot(across / MM, down / MM, dash, **look)
    centre = (held.place[-1] / MM, -held.contact.depth / MM)
    axes.add_patch(Circle(centre, held.contact.disc.radius / MM, fc="#F3E3C3", ec=GREY, zorder=0))
    axes.axhline(0, color=GREY, lw=4)
    axes.set(aspect="equal", xlim=(-75, 75), ylim=(-105, 8), xlabel="mm", ylabel="mm")


@figure(
    "6.8",
    caption="Grasps of an elastic disc of 40 mm. The dissertation shows four *photographs* here, "
    "of a sliced banana, a mochi, an empty bottle and a toy; this is *simulated*. (a) The grasp of "
    "a soft disc (50 N/m), at its end. (b) Force of the left finger from a soft disc to a stiff "
    "one (2000 N/m), coordinated by the scheme of Figure 6.3 for 2/s: it goes for angles that the "
    "disc bars, so that the force grows until it is stopped; a disc without damping rattles. (c) "
    "The same with one fast push and no coordination: the force holds. (d) How far the disc (200 "
    "N/m) is pushed aside by the finger that comes first, by each drive; with two equal fingers it "
    "stays.",
    alt="Above, a drawing of two bent fingers that hold a disc between them, the disc slightly "
    "right of the middle. Middle, forces over time: with the scheme they start at about 1.3 "
    "seconds and keep growing, with the push they start earlier and settle. Below, the place of "
    "the disc: every drive pushes it about 1.3 millimetres to the right.",
    provenance=Provenance.SIMULATED,
)
def figure_6_8() -> Figure:
    """Draw grasps of soft and stiff discs."""
    drawn = Figure(figsize=(WIDTH, 7.6))
    panels = drawn.subplot_mosaic([["a", "a"], ["b", "c"], ["d", "d"]], height_ratios=(1.5, 1, 1))
    push, scheme = list(DRIVES)[-2:]
    for axes, drive in ((panels["b"], scheme), (panels["c"], push)):
        looks = zip(STIFFNESS.items(), (ORANGE, GREEN, BLUE), ("-", "--", "-."), strict=True)
        for (name, stiffness), colour, dash in looks:
            held = grasp(stiffness, drive)
            axes.plot(held.time, held.forces[0], dash, color=colour, label=name)
        axes.set(xlabel="time (s)", ylabel="force (N)", xlim=(0, 5), ylim=(-0.02, 0.9))
    _hand(panels["a"], grasp(STIFFNESS["soft"], scheme))
    drives = zip(DRIVES, (ORANGE, VERMILION, BLUE), ("-", "--", "-."), strict=True)
    place = panels["d"]
    for drive, colour, dash in drives:
        held = grasp(STIFFNESS["medium"], drive)
        place.plot(held.time, held.place / MM, dash, color=colour, label=drive)
    equal = grasp(STIFFNESS["medium"], scheme, equal=True)
    place.plot(equal.time, equal.place / MM, ":", color=GREY, label="equal fingers")
    panels["a"].set_title("(a) soft disc, held")
    panels["b"].set_title("(b) coordinated")
    panels["c"].set_title("(c) one fast push")
    place.set(title="(d) disc pushed aside", xlabel="time (s)", ylabel="place (mm)")
    place.set(xlim=(0, 5), ylim=(-0.2, 2.6))
    panels["a"].legend(loc="lower left", handlelength=1)
    panels["b"].legend(loc="upper right")
    place.legend(loc="upper left", ncols=2)
    return drawn
