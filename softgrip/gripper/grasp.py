"""Two bending fingers that close on an elastic disc: where they touch, with what force and torque.

The fingers hang down from a palm, a gap apart, and bend towards each other, each an arc of constant
curvature (a cantilever of length L whose tip has turned by theta). The disc lies between them, its
centre at a depth below the palm; it can slide sideways on its support, against dry friction. Where
a finger is nearer to the centre than the radius the disc is dented by the difference, and pushes
back with stiffness times dent. No finger slips along the disc, and none is bent out of its arc.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.checks import check_fields
from softgrip.units import MM

SMALL_ANGLE = 1e-4
"""rad: a finger that is straighter counts as this."""


@final
@dataclass(frozen=True)
class ElasticDisc:
    """What is grasped.

    Attributes:
        stiffness: Force by dent, N/m, > 0.
        radius: m, > 0.
        mass: kg, > 0.
        friction: Of its support, as a share of its weight, > 0.
    """

    stiffness: float
    radius: float = 20 * MM
    mass: float = 0.02
    friction: float = 0.3

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Touch:
    """A finger against the disc; arrays of the shape of the angle.

    Attributes:
        dent: m, >= 0.
        torque: On the finger, N m, <= 0: the disc pushes it open.
        sideways: Force on the disc, N, away from the finger.
    """

    dent: Floats
    torque: Floats
    sideways: Floats


def touch(
    angle: ArrayLike, ahead: ArrayLike, depth: float, length: float, disc: ElasticDisc
) -> Touch:
    """Return how a finger touches the disc.

    Torque and force are slopes of the energy ``stiffness dent**2 / 2`` by the angle of the finger
    and by the place of the disc, so that no energy is made or lost.

    Args:
        angle: theta, by which the tip has turned, rad.
        ahead: Distance from the finger's root to the disc's centre along the palm, m, positive
            where the finger bends to; broadcasts with the angle.
        depth: Of the centre below the palm, m.
        length: L, m, > 0.
        disc: What is touched.

    >>> far, near = (touch(t, 0.05, 0.07, 0.1, ElasticDisc(100.0)) for t in (0.1, 1.0))
    >>> bool(far.torque == 0), bool(near.torque < 0), bool(near.sideways > 0)
    (True, True, True)
    """
    theta = np.maximum(np.asarray(angle, dtype=np.float64), SMALL_ANGLE)
    x, radius = np.asarray(ahead, dtype=np.float64), length / theta
    # The nearest point of an arc lies towards its own centre, (radius, 0), or is an end.
    turned = np.clip(np.arctan2(depth, radius - x), 0.0, theta)
    cosine, sine = np.cos(turned), np.sin(turned)
    across, down = radius * (1 - cosine), radius * sine
    away_x, away_y = x - across, depth - down
    distance = np.hypot(away_x, away_y)
    dent = np.maximum(disc.radius - distance, 0.0)
    force = disc.stiffness * dent
    # How that point moves with theta, at its place along the finger.
    by_x = (turned * sine - 1 + cosine) * radius / theta
    by_y = (turned * cosine - sine) * radius / theta
    unit_x, unit_y = away_x / distance, away_y / distance
    return Touch(dent, -force * (by_x * unit_x + by_y * unit_y), force * unit_x)


@final
@dataclass(frozen=True)
class DiscBetweenFingers:
    """The disc between two fingers, with its motion: states are its place and speed, m and m/s.

    The place is counted from the middle, towards the second finger.

    Attributes:
        disc: What lies there.
        gap: Between the roots of the fingers, m.
        depth: Of the centre below the palm, m.
        length: Of the fingers, m (Section 6.3: 100 mm).
        slow: Speed below which the friction of the support is smoothed, m/s.

    Raises:
        InvalidInputError: If a number is not above zero.
    """

    disc: ElasticDisc
    gap: float = 70 * MM
    depth: float = 75 * MM
    length: float = 100 * MM
    slow: float = 5 * MM

    states = 2

    def __post_init__(self) -> None:
        check_fields(self, other=("disc",))

    def touches(self, angle: Floats, place: Floats) -> Touch:
        """Return both contacts, shape (2, ...), for angles (2, ...) in rad, a place (...) in m."""
        ahead = np.stack([self.gap / 2 + place, self.gap / 2 - place])
        return touch(angle, ahead, self.depth, self.length, self.disc)

    def slopes(self, angle: Floats, own: Floats, slope: Floats) -> Floats:
        """Write the slopes of place and speed, shape (2, runs); return the torques, (2, runs)."""
        place, speed = own
        both = self.touches(angle, place)
        weight = 9.80665 * self.disc.mass
        rubbing = self.disc.friction * weight * speed / np.hypot(speed, self.slow)
        slope[0] = speed
        slope[1] = (both.sideways[0] - both.sideways[1] - rubbing) / self.disc.mass
        return both.torque
