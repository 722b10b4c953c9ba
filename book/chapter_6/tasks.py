"""Answers to the tasks of Chapter 6, on its linear model."""

import numpy as np
from scipy.optimize import brentq

from book.chapter_6.plane_of_angles import in_plane
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import equal_targets
from softgrip.gripper.shaping_filter import low_pass
from softgrip.units import DEG

FIRST, SWINGING = 60.0, 2.0
"""Target of SPA 1 in the first task, deg, and the frequency at which it swings, rad/s."""
FROM, TO = 3.0, 6.0
"""Bandwidths of the second task, rad/s."""
PUSH, MEETS = 10.0, 60.0
"""Push of the third task, and where SPA 2 is to end with another one, deg."""


def partner(frequency: float) -> tuple[float, float]:
    """Return the target of SPA 2 that misses least beside `FIRST`, deg, and the share missed.

    Both fingers are to swing in step at a frequency, rad/s; 0 is at rest. The best target lies on
    the long axis of the ellipse of `in_plane`.
    """
    here = in_plane(PRINTED, frequency)
    second = FIRST * float(np.tan(here.turned))
    return second, float(here.missed((FIRST, second)))


def first_command(bandwidth: float) -> float:
    """Return the first command of a step to 60 deg, its largest, in the unit of U.

    By the bilinear rule it is that of ``H P-dagger`` at ``s = 2 / T``. The bandwidth is in rad/s.
    """
    s = 2 / PERIOD
    row = low_pass(bandwidth)(s).item() * mean_inverse(PRINTED)(s)
    return float((row @ equal_targets()).real)


def largest_bandwidth(limit: float) -> float:
    """Return the bandwidth, rad/s, at which the first command is a limit, in the unit of U."""
    return float(brentq(lambda bandwidth: first_command(bandwidth) - limit, 0.1, 50.0))


def kept_of_push(push: float) -> tuple[float, float]:
    """Return how far SPA 1 and SPA 2 end from their goals under a push on SPA 1 that stays.

    The push, the angle that it alone would bend the finger by, and the results are in deg. At rest
    the mean of the inverses sees the mean of what each finger asks of the pump: half of the push is
    given back, by the pump, which moves both fingers in inverse proportion to their stiffness.
    """
    first, second = PRINTED.fingers
    return push / 2, -push / 2 * first.stiffness / second.stiffness


def push_to_meet(angle: float) -> float:
    """Return the push on SPA 1 with which SPA 2 ends at an angle; both in deg."""
    return float((equal_targets()[1] / DEG - angle) / -kept_of_push(1.0)[1])
