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


@figure("6.8", Provenance.SIMULATED)
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
        axes.set(xlabel="time (s)", ylabel="force (N)", xlim=(0, 5))
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
    place.set(xlim=(0, 5))
    panels["a"].legend(loc="lower left", handlelength=1)
    panels["b"].legend(loc="upper right")
    place.legend(loc="center right")
    return drawn
