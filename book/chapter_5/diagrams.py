"""Drawings of Chapter 5: the beam that stands for the finger, how it bends, the test bench."""

import numpy as np
from matplotlib.figure import Figure

from book.companion.block_diagram import arrow, block, finish, sum_point
from book.companion.block_diagram import words as signals
from book.companion.exhibit import figure
from book.companion.finger_drawing import bent, six_chambers
from book.companion.machine import (
    callout,
    canvas,
    curl,
    line,
    words,
)
from book.companion.machine_drawings import approximation, bending, on_its_pump
from book.companion.style import BLUE, GREEN, GREY, WIDTH
from softgrip.provenance import Provenance
from softgrip.units import DEG, MM


@figure("5.3", Provenance.PRINTED, drawing=True)
def figure_5_3() -> Figure:
    """Draw the finger, and the solid beam that stands for it."""
    drawn, axes = canvas((-12, 164), (-97, 36))
    approximation(axes, 0j, solid=True)
    return drawn


@figure("5.4", Provenance.PRINTED, drawing=True)
def figure_5_4() -> Figure:
    """Draw the angle of a finger under pressure, and the arc that it is."""
    drawn, axes = canvas((-24, 136), (-96, 34))
    shape, angle = six_chambers(), 70 * DEG
    tip = bending(axes, shape, angle)
    radius = shape.length / MM / angle
    centre = -1j * radius
    for end in (0j, tip):
        line(axes, centre, end, colour=BLUE, ls=":")
    line(axes, centre, colour=BLUE, marker="o", ms=3)
    curl(axes, centre, 18, np.pi / 2, np.pi / 2 - angle)
    words(axes, centre + 25 * np.exp(1j * (np.pi - angle) / 2), "$\\theta$", fontsize=10)
    words(axes, centre / 2 - 3, "$L_0 / \\theta$", ha="right", fontsize=10)
    (middle,) = bent([0.45 * shape.length], shape.length, angle) / MM
    callout(axes, middle, "neutral surface,\nlength $L_0$", 27 - 34j)
    return drawn


@figure("5.5", Provenance.PRINTED, drawing=True)
def figure_5_5() -> Figure:
    """Draw the bench, and the loop that is closed around it."""
    drawn = Figure(figsize=(WIDTH, 5.0))
    upper, lower = drawn.subplots(2, 1, height_ratios=(1.3, 3.7))
    arrow(upper, (0, 1), (0.86, 1), colour=BLUE)
    sum_point(upper, 1, 1)
    arrow(upper, (1.14, 1), (1.7, 1))
    block(upper, 2.6, 1, "controller", BLUE, width=1.8)
    arrow(upper, (3.5, 1), (4.1, 1))
    block(upper, 4.9, 1, "pump", GREY, width=1.6)
    arrow(upper, (5.7, 1), (6.4, 1))
    block(upper, 7.2, 1, "finger", GREY, width=1.6)
    arrow(upper, (8.0, 1), (9.2, 1))
    arrow(upper, (8.5, 1), (8.5, 0), (8.1, 0), colour=GREEN)
    block(upper, 7.2, 0, "flex sensor", GREEN, width=1.9, height=0.6)
    arrow(upper, (6.25, 0), (1, 0), (1, 0.86), colour=GREEN)
    signals(upper, ((0.3, 1.25, "$\\theta_d$"), (6.05, 1.25, "$P$"), (8.9, 1.25, "$\\theta$"),
                    (0.75, 0.68, "$-$")))  # fmt: skip
    finish(upper, (-0.1, 9.4), (-0.4, 1.5))
    _, root, _ = on_its_pump(lower, 60 * DEG)
    callout(lower, root + 28 - 7j, "flex sensor", root + 14 - 46j)
    finish(lower, (-12, 316), (-140, 84))
    return drawn
