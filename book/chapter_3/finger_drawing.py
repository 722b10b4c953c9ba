"""The finger as it looks: its cross-section, and its side view when it is bent."""

from typing import Any

import numpy as np
from matplotlib.patches import Polygon, Rectangle

from book.companion.style import GREY, SKY
from softgrip.actuator.section import Section
from softgrip.arrays import Floats
from softgrip.units import MM

RUBBER = "#F2D7C4"


def draw_section(axes: Any, section: Section) -> None:
    """Draw Figure 3.3 (c) and (d): rubber, chamber and neutral surface, in mm.

    Args:
        axes: Of matplotlib, with equal scales.
        section: Its dimensions, m.
    """
    a, b, w, t = (x / MM for x in (section.top, section.bottom, section.width, section.wall))
    axes.add_patch(Rectangle((-w / 2, -b), w, a + b, facecolor=RUBBER, edgecolor="black"))
    axes.add_patch(Rectangle((-w / 2 + t, 0), w - 2 * t, a - t, facecolor=SKY, alpha=0.5, lw=0))
    axes.plot([-w / 2, w / 2], [0, 0], color=GREY, ls="--", lw=1, label="neutral surface")
    axes.text(0, (a - t) / 2, "air", ha="center", va="center")


def bent_outline(section: Section, length: float, angle: float, points: int = 60) -> Floats:
    """Return the side view of a finger bent to an arc, m, shape (2 points, 2).

    It hangs from the origin, along the x axis when straight, and bends downwards; the neutral
    surface keeps the length given.

    >>> straight = bent_outline(Section(0.02, 0.004, 0.03, 0.0015), 0.1, 0.0, points=2)
    >>> straight.tolist()
    [[0.0, 0.02], [0.1, 0.02], [0.1, -0.004], [0.0, -0.004]]
    """
    turned = np.linspace(0.0, angle, points)
    along = np.linspace(0.0, length, points)
    # sinc keeps the arc exact as the angle goes to zero.
    x = along * np.sinc(turned / np.pi)
    y = -along * np.sin(turned / 2) * np.sinc(turned / 2 / np.pi)
    normal = np.column_stack([np.sin(turned), np.cos(turned)])
    line = np.column_stack([x, y])
    return np.concatenate([line + section.top * normal, (line - section.bottom * normal)[::-1]])


def draw_bent(
    axes: Any, section: Section, length: float, angle: float, color: str, label: str
) -> None:
    """Draw the side view of a bent finger, in mm; arguments as of `bent_outline`."""
    outline = bent_outline(section, length, angle) / MM
    axes.add_patch(Polygon(outline, facecolor=color, edgecolor="black", lw=0.6, alpha=0.55))
    # A patch alone would not be among the figure's numbers.
    axes.plot(outline[:, 0], outline[:, 1], color=color, lw=0.8, label=label)
