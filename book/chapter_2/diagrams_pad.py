"""Drawings of Chapter 2: skin and pad, the pad's parts, the bench on which it was tried."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Ellipse

from book.companion.claims import printed
from book.companion.exhibit import figure
from book.companion.finger_drawing import RUBBER
from book.companion.machine import (
    INK,
    METAL,
    VELOSTAT,
    box,
    callout,
    canvas,
    device,
    dimension,
    pad,
    pointer,
    shape,
    words,
)
from book.companion.style import BLUE, GREEN, PURPLE, VERMILION
from softgrip.provenance import Provenance
from softgrip.tactile.element_table import PYRAMID_CUT
from softgrip.tactile.pad_layout import ELEMENT_SIDE, PAD_SIZE, THREE_TWO_THREE
from softgrip.units import MM

LENGTH, WIDE = (size / MM for size in PAD_SIZE)
SIDE = ELEMENT_SIDE / MM


@figure("2.1", Provenance.PRINTED, drawing=True)
def figure_2_1() -> Figure:
    """Draw skin in section beside the pad in section, layer by layer."""
    drawn, axes = canvas((-18, 114), (-34, 50))
    across, crest = np.linspace(0, 44, 200), 11.0
    border = across + 1j * (20 + 3.4 * np.cos(2 * np.pi * across / crest))
    shape(axes, [0 - 24j, 44 - 24j, *border[::-1]], "#F3C9B4", lw=0.7)
    shape(axes, [*border, 44 + 32j, 0 + 32j], "#F9E8DC", lw=0.7)
    for k in range(1, 4):  # in the crests of the dermis, and between them
        axes.add_patch(Ellipse((crest * k, 19.6), 2.6, 4.4, fc="white", ec=PURPLE, lw=1.2))
    for k in range(4):
        axes.add_patch(Circle((crest * (k + 0.5), 18.3), 1.1, fc=BLUE, ec="none"))
    for radius in (6.5, 4.8, 3.1, 1.4):
        axes.add_patch(Ellipse((22, -12), 2 * radius, 1.4 * radius, fc="white", ec=GREEN, lw=1))
    callout(axes, 5.5 + 18.3j, "Merkel:\nshape and place", 6 + 42j)
    callout(axes, 33 + 20j, "Meissner:\nlight touch", 40 + 42j)
    callout(axes, 22 - 12j, "Pacini: vibration", 22 - 30j)
    words(axes, -2 + 15j, "upper\ndermis", ha="right")
    words(axes, -2 - 12j, "lower\ndermis", ha="right")
    cut = pad(axes, 62 - 2j, 1.1)
    pointer(axes, 45 + 17j, 54 + 17j, cut["element"] - 25.5 + 1j, colour=BLUE)
    pointer(axes, 45 - 12j, 54 - 12j, cut["Velostat"] - 42.5, colour=GREEN)
    words(axes, 84 + 14j, "feature-detection layer", color=BLUE)
    words(axes, 84 - 8j, "force-measurement layer", color=GREEN)
    return drawn


@figure("2.2", Provenance.PRINTED, drawing=True)
def figure_2_2() -> Figure:
    """Draw the parts of the pad one above the other, and the finished pad from above."""
    drawn, axes = canvas((-8, 122), (-42, 46))
    for y, thick, colour in (
        (32, 3.0, RUBBER), (8, 3.0, RUBBER), (-6, 1.4, METAL), (-14, 1.4, VELOSTAT),
        (-22, 1.4, METAL), (-33, 4.0, RUBBER),
    ):  # fmt: skip
        box(axes, 1j * y, LENGTH + 1j * (y + thick), colour)
    for x in (0.0, LENGTH - 2):
        box(axes, x + 11j, x + 2 + 20j, RUBBER)
    half, top = SIDE / 2, PYRAMID_CUT * SIDE / 2
    for place in THREE_TWO_THREE.places[:3, 0] / MM:
        foot = LENGTH / 2 + place + 11j
        shape(axes, (foot - half, foot - top + 3j, foot + top + 3j, foot + half), INK)
    for high, name in ((33.5, "1"), (12, "2"), (-5.3, "4"), (-13.3, "5"), (-21.3, "4"), (-31, "3")):
        words(axes, LENGTH + 4 + 1j * high, name, ha="left", fontsize=10)
    words(axes, -5 + 43j, "(a)", ha="left")

    corner = 68 - 2j
    box(axes, corner, corner + LENGTH + 1j * WIDE, RUBBER)
    for x, y in THREE_TWO_THREE.places / MM:
        middle = corner + LENGTH / 2 + x + 1j * (WIDE / 2 + y)
        for size, colour in ((half, INK), (top, "white")):
            box(axes, middle - size * (1 + 1j), middle + size * (1 + 1j), colour, lw=0.6)
    end = corner + LENGTH
    dimension(axes, corner, end, f"{LENGTH:g}", aside=-3)
    dimension(axes, end, end + 1j * WIDE, f"{WIDE:g}", aside=-3)
    pad(axes, 68 - 32j)
    height = printed("2.2-pad-height")
    dimension(axes, 108 - 32j, 108 + (height - 32) * 1j, f"{height:g}", aside=-3)
    words(axes, 58 + 43j, "(b)", ha="left")
    return drawn


@figure("2.10", Provenance.PRINTED, drawing=True)
def figure_2_10() -> Figure:
    """Draw the gripper with the pad on one jaw, and the way of its signals."""
    drawn, axes = canvas((-14, 214), (-94, 50))
    box(axes, 0 + 14j, 84 + 30j, METAL)
    box(axes, 16 + 30j, 68 + 46j, "#B4B9C0")
    words(axes, 42 + 38j, "servomotor")
    for x in (4, 70):
        box(axes, x - 62j, x + 10 + 14j, METAL)
    box(axes, 14 - 58j, 22 - 18j, RUBBER)
    for y in (-27, -38, -49):
        shape(axes, (22 + 1j * (y - 3), 25 + 1j * (y - 1), 25 + 1j * (y + 1), 22 + 1j * (y + 3)),
              INK)  # fmt: skip
    box(axes, 25 - 58j, 26.2 - 18j, RUBBER)
    box(axes, 58 - 58j, 70 - 18j, RUBBER)
    axes.add_patch(Ellipse((42, -38), 31.6, 40, fc="#F3E3B3", ec="black", lw=0.9))
    words(axes, 42 - 38j, "object")
    callout(axes, 18 - 56j, "pad", 18 - 76j)
    callout(axes, 64 - 56j, "rubber", 66 - 76j)

    amplifiers, bridge = 128 - 20j, 128 - 56j
    board, host = 188 - 20j, 188 - 76j
    device(axes, amplifiers, "eight\namplifiers", 48 + 22j, "#E6E8EC")
    device(axes, bridge, "bridge, one\namplifier", 48 + 22j, "#E6E8EC")
    device(axes, board, "Arduino\nMEGA", 40 + 26j)
    device(axes, host, "computer", 40 + 22j, "#E6E8EC")
    pointer(axes, 4 - 30j, -10 - 30j, -10 - 90j, 90 - 90j, 90 - 20j, amplifiers - 24, colour=BLUE)
    pointer(axes, 4 - 50j, -4 - 50j, -4 - 84j, 97 - 84j, 97 - 56j, bridge - 24, colour=GREEN)
    pointer(axes, amplifiers + 24, board - 20, colour=BLUE)
    pointer(axes, bridge + 24, 178 - 56j, 178 - 33j, colour=GREEN)
    pointer(axes, board - 13j + 14, host + 11j + 14, colour=BLUE)
    pointer(axes, board + 13j, 188 + 38j, 68 + 38j, colour=VERMILION)
    return drawn
