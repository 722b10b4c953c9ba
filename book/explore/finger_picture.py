"""Fingers beside a plot, which bend by what it shows."""

from collections.abc import Sequence
from typing import Any

from book.companion.finger_drawing import AIR, RUBBER, side_view, six_chambers
from book.companion.style import GREY
from book.explore.plot import Bent, From, Outline, Panel
from softgrip.units import MM

LENGTH = six_chambers().length / MM
"""Of Design 1, mm (Section 3.4)."""
ACROSS, UP = (-44, 100), (-84, 28)
"""Room for a finger that leaves the origin to the right and bends downwards, mm."""


def _finger(angle: From, **how: Any) -> list[Bent]:
    """Return rubber and air of a finger of six chambers."""
    return [
        Bent(
            [corner.real / MM for corner in corners],
            [corner.imag / MM for corner in corners],
            angle,
            LENGTH,
            colour=colour,
            **how,
        )
        for corners, colour in zip(side_view(six_chambers()), (RUBBER, AIR), strict=True)
    ]


def finger(angle: str, time: str = "", times: From = 1.0, share: float = 0.36) -> Panel:
    """Return a finger that leaves a wall to the right and bends downwards.

    Args:
        angle, time, times: As of `Bent`.
        share: As of `Panel`.
    """
    wall = Outline([-8, 0, 0, -8], [-8, -8, 24, 24], colour=GREY, fill=0.5)
    bent = _finger(angle, time=time, times=times)
    return Panel([wall, *bent], x=ACROSS, y=UP, share=share, equal=True, bare=True)


def gripper(angles: Sequence[str], time: str, colours: Sequence[str], share: float = 0.36) -> Panel:
    """Return two fingers that hang from a block and bend inwards; each has its colour at its root.

    Args:
        angles: Of the left and the right finger, deg.
        time: As of `Bent`.
        colours: Of both.
        share: As of `Panel`.
    """
    half = 50.0
    marks: list[Bent | Outline] = [
        Outline([-78, 78, 78, -78], [0, 0, 16, 16], colour=GREY, fill=0.5)
    ]
    for angle, colour, side in zip(angles, colours, (-1, 1), strict=True):
        root, left = side * half, side < 0
        marks += _finger(angle, time=time, hanging=root, mirrored=left)
        ends = sorted((root - side * 4, root + side * 20))
        marks.append(Outline([ends[0], ends[1], ends[1], ends[0]], [2, 2, 8, 8], colour=colour,
                             fill=0.9))  # fmt: skip
    return Panel(marks, x=(-84, 84), y=(-104, 22), share=share, equal=True, bare=True)
