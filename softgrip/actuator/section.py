"""The cross-section of the finger and the torque that pressure makes in it, Eq. (3.1)-(3.6).

The y axis points from the neutral surface to the top (Figure 3.3). The chamber reaches from the
neutral surface up to ``y = a - t``; two side walls and a top wall of thickness t enclose it, and
solid rubber of thickness b lies below it. The parameters may be floats, arrays of one shape, or
CasADi symbols: the laws hold no test and no branch.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Number
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Section:
    """The dimensions of Figure 3.3 (d), m.

    Attributes:
        top: a, from the neutral surface to the top, > t.
        bottom: b, from the neutral surface to the bottom, > 0. Torque bends towards the bottom if b
            > t.
        width: w, > 2 t.
        wall: t, > 0.

    >>> from softgrip.units import MM, MPa
    >>> design_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)
    >>> round(torque(design_1, 0.25 * MPa), 3)
    0.51
    """

    top: Number
    bottom: Number
    width: Number
    wall: Number

    @property
    def height(self) -> Number:
        """Height h = a + b, m."""
        return self.top + self.bottom


def check_section(section: Section) -> None:
    """Raise InvalidInputError unless the dimensions, as numbers or arrays, form a chamber."""
    a, b, w, t = (
        np.asarray(value, dtype=np.float64)
        for value in (section.top, section.bottom, section.width, section.wall)
    )
    for name, value in (("wall", t), ("bottom", b), ("top", a), ("width", w)):
        if not (np.isfinite(value).all() and (value > 0).all()):
            raise InvalidInputError(name, expected="a finite length > 0, m", got=value.tolist())
    if not (w > 2 * t).all():
        raise InvalidInputError(
            "wall", expected=f"less than half the width, {w.tolist()} m", got=t.tolist()
        )
    if not (a > t).all():
        raise InvalidInputError(
            "wall", expected=f"less than the height above neutral, {a.tolist()} m", got=t.tolist()
        )


def chamber_area(section: Section) -> Number:
    """Return A_c, m^2: the yellow area of Figure 3.3 (c)."""
    return (section.top - section.wall) * (section.width - 2 * section.wall)


def wall_area(section: Section) -> Number:
    """Return A_w, m^2: side walls, top wall and the rubber below the chamber.

    It is the denominator ``b w + w t + 2 a t - 2 t**2`` of Eq. (3.3).
    """
    a, b, w, t = section.top, section.bottom, section.width, section.wall
    return w * (b + t) + 2 * t * (a - t)


def wall_stress_ratio(section: Section) -> Number:
    """Return ``P_w / P``, Eq. (3.3), by which the forces along the finger, Eq. (3.1), balance.

    >>> round(wall_stress_ratio(Section(20.0, 4.0, 30.0, 1.5)), 4)
    2.2653
    """
    return chamber_area(section) / wall_area(section)


def torque(section: Section, pressure: Number) -> Number:
    """Return T, N m, Eq. (3.4): the moments, Eq. (3.2), of chamber, Eq. (3.5), and wall, Eq. (3.6).

    Positive towards the bottom. The pressure pushes on the end of a cut finger, the wall pulls on
    it; their forces balance, and their moments about the neutral surface are subtracted:
    ``T = T_P - T_Pw``. (Eq. (3.4) prints a plus; added, they give 1.80 N m for Design 1 at 0.25
    MPa, where the text has up to 0.5.) With both integrals done, what is left is the chamber's area
    times the distance between the two centroids, and that is

    ``T = P / 2 * (A_c / A_w) * w (a + b) (b - t)``.

    So the torque is positive if and only if b > t, and where it is, it grows with a, b and w and
    falls with t: each factor does.

    Args:
        section: Its dimensions.
        pressure: P, Pa, gauge; broadcasts.
    """
    a, b, w, t = section.top, section.bottom, section.width, section.wall
    return pressure / 2 * wall_stress_ratio(section) * w * (a + b) * (b - t)
