"""Parts of the machine as they are drawn, in mm: syringe pump, hose, gauge, board, dimensions.

A place is a complex number, x and 1j times y. What the dissertation prints of a part is drawn to
scale; what it does not, has the size of such parts.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Polygon
from matplotlib.path import Path

from book.companion.block_diagram import arrow, finish
from book.companion.claims import printed
from book.companion.finger_drawing import AIR, RUBBER, draw_finger, six_chambers
from book.companion.style import BLACK, GREY, WIDTH, sheet
from softgrip.pump.parts import SCREWS, SYRINGES, Screw, Syringe
from softgrip.tactile.element_table import PYRAMID_CUT
from softgrip.tactile.pad_layout import ELEMENT_SIDE, PAD_SIZE, THREE_TWO_THREE
from softgrip.units import MM

METAL, GLASS, CIRCUIT, MOTOR_COLOUR = "#C9CDD2", "#EEF5F9", "#CDE8DD", "#B4B9C0"
INK, VELOSTAT = "#8A8F96", "#5A5A5A"
"""The conductive skin of an element, and the foil of the force layer."""
SMALL = 9.5
"""Size of the letters at a part, points."""
MOTOR = 42.3
"""Side of a NEMA 17 motor, by its standard."""


def canvas(across: tuple[float, float], up: tuple[float, float]) -> tuple[Figure, Any]:
    """Return a figure of the book's width and axes on which a mm is as long up as across."""
    drawn, axes = sheet(WIDTH * (up[1] - up[0]) / (across[1] - across[0]))
    finish(axes, across, up)
    return drawn, axes


def shape(axes: Any, corners: Iterable[complex], colour: str, **look: Any) -> None:
    """Draw a closed shape."""
    places = [(z.real, z.imag) for z in corners]
    given: dict[str, Any] = {"fc": colour, "ec": BLACK, "lw": 0.9}
    axes.add_patch(Polygon(places, **given | look))


def corners(low: complex, high: complex) -> list[complex]:
    """Return the corners of a rectangle from its lower left and its upper right one."""
    return [low, complex(high.real, low.imag), high, complex(low.real, high.imag)]


def box(axes: Any, low: complex, high: complex, colour: str, **look: Any) -> None:
    """Draw a rectangle from its lower left corner to its upper right one."""
    shape(axes, corners(low, high), colour, **look)


def line(axes: Any, *places: complex, colour: str = GREY, **look: Any) -> None:
    """Draw a thin line through places."""
    axes.plot(np.real(places), np.imag(places), **{"color": colour, "lw": 0.8} | look)


def pointer(axes: Any, *places: complex, colour: str = GREY, style: str = "-|>") -> None:
    """Draw a line through places with its head at the last one, such as a signal or a force."""
    arrow(axes, *((z.real, z.imag) for z in places), colour=colour, style=style)


def words(axes: Any, at: complex, text: str, **look: Any) -> None:
    """Write about a place."""
    given = {"ha": "center", "va": "center", "fontsize": SMALL, "linespacing": 1.25}
    axes.text(at.real, at.imag, text, **given | look)


def callout(axes: Any, at: complex, text: str, place: complex, **look: Any) -> None:
    """Write at a place what is at another, with a thin line between them."""
    line(axes, at, place, zorder=4)
    line(axes, at, marker="o", ms=2.2, zorder=4)
    words(axes, place, text, zorder=5, bbox={"fc": "white", "ec": "none", "pad": 1.2}, **look)


def dimension(
    axes: Any, start: complex, end: complex, text: str, *, aside: float = 0.0, colour: str = GREY
) -> None:
    """Draw a dimension line between two places, moved to its left by `aside`, and its text.

    The text stands beyond the line on that side.
    """
    along = (end - start) / abs(end - start)
    left = 1j * along
    ends = start + aside * left, end + aside * left
    for place, moved in zip((start, end), ends, strict=True):
        if aside:
            line(axes, place, moved, colour=colour)
    heads = {"arrowstyle": "<|-|>", "mutation_scale": 6, "lw": 0.8, "shrinkA": 0, "shrinkB": 0}
    first, last = ((z.real, z.imag) for z in ends)
    axes.annotate("", last, first, arrowprops={**heads, "color": colour})
    side = left if aside >= 0 else -left
    upright = abs(side.real) > abs(side.imag)
    words(
        axes, sum(ends) / 2 + 2.2 * side, text, color=BLACK,
        ha=("left" if side.real > 0 else "right") if upright else "center",
        va="center" if upright else ("bottom" if side.imag > 0 else "top"),
    )  # fmt: skip


