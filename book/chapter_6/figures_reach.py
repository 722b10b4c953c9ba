"""Figure of Chapter 6 on its idea: the line that one pump reaches, and how it turns."""

import numpy as np
from matplotlib.figure import Figure

from book.chapter_6.plane_of_angles import in_plane
from book.companion.claims import printed
from book.companion.exhibit import figure
from book.companion.style import BLUE, GREY, MEASURED, ORANGE, VERMILION, sheet
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.provenance import Provenance

FREQUENCIES = (0.0, 1.5, 2.0, 3.0)
"""Whose feet are marked, rad/s."""
ZOOM = 9.0
"""Half the width of the second panel, deg."""


@figure("6.G", Provenance.PRINTED)
def figure_6_g() -> Figure:
    """Draw the plane of both angles at rest, and the foot's way through the frequencies."""
    drawn, (left, right) = sheet(2.9, 1, 2)
    asked = 180 * float(printed("6.4-target-of-the-simulation"))  # deg, of both fingers
    target = asked, asked
    rest = in_plane(GRIPPER, 0.0)
    along = np.array([0.0, 130.0])
    for axes in (left, right):
        axes.plot(along * np.cos(rest.turned), along * np.sin(rest.turned), color=BLUE,
                  label="line at rest")  # fmt: skip
        axes.plot(*target, "o", color=MEASURED, label="target")
        axes.set(xlabel="SPA 1 (deg)", aspect="equal")
    foot = rest.foot(target)
    left.plot(*zip(target, foot, strict=True), color=VERMILION, ls="--", label="out of reach")
    left.plot(*foot, "o", color=VERMILION, label="nearest")
    left.set(title="(a)", ylabel="SPA 2 (deg)", xlim=(0, 90), ylim=(0, 90))
    left.legend(loc="lower right", fontsize=8.5, handlelength=1.2)

    feet = in_plane(GRIPPER, np.geomspace(0.02, 50, 300)).foot(target)
    right.plot(*feet, color=VERMILION, lw=1.2, label="foot")
    for frequency in FREQUENCIES:
        here = in_plane(GRIPPER, frequency)
        x, y = here.foot(target)
        right.plot(x, y, "o", ms=4.5, color=VERMILION, label=f"foot at {frequency:g} rad/s")
        right.annotate(f"{frequency:g}", (x, y), (4, 4), textcoords="offset points", fontsize=8.5)
    opened = in_plane(GRIPPER, FREQUENCIES[2])
    path = opened.path(target, np.linspace(0, 2 * np.pi, 181))
    right.plot(*path, color=ORANGE, lw=1.1, ls="-.", label=f"path at {FREQUENCIES[2]:g} rad/s")
    right.axline((0, 0), slope=1, color=GREY, lw=0.8, ls=":")
    near = (asked - ZOOM, asked + ZOOM)
    right.set(title="(b)", xlim=near, ylim=near)
    return drawn
