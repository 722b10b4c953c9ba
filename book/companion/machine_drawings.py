"""What several chapters draw of the machine, in mm: a finger as a beam, how it bends, its pump."""

from typing import Any

import numpy as np

from book.companion.finger_drawing import AIR, RUBBER, draw_finger, six_chambers
from book.companion.machine import (
    METAL,
    Ports,
    box,
    callout,
    curl,
    device,
    dimension,
    gauge,
    hose,
    line,
    pointer,
    pump,
    words,
)
from book.companion.style import BLUE, GREEN, VERMILION
from softgrip.actuator.finger_mesh import FingerShape
from softgrip.actuator.section import Section
from softgrip.units import MM


def beam(section: Section) -> FingerShape:
    """Return the cantilever that stands for a finger: one chamber along the whole length."""
    return FingerShape(section)


def wall(axes: Any, at: complex, low: float = -14.0, high: float = 30.0) -> None:
    """Draw what a finger is clamped in, to the left of a place."""
    box(axes, at - 8 + 1j * low, at + 1j * high, METAL)


def approximation(axes: Any, at: complex, *, solid: bool = False) -> None:
    """Draw a finger with its chambers above the beam that stands for it, and both sections.

    Args:
        axes: Of matplotlib, with equal scales.
        at: Base of the upper one, on its neutral surface.
        solid: Whether the beam is taken as a block of its height, or as one long chamber.
    """
    shape = six_chambers()
    s, length = shape.section, shape.length / MM
    a, b, w, t = (x / MM for x in (s.top, s.bottom, s.width, s.wall))
    low, beside = at - 62j, length + 36
    for place in (at, low):
        wall(axes, place, -b - 6, a + 6)
    draw_finger(axes, shape, root=at)
    words(axes, at + length / 2 + (a + 9) * 1j, "finger: six chambers")
    pointer(axes, at + length / 2 - 8j, at + length / 2 - 24j)
    if solid:
        box(axes, low - 1j * b, low + length + 1j * a, RUBBER)
    else:
        draw_finger(axes, beam(s), root=low)
    words(axes, low + length / 2 - (b + 25) * 1j, "cantilever beam")
    dimension(axes, low - 1j * b, low + length - 1j * b, "$L$", aside=-5)
    for place, full in ((at, False), (low, solid)):
        middle = place + beside
        box(axes, middle - w / 2 - 1j * b, middle + w / 2 + 1j * a, RUBBER)
        if not full:
            box(axes, middle - w / 2 + t, middle + w / 2 - t + 1j * (a - t), AIR, lw=0.6)
        neutral = middle + (a - b) / 2 * 1j if full else middle
        line(axes, neutral - w / 2 - 4, neutral + w / 2 + 4, ls="--")
    left, right = low + beside - w / 2, low + beside + w / 2
    if solid:
        dimension(axes, left - 1j * b, right - 1j * b, "$b$", aside=-5)
        dimension(axes, right - 1j * b, right + 1j * a, "$h$", aside=-5)
    else:
        dimension(axes, left - 1j * b, right - 1j * b, "$w$", aside=-5)
        dimension(axes, right, right + 1j * a, "$a$", aside=-5)
        dimension(axes, right - 1j * b, right, "$b$", aside=-5)


def bending(axes: Any, shape: FingerShape, angle: float, at: complex = 0j) -> complex:
    """Draw a finger that is clamped on the left and bends down, with its angle; return its tip.

    Args:
        axes: Of matplotlib, with equal scales.
        shape: The finger.
        angle: By which its tip turns, rad.
        at: Its base, on the neutral surface.
    """
    wall(axes, at)
    length = shape.length / MM
    tip = draw_finger(axes, shape, angle, root=at)
    # Tangents at both ends meet where the angle between them is seen.
    corner = at + length / angle * np.tan(angle / 2)
    ahead = np.exp(-1j * angle)
    radius = abs(tip - corner) + 18
    line(axes, at, corner + radius + 6, ls="--")
    line(axes, corner, corner + (radius + 6) * ahead, ls="--")
    curl(axes, corner, radius, 0, -angle)
    words(axes, corner + (radius + 7) * np.exp(-0.5j * angle), "$\\theta$", fontsize=11)
    return tip


def pump_with_symbols(axes: Any, at: complex) -> Ports:
    """Draw the pump with the symbols of Eq. (4.1) to (4.5)."""
    ports = pump(axes, at)
    middle = ports.motor - 21j
    curl(axes, middle, 13, 2.6, -0.9, colour=VERMILION)
    words(axes, middle, "$\\omega_m$", fontsize=11)
    pitch = middle + 21.1 + 12j
    dimension(axes, pitch + 8 + 0j, pitch + 16 + 0j, "$l$", aside=4)
    push = ports.slider + 12 + 13j
    pointer(axes, push, push + 22, colour=VERMILION)
    words(axes, push + 28, "$v_s$", ha="left", fontsize=10)
    words(axes, ports.barrel, "$A$", fontsize=11)
    out = ports.nozzle + 4 + 12j
    pointer(axes, out - 8, out + 12, colour=BLUE)
    words(axes, out + 2 + 7j, "$Q_i$", fontsize=10)
    return ports


def on_its_pump(axes: Any, angle: float) -> tuple[Ports, complex, complex]:
    """Draw a finger on its pump with both sensors, board and computer.

    Returns:
        tuple: Of the pump, where the finger is clamped, and its tip.
    """
    ports = pump(axes)
    root = 150 - 62j
    wall(axes, root)
    tip = draw_finger(axes, six_chambers(), angle, root=root)
    tap = 112 - 24j
    hose(axes, ports.nozzle, ports.nozzle + 46, 306 - 18j, 250 - 18j, 200 - 18j, 160 - 24j, tap,
         tap - 30, root - 50 + 2j, root - 8 + 2j)  # fmt: skip
    gauge(axes, tap)
    callout(axes, tap + 4 + 7j, "pressure sensor", tap + 48 + 13j)
    mega, host = 44 - 62j, 44 - 116j
    device(axes, mega, "Arduino", 66 + 22j)
    device(axes, host, "computer", 66 + 22j, "#E6E8EC")
    pointer(axes, mega - 28 + 11j, 16 + 0j, colour=BLUE)
    pointer(axes, host + 11j, mega - 11j, style="<|-|>")
    words(axes, (mega + host) / 2 + 6, "USB", ha="left")
    pointer(axes, tap - 8, mega + 14 + 38j, mega + 14 + 11j, colour=GREEN)
    pointer(axes, root - 8 - 6j, 77 - 68j, colour=GREEN)
    return ports, root, tip
