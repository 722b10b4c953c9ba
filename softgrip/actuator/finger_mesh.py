"""Hexahedral meshes of half a finger: a grid whose lines lie on the walls, voids left out.

The x axis runs along the finger from the clamped base, y from the neutral surface to the top, z
from the plane of symmetry to a side wall, as in Figure 3.3. All elements are boxes.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from skfem import MeshHex

from softgrip.actuator.section import Section, check_section
from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError
from softgrip.units import MM

Mesh = Any
"""A scikit-fem mesh (the library ships no types)."""

Mask = NDArray[np.bool_]


class Box(NamedTuple):
    """A void: from low to high along x, y and z, m."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]


@dataclass(frozen=True)
class FingerShape:
    """A finger along its length: chambers of one section between two end caps.

    The text prints the length (94 mm), the section and, in Section 6.3, the number of chambers. The
    other sizes are not printed: the defaults are **assumptions**.

    Attributes:
        section: Its section, m.
        chambers: 1 is the cantilever beam of Figure 3.1: one chamber along the whole length. More
            have grooves between them and are pressurised each, with no air channel (Assumption 1).
        length: L, m.
        cap: Thickness of the solid ends, m (assumed).
        groove_width: Gap between the walls of two chambers, m (assumed). These walls have the
            thickness t.
        groove_floor: Height of the bottom of a groove above the neutral surface, m, >= 0, below the
            chambers' top (assumed: the grooves are as deep as the chambers). No other assumption
            matters as much.

    Raises:
        InvalidInputError: If the sizes leave no room for a chamber.
    """

    section: Section
    chambers: int = 1
    length: float = 94 * MM
    cap: float = 3 * MM
    groove_width: float = 2 * MM
    groove_floor: float = 0.0

    def __post_init__(self) -> None:
        check_section(self.section)
        check_positive(length=self.length, cap=self.cap, groove_width=self.groove_width)
        if self.chambers < 1:
            raise InvalidInputError("chambers", expected="at least 1", got=self.chambers)
        if not 0 <= self.groove_floor < self.section.top - self.section.wall:
            raise InvalidInputError(
                "groove_floor", expected="from 0 to below the chamber's top", got=self.groove_floor
            )
        if not self.chamber_length > 0:
            raise InvalidInputError(
                "length",
                expected=f"more than the {self.length - self.chambers * self.chamber_length:g} m "
                "that caps, walls and grooves take",
                got=self.length,
            )

    @property
    def divider(self) -> float:
        """Distance between two chambers: wall, groove, wall, m."""
        return self.groove_width + 2 * float(self.section.wall)

    @property
    def chamber_length(self) -> float:
        """Length of a chamber, m."""
        dividers = (self.chambers - 1) * self.divider
        return (self.length - 2 * self.cap - dividers) / self.chambers


def voids(finger: FingerShape) -> tuple[list[Box], list[Box]]:
    """Return the chambers and the grooves of the half finger.

    >>> beam = FingerShape(Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM))
    >>> voids(beam)[0]
    [Box(low=(0.003, 0.0, 0.0), high=(0.091, 0.0185, 0.0135))]
    """
    s, pitch = finger.section, finger.chamber_length + finger.divider
    starts = [finger.cap + i * pitch for i in range(finger.chambers)]
    ends = [start + finger.chamber_length for start in starts]
    inside = [
        Box((start, 0.0, 0.0), (end, s.top - s.wall, s.width / 2 - s.wall))
        for start, end in zip(starts, ends, strict=True)
    ]
    grooves = [
        Box((end + s.wall, finger.groove_floor, 0.0), (start - s.wall, s.top, s.width / 2))
        for end, start in zip(ends[:-1], starts[1:], strict=True)
    ]
    return inside, grooves


def finger_mesh(finger: FingerShape, size: float) -> Mesh:
    """Mesh half of a finger.

    Args:
        finger: Its sizes.
        size: Longest edge of an element, m; a thinner wall gets one layer.

    Returns:
        skfem.MeshHex: Boundaries: ``base`` (x = 0), ``tip`` (x = L), ``symmetry`` (z = 0) and
            ``pressure``, the walls of the chambers.

    Raises:
        InvalidInputError: If the size is not a length > 0 below that of the finger.

    >>> mesh = finger_mesh(FingerShape(Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)), 10 * MM)
    >>> mesh.nelements, sorted(mesh.boundaries)
    (96, ['base', 'pressure', 'symmetry', 'tip'])
    """
    if not 0 < size < finger.length:
        raise InvalidInputError(
            "size", expected=f"a length between 0 and {finger.length} m", got=size
        )
    s, (inside, grooves) = finger.section, voids(finger)
    outline = Box((0.0, -s.bottom, 0.0), (finger.length, s.top, s.width / 2))
    mesh = box_mesh(outline, size, inside + grooves)
    return mesh.with_boundaries(
        {
            "base": lambda x: np.isclose(x[0], 0),
            "tip": lambda x: np.isclose(x[0], finger.length),
            "symmetry": lambda x: np.isclose(x[2], 0),
            "pressure": lambda x: within(x, inside, 1e-9),
        }
    )


def box_mesh(outline: Box, size: float, left_out: Sequence[Box] = ()) -> Mesh:
    """Mesh a box without the boxes that are left out; grid lines lie on all their faces."""
    boxes = [outline, *left_out]
    x, y, z = (
        grid_lines((corner[axis] for box in boxes for corner in box), size) for axis in range(3)
    )
    mesh = MeshHex.init_tensor(x, y, z)
    centres = mesh.p[:, mesh.t].mean(axis=1)
    return mesh.restrict(np.flatnonzero(~within(centres, left_out)))


def grid_lines(breaks: Iterable[float], size: float) -> Floats:
    """Divide the intervals between the breaks evenly, into parts no longer than size.

    >>> grid_lines([0.0, 4.0, 5.0, 4.0], 2.0).tolist()
    [0.0, 2.0, 4.0, 5.0]
    """
    # Two breaks that differ by rounding are one; no part of a finger is thinner than 1 nm.
    ends = np.unique(np.round(list(breaks), 9))
    parts = [
        np.linspace(low, high, ceil((high - low) / size - 1e-9) + 1)[:-1]
        for low, high in pairwise(ends)
    ]
    return np.concatenate([*parts, ends[-1:]])


def within(points: Floats, boxes: Sequence[Box], tolerance: float = 0.0) -> Mask:
    """Tell which of the points, shape (3, N), lie in one of the boxes: booleans, shape (N,)."""
    low, high = np.array(boxes, dtype=np.float64).reshape(-1, 2, 3, 1).swapaxes(0, 1)
    inside = (points >= low - tolerance) & (points <= high + tolerance)
    return np.asarray(inside.all(axis=1).any(axis=0))
