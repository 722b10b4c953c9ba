"""A linear model that is matched to Ludwick's spring, under the force that holds another angle.

The text does not say what its linear model of the step tests was matched to. Held at the first set
point, it rests far beyond the second one. Brought to each set point anew, it differs from Eq.
(5.16) on its way alone, and by how much follows from n, once both have one frequency and damping.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from softgrip.arrays import Floats, Number
from softgrip.dynamics.ludwick import LudwickFinger, step_responses
from softgrip.reads import remembered

STEP, SAMPLES = 0.05, 401
"""Of the integration, as time by natural frequency: errors below come out to four digits."""


def resting_angle(first: Number, second: Number, power: Number) -> Number:
    """Return where a linear model that is right at one angle rests under another one's force.

    >>> resting_angle(60.0, 90.0, 2.0)
    135.0
    """
    return first * (second / first) ** power


def largest_share_at_rest(error: float, first: float, second: float, power: float) -> float:
    """Return the part of a record in which such a model may be at rest, by its RMS error.

    Args:
        error: RMS, in the unit of the angles.
        first: Angle at which the model is right.
        second: Angle at which the record rests.
        power: n of the spring.
    """
    return float((error / (resting_angle(first, second, power) - second)) ** 2)


@dataclass(frozen=True)
class Setting:
    """What both models of a step share.

    Attributes:
        set_point: Where both rest, deg.
        matched_at: Where both springs are as stiff, deg.
        tangent: Whether in their slope, and not in their force.
        damping_ratio: Of the linear model.
        span: Of the record, as time by natural frequency.
    """

    set_point: float
    matched_at: float
    tangent: bool
    damping_ratio: float
    span: float


def settings(set_points: Sequence[float], damping_ratios: Sequence[float]) -> tuple[Setting, ...]:
    """Return settings for set points, deg, and damping ratios; the others are ours, and wide."""
    angles, spans = (*range(10, 101, 10), 120), (2.0, 4.0, 6.0, 10.0, 20.0, 30.0)
    return tuple(
        Setting(*one) for one in product(set_points, angles, (False, True), damping_ratios, spans)
    )


@remembered
def linear_errors(power: float, shared: tuple[Setting, ...]) -> Floats:
    """Return the RMS error of the linear model against Eq. (5.16), deg, shape (settings,).

    Angles are counted in set points, time in the linear model's natural frequency.
    """
    ratio = np.array([one.set_point / one.matched_at for one in shared])
    slope = np.array([power if one.tangent else 1.0 for one in shared])
    damping = 2 * np.array([one.damping_ratio for one in shared])
    spring = ratio ** (power - 1) / slope
    spans = np.array([one.span for one in shared])
    found = np.empty(len(shared))
    for span in np.unique(spans):
        at = spans == span
        runs, times = int(at.sum()), np.linspace(0, span, SAMPLES)
        curves = [
            np.concatenate([angle.copy() for _, angle in parts], axis=1)
            for parts in (
                step_responses(finger, finger.stiffness, times, STEP, runs=runs)
                for finger in (
                    LudwickFinger(1.0, damping[at], spring[at], power),
                    LudwickFinger(1.0, damping[at], np.ones(runs), 1.0),
                )
            )
        ]
        found[at] = np.sqrt(np.mean((curves[0] - curves[1]) ** 2, axis=0))
    return found * [one.set_point for one in shared]