def hose(axes: Any, *places: complex) -> None:
    """Draw a hose along Bezier's curve: a start, then two handles and an end for each piece."""
    through = [(z.real, z.imag) for z in places]
    path = Path(through, [Path.MOVETO, *[Path.CURVE4] * (len(places) - 1)])
    for colour, width in ((BLACK, 4.4), (AIR, 2.8)):
        look = {"fc": "none", "ec": colour, "lw": width, "capstyle": "butt", "zorder": 0.9}
        axes.add_patch(PathPatch(path, **look))


def curl(
    axes: Any, at: complex, radius: float, start: float, end: float, colour: str = GREY
) -> None:
    """Draw an arc about a place with its head at its end; start and end in rad."""
    turned = at + radius * np.exp(1j * np.linspace(start, end, 40))
    pointer(axes, *turned, colour=colour)


def gauge(axes: Any, at: complex, letter: str = "P", radius: float = 8.0) -> None:
    """Draw a sensor about a place."""
    axes.add_patch(Circle((at.real, at.imag), radius, fc="white", ec=BLACK, lw=0.9))
    words(axes, at, letter)


def device(axes: Any, at: complex, text: str, size: complex, colour: str = CIRCUIT) -> None:
    """Draw a board or a computer about its middle."""
    box(axes, at - size / 2, at + size / 2, colour)
    words(axes, at, text)


@dataclass(frozen=True)
class Ports:
    """Where a pump is joined to others, mm."""

    nozzle: complex
    """Where the air leaves it."""
    motor: complex
    """Middle of the motor's upper edge."""
    slider: complex
    """Middle of the slider."""
    barrel: complex
    """Middle of the air in the syringe."""


def syringe(axes: Any, at: complex, made: Syringe, pushed: float) -> complex:
    """Draw a lying syringe with its flange's middle at a place, and return its nozzle's end.

    Args:
        axes: Of matplotlib, with equal scales.
        at: Where its axis leaves the barrel.
        made: Its bore and stroke.
        pushed: Part of the stroke that is done, 0 to 1.
    """
    stroke, bore = made.stroke / MM, float(np.sqrt(4 * made.area / np.pi)) / MM
    radius, wall, seal = bore / 2, 1.5, 6.0
    face = at + seal + pushed * stroke
    end = at + seal + stroke
    box(axes, at - 1j * (radius + wall), end + 2 * wall + 1j * (radius + wall), GLASS)
    box(axes, face - 1j * radius, end + 1j * radius, AIR, lw=0)
    rod = at - (1 - pushed) * stroke - 12
    box(axes, rod - 2j, face - seal + 2j, METAL)
    box(axes, face - seal - 1j * radius, face + 1j * radius, GREY)
    box(axes, at - 2 - 1j * (radius + 6), at + 1j * (radius + 6), GLASS)
    tip = end + 2 * wall
    shape(axes, (tip - 4j, tip + 10 - 2.5j, tip + 10 + 2.5j, tip + 4j), GLASS)
    return tip + 10


def screw(axes: Any, start: complex, length: float, made: Screw, radius: float = 4.0) -> None:
    """Draw a lying screw with as many turns of its thread as its lead gives."""
    box(axes, start - 1j * radius, start + length + 1j * radius, METAL)
    lead = made.lead / MM
    for k in range(int(length / lead)):
        low, high = start + k * lead - 1j * radius, start + (k + 0.5) * lead + 1j * radius
        line(axes, low, high, colour=BLACK, zorder=1)


def pump(
    axes: Any,
    at: complex = 0j,
    pushed: float = 0.45,
    *,
    made: Syringe = SYRINGES[0],
    turned_by: Screw = SCREWS[0],
) -> Ports:
    """Draw a linear actuator that drives a syringe above it.

    Bore and stroke of the syringe, lead of the screw and size of the motor are to scale; that the
    syringe stands above the screw, and all else, is ours.

    Args:
        axes: Of matplotlib, with equal scales.
        at: Lower left corner.
        pushed: Part of the stroke that is done, 0 to 1.
        made, turned_by: Syringe and screw.
    """
    stroke = made.stroke / MM
    axis = at + MOTOR + 1j * MOTOR / 2
    flange = axis + stroke + 28 + 34j
    box(axes, at + MOTOR - 1, flange + stroke + 1j * (at.imag + 6 - flange.imag), METAL)
    for foot in (flange + 6, flange + stroke - 18):
        box(axes, complex(foot.real, at.imag + 6), foot + 8, METAL)
    box(axes, at, at + MOTOR + 1j * MOTOR, MOTOR_COLOUR)
    screw(axes, axis, stroke + 34, turned_by)
    slider = axis + 16 + pushed * stroke
    box(axes, slider - 9 - 15j, slider + 9 + 9j, METAL)
    box(axes, slider - 3 + 9j, slider + 3 + 38j, METAL)
    nozzle = syringe(axes, flange, made, pushed)
    middle = flange + 6 + (1 + pushed) / 2 * stroke
    return Ports(nozzle, at + MOTOR / 2 + 1j * MOTOR, slider, middle)


