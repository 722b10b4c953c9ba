"""The finger as it looks: its cross-section, and its side view when it is bent.

Along the finger a place is a complex number: how far from the base, and 1j times how high above the
neutral surface. So is one in the plane of the drawing.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.patches import Polygon, Rectangle
from numpy.typing import ArrayLike

from book.companion.style import GREY, PURPLE, SKY
from softgrip.actuator.fem_results import CHAMBERS
from softgrip.actuator.finger_mesh import FingerShape, voids
from softgrip.actuator.printed import table_3_1
from softgrip.actuator.section import Section
from softgrip.arrays import Floats
from softgrip.gripper.inversion import Complex
from softgrip.units import MM

RUBBER = "#F2D7C4"
AIR = "#B9DDF3"
CHANNEL = 4 * MM
"""Height of the air channel that joins the chambers above the neutral surface: not printed."""
GROOVE_FLOOR = CHANNEL + 3 * MM
"""Bottom of the grooves, which leaves rubber above the channel: not printed either."""
SENSOR = 0.5 * MM
"""How far the flex sensor lies below the neutral surface (Section 3.4)."""


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


def bent(places: ArrayLike, length: float, angle: float) -> Complex:
    """Return where places along a finger come to lie when it bends to an arc.

    It starts at the origin along the real axis, and bends downwards; the neutral surface keeps its
    length.

    Args:
        places: Along the straight finger, in the unit of `length`.
        length: Of the finger.
        angle: By which its tip turns, rad.
    """
    places = np.asarray(places, dtype=np.complex128)
    turned = angle * places.real / length
    # sinc keeps the arc exact as the angle goes to zero.
    chord = places.real * np.sinc(turned / 2 / np.pi) * np.exp(-0.5j * turned)
    return np.asarray(chord + 1j * places.imag * np.exp(-1j * turned))


def bent_outline(section: Section, length: float, angle: float, points: int = 60) -> Floats:
    """Return the side view of a finger bent to an arc, m, shape (2 points, 2): see `bent`.

    >>> straight = bent_outline(Section(0.02, 0.004, 0.03, 0.0015), 0.1, 0.0, points=2)
    >>> straight.tolist()
    [[0.0, 0.02], [0.1, 0.02], [0.1, -0.004], [0.0, -0.004]]
    """
    along = np.linspace(0.0, length, points)
    sides = [along + 1j * section.top, along[::-1] - 1j * section.bottom]
    outline = bent(np.concatenate(sides), length, angle)
    return np.column_stack([outline.real, outline.imag])


def draw_bent(
    axes: Any, section: Section, length: float, angle: float, color: str, label: str
) -> None:
    """Draw the side view of a bent finger, in mm; arguments as of `bent_outline`."""
    outline = bent_outline(section, length, angle) / MM
    axes.add_patch(Polygon(outline, facecolor=color, edgecolor="black", lw=0.6, alpha=0.55))
    # A patch alone would not be among the figure's numbers.
    axes.plot(outline[:, 0], outline[:, 1], color=color, lw=0.8, label=label)


def six_chambers(length: float | None = None) -> FingerShape:
    """Return the finger of Table 3.1 with the chambers of Section 6.3, `length` long, m.

    Without a length it is that of Design 1. Caps, grooves and channel are not printed.
    """
    section = table_3_1()["Opt. parameters"]
    shape = FingerShape(section, CHAMBERS, groove_floor=GROOVE_FLOOR)
    return shape if length is None else replace(shape, length=length)


def smooth(corners: ArrayLike) -> Complex:
    """Return a closed line through corners with points so near that it can be bent."""
    ends = np.asarray(corners, dtype=np.complex128)
    part = np.linspace(0, 1, 16, endpoint=False)
    return np.ravel(ends[:, None] + part * (np.roll(ends, -1) - ends)[:, None])


def side_view(shape: FingerShape) -> tuple[list[complex], list[complex]]:
    """Return the corners of the rubber and of the air in a finger cut along its middle, m."""
    chambers, grooves = voids(shape)
    top, bottom = 1j * shape.section.top, -1j * shape.section.bottom
    rubber = [shape.length + top, shape.length + bottom, bottom, top]
    for groove in grooves:
        left, right, floor = groove.low[0], groove.high[0], 1j * groove.low[1]
        rubber += [left + top, left + floor, right + floor, right + top]
    duct = 1j * CHANNEL
    air = [0j, duct]  # from the nozzle on
    for chamber in chambers:
        left, right, roof = chamber.low[0], chamber.high[0], 1j * chamber.high[1]
        air += [left + duct, left + roof, right + roof, right + duct]
    air.append(complex(right))
    return rubber, air


def draw_finger(
    axes: Any,
    shape: FingerShape,
    angle: float = 0.0,
    *,
    root: complex = 0j,
    heading: complex = 1 + 0j,
    mirrored: bool = False,
    air: str = AIR,
) -> complex:
    """Draw a finger cut along its middle, in mm, and return where its tip is.

    Args:
        axes: Of matplotlib, with equal scales.
        shape: The finger, m.
        angle: By which its tip turns, rad.
        root: Place of its base, on the neutral surface, mm.
        heading: Direction of the straight finger, of length one.
        mirrored: Whether it bends to the left of its heading, and not to the right.
        air: Colour of the air in it.
    """

    def placed(outline: ArrayLike) -> Floats:
        found = bent(outline, shape.length, angle) / MM
        found = root + heading * (np.conj(found) if mirrored else found)
        return np.column_stack([found.real, found.imag])

    rubber, inside = side_view(shape)
    look: dict[str, Any] = {"fc": RUBBER, "ec": "black", "lw": 0.9, "joinstyle": "round"}
    axes.add_patch(Polygon(placed(smooth(rubber)), **look))
    axes.add_patch(Polygon(placed(smooth(inside)), fc=air, ec=GREY, lw=0.5))
    sensor = placed(np.linspace(0, shape.length, 40) - 1j * SENSOR)
    axes.plot(*sensor.T, color=PURPLE, lw=1.4, solid_capstyle="butt")
    tip = placed([complex(shape.length)])[0]
    return complex(*tip)
