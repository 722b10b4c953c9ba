"""Answers of the tasks of Chapter 2."""

from itertools import product
from typing import NamedTuple

from scipy.stats import norm

from book.chapter_2.figures_pad import FORCE
from book.chapter_2.sliders import kind_of
from softgrip.simulator.pad import ideal_responses
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import FELT
from softgrip.tactile.element import Element, Shape, compliance, shortening
from softgrip.tactile.friction import lift_force
from softgrip.units import DEG, MM

PLACES = (-8.0, -4.0, 0.0, 4.0, 8.0)
ANGLES = (-60.0, -30.0, 0.0, 30.0, 60.0)
"""Positions of the sliders under "Touch the pad", mm and deg."""

WIDER_TOP = 0.12
"""Width of the top that is halved, as a part of the base's."""


def top_for(moved: float, load: float) -> float:
    """Return the width of a pyramid's flat top, as a part of the base's, for a shortening.

    Args:
        moved: By which the load shortens it with the stated modulus, m, > 0.
        load: N, > 0.
    """
    block = compliance(Element("pyramid", cut=1.0)) * load
    return block / moved


def by_halving(shape: Shape, cut: float = WIDER_TOP) -> float:
    """Return how many times as far an element is shortened when its top has half the width."""
    whole, half = (shortening(Element(shape, cut=each), 1.0) for each in (cut, cut / 2))
    return float(half / whole)


class FeltPose(NamedTuple):
    """A pose of the sliders: place, mm, angle, deg, and how many elements feel the object."""

    place: float
    angle: float
    elements: int


def poses(item: str, kind: str) -> list[FeltPose]:
    """Return the poses of the sliders in which an object is felt as a kind.

    Args:
        item: Name of an object of `pad_object`.
        kind: "point", "line" or "surface".
    """
    found = []
    for place, angle in product(PLACES, ANGLES):
        responses = ideal_responses(item, Pose((place * MM, 0.0), angle * DEG), FORCE)
        if kind_of(responses) == kind:
            found.append(FeltPose(place, angle, int((responses > FELT).sum())))
    return found


def sure_lift(weight: float, probability: float, friction: float, error: float) -> float:
    """Return the lift force, N, with which an object is held with a probability.

    The inverse of `softgrip.tactile.friction.holding_probability`.

    Args:
        weight: Of the object, N.
        probability: That the grip holds, above 0 and below 1.
        friction: Coefficient between finger and object.
        error: Deviation of the measured contact force, N.
    """
    return float(weight + lift_force(norm.ppf(probability) * error, friction))