@dataclass(frozen=True)
class Hand:
    """Where a gripper is joined to others, mm."""

    inlet: complex
    """Where the hose enters it."""
    roots: tuple[complex, complex]
    """Of the left and the right finger, on their neutral surfaces."""
    tips: tuple[complex, complex]


def gripper(
    axes: Any,
    at: complex,
    angles: tuple[float, float],
    *,
    length: float | None = None,
    gap: float = 76.0,
) -> Hand:
    """Draw two fingers that hang from a block about a place, with one hose for both.

    The fingers are to scale; the block, and how far apart they stand, are ours.

    Args:
        axes: Of matplotlib, with equal scales.
        at: Middle of the block's lower edge.
        angles: Of the left and the right finger, rad.
        length: Of the fingers, mm; without it they are those of Design 1.
        gap: Between their neutral surfaces, mm.
    """
    box(axes, at - gap / 2 - 24, at + gap / 2 + 24 + 22j, METAL)
    shape_of = six_chambers(None if length is None else length * MM)
    roots = at - gap / 2, at + gap / 2
    tips = tuple(
        draw_finger(axes, shape_of, angle, root=root, heading=-1j, mirrored=left)
        for root, angle, left in zip(roots, angles, (True, False), strict=True)
    )
    box(axes, roots[0] - 4 + 9j, roots[1] + 4 + 13j, AIR, lw=0)
    for low in (roots[0] - 4, roots[1]):
        box(axes, low, low + 4 + 9j, AIR, lw=0)
    box(axes, at - 2 + 13j, at + 2 + 22j, AIR, lw=0)
    return Hand(at + 22j, roots, (tips[0], tips[1]))


PAD_LAYERS = (
    ("rubber", 1.6, RUBBER),
    ("fabric", 0.4, METAL),
    ("Velostat", 0.4, VELOSTAT),
    ("fabric ", 0.4, METAL),
    ("base", 0.9, RUBBER),
)
"""Of the pad from the bottom, with heights in mm, which are not printed but for their sum."""


def pad(axes: Any, at: complex, scale: float = 1.0) -> dict[str, complex]:
    """Draw the pad of Chapter 2 cut along its length, and return a place in each of its parts.

    Length, height and elements are to scale; the heights of the layers are not printed.

    Args:
        axes: Of matplotlib, with equal scales.
        at: Lower left corner.
        scale: By how much it is enlarged.
    """
    length, side = PAD_SIZE[0] / MM, ELEMENT_SIDE / MM
    height, tall = (float(printed(f"2.2-{part}-height")) for part in ("pad", "element"))
    found, y = {}, 0.0

    def part(x: float, low: float, wide: float, thick: float, colour: str) -> None:
        corner = at + scale * complex(x, low)
        box(axes, corner, corner + scale * complex(wide, thick), colour, lw=0.6)

    for name, thick, colour in PAD_LAYERS:
        part(0, y, length, thick, colour)
        found[name] = at + scale * complex(length - 1, y + thick / 2)
        y += thick
    cover = height - 1.2
    for x in (0.0, length - 1.5):
        part(x, y, 1.5, cover - y, RUBBER)
    for place in np.unique(THREE_TWO_THREE.places[:3, 0]) / MM:
        middle = at + scale * complex(length / 2 + place, y)
        foot, top = scale * side / 2, scale * PYRAMID_CUT * side / 2
        up = 1j * scale * tall
        shape(axes, (middle - foot, middle - top + up, middle + top + up, middle + foot), INK)
        found["element"] = middle + up / 2
    part(0, cover, length, height - cover, RUBBER)
    found["cover"] = at + scale * complex(length - 1, (cover + height) / 2)
    return found
