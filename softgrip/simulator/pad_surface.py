"""How far the surface of an object lies above its lowest point, over the places of the pad."""

from dataclasses import dataclass
from math import log

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.pad_objects import PadObject
from softgrip.units import MM

WAVES = 12
"""Waves that a rough surface is made of."""
WAVELENGTHS = (6 * MM, 25 * MM)
"""Shortest and longest of them, m (assumed: between a pyramid's pitch and the size of a food)."""


@dataclass(frozen=True)
class Pose:
    """How an object is laid on the pad.

    Attributes:
        place: Of its middle, m, from the middle of the pad.
        angle: Of its length against the pad's, rad.
        tilt: Slopes along its length and across, rad.
    """

    place: tuple[float, float]
    angle: float = 0.0
    tilt: tuple[float, float] = (0.0, 0.0)


def rise(x: Floats, radius: float) -> Floats:
    """Return how far a circle rises above its lowest point, m, beside it by x, m.

    Beyond its radius, where there is nothing of it, it is infinite.

    >>> rise(np.array([0.0, 3.0, 9.0]), 5.0).tolist()
    [0.0, 1.0, inf]
    """
    inside = np.abs(x) <= radius
    kept = np.where(inside, x, 0.0)
    # As a quotient, so that an infinite radius gives zero instead of inf - inf.
    found: Floats = np.where(inside, kept**2 / (radius + np.sqrt(radius**2 - kept**2)), np.inf)
    return found


def roughness(u: Floats, v: Floats, rms: float, chance: np.random.Generator) -> Floats:
    """Return a random surface of a given deviation, m: waves of all directions.

    Args:
        u, v: Places on it, m, of one shape.
        rms: Its deviation, m.
        chance: Gives directions, lengths and phases of the waves.
    """
    direction, phase = chance.uniform(0, 2 * np.pi, (2, WAVES))
    shortest, longest = (log(length) for length in WAVELENGTHS)
    number = 2 * np.pi / np.exp(chance.uniform(shortest, longest, WAVES))
    along = u[..., None] * np.cos(direction) + v[..., None] * np.sin(direction)
    found: Floats = rms * np.sqrt(2 / WAVES) * np.cos(number * along + phase).sum(axis=-1)
    return found


def gap(
    item: PadObject, pose: Pose, points: Floats, chance: np.random.Generator | None = None
) -> Floats:
    """Return the gap between pad and object, m, when its lowest point would just touch.

    Args:
        item, pose: What lies on the pad, and how.
        points: Places on the pad, m, shape (..., 2).
        chance: Gives a rough surface; without it the object is smooth.

    Returns:
        Floats: m, shape (...); infinite beyond the object. With tilt or roughness it may be
            negative.
    """
    away = points - np.array(pose.place)
    cosine, sine = np.cos(pose.angle), np.sin(pose.angle)
    u = cosine * away[..., 0] + sine * away[..., 1]
    v = cosine * away[..., 1] - sine * away[..., 0]
    found = rise(u, item.radii[0]) + rise(v, item.radii[1])
    found = found + pose.tilt[0] * u + pose.tilt[1] * v
    if chance is not None:
        found = found + roughness(u, v, item.roughness, chance)
    beyond = (np.abs(u) > item.size[0] / 2) | (np.abs(v) > item.size[1] / 2)
    return np.where(beyond, np.inf, found)
