"""Drawings of Chapter 3: the beam that stands for the finger, a chamber cut out, the test bench."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.companion.exhibit import figure
from book.companion.finger_drawing import AIR, RUBBER, bent, draw_finger, six_chambers, smooth
from book.companion.machine import (
    METAL,
    box,
    callout,
    canvas,
    corners,
    curl,
    pointer,
    shape,
    words,
)
from book.companion.machine_drawings import approximation, beam, bending, on_its_pump, wall
from book.companion.style import BLUE, VERMILION
from softgrip.provenance import Provenance
from softgrip.units import DEG, MM


@figure("3.1", Provenance.PRINTED, drawing=True)
def figure_3_1() -> Figure:
    """Draw the finger, and the beam that stands for it."""
    drawn, axes = canvas((-12, 164), (-97, 36))
    approximation(axes, 0j)
    return drawn


CHAMBER_ENLARGED = 1.7
"""A chamber that was cut out."""


def _chamber(axes: Any, at: complex, *, closed: bool, angle: float = 0.0) -> float:
    """Draw one chamber that was cut out of a finger, enlarged, and return its length, mm."""
    s, unit = six_chambers().section, CHAMBER_ENLARGED / MM
    a, b, t = (unit * x for x in (s.top, s.bottom, s.wall))
    length = float(unit * six_chambers().chamber_length + 2 * t)
    parts = [(-1j * b, length + 0j, RUBBER), (1j * (a - t), length + 1j * a, RUBBER),
             (0j, length + 1j * (a - t), AIR)]  # fmt: skip
    if closed:
        parts += [(0j, t + 1j * (a - t), RUBBER), (length - t + 0j, length + 1j * (a - t), RUBBER)]
    for low, high, colour in parts:
        outline = at + bent(smooth(corners(low, high)), length, angle)
        shape(axes, outline, colour)
    return length


@figure("3.2", Provenance.PRINTED, drawing=True)
def figure_3_2() -> Figure:
    """Draw a chamber cut out, opened, closed and inflated, and how an angle is measured."""
    drawn, axes = canvas((-14, 158), (-190, 34))
    finger = six_chambers()
    wall(axes, 0j, -10, 26)
    draw_finger(axes, finger)
    middle = finger.length / MM / 2
    box(axes, middle - 16 - 7j, middle + 2 + 23j, "none", ec=VERMILION, ls="--", lw=1.4)
    cases = (("(b) open", False, 0.0), ("(c) closed", True, 0.0), ("(d) inflated", True, 26 * DEG))
    for k, (name, closed, angle) in enumerate(cases):
        at = 8 + 50 * k - 62j
        length = _chamber(axes, at, closed=closed, angle=angle)
        words(axes, at + length / 2 + (23j if not angle else 14j - 2), "$P$", fontsize=10)
        for side in (-1, 1):
            edge = at + length / 2 + side * length / 2 + 14j
            if not angle:
                tail, head = (-12, -5) if closed else (-4, 8)
                pointer(axes, edge + side * tail, edge + side * head, colour=BLUE)
        if angle:
            curl(axes, at - 1 + 14j, 10, 2.5, 3.8, colour=VERMILION)
            curl(axes, at + length - 1 + 8j, 12, 0.5, -0.9, colour=VERMILION)
            words(axes, at + length + 16 + 4j, "$T$", fontsize=10)
        words(axes, at + length / 2 - (18 if angle else 14) * 1j, name)
    words(axes, middle - 12j, "(a)")
    bending(axes, finger, 60 * DEG, -120j)
    words(axes, 30 - 172j, "(e)")
    return drawn


@figure("3.4", Provenance.PRINTED, drawing=True)
def figure_3_4() -> Figure:
    """Draw the beam with its load and its angle."""
    drawn, axes = canvas((-14, 146), (-84, 34))
    angle = 50 * DEG
    tip = bending(axes, beam(six_chambers().section), angle)
    outward = 1j * np.exp(-1j * angle)
    start, end = tip + 38 * outward, tip + 21 * outward
    pointer(axes, start, end, colour=VERMILION)
    words(axes, start - 8 + 4j, "$F(P)$", fontsize=11)
    return drawn


@figure("3.8", Provenance.PRINTED, drawing=True)
def figure_3_8() -> Figure:
    """Draw the bench on which torque and angle are measured."""
    drawn, axes = canvas((-12, 316), (-140, 92))
    _, root, tip = on_its_pump(axes, 14 * DEG)
    under = tip + 4 - 6j
    box(axes, under - 24 - 4j, under + 14, METAL)
    box(axes, under - 30 - 24j, under + 20 - 4j, METAL)
    words(axes, under - 5 - 14j, "scale")
    callout(axes, root + 40 - 1j, "flex sensor", root + 36 - 34j)
    return drawn
