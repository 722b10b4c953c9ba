"""Answers to the tasks of the page, on the loop that the page computes."""

import numpy as np

from book.beyond.delay.sliders import late_step
from softgrip.units import DEG

DELAY, BANDWIDTH = 200.0, 3.0
"""ms and rad/s: where the sliders stand."""
LESS, MORE, FASTER = -50.0, 50.0, 6.0
"""Errors of the second task, %, and the bandwidth of the first, rad/s."""
DIFFERENCE, RATE = 60.0, 40.0
"""Of the third task: ms between two fingers, and deg/s at which they move."""


def apart(error: float, *, delay: float = DELAY, bandwidth: float = BANDWIDTH) -> float:
    """Return the largest difference of the fingers on the way, deg."""
    return float(late_step(delay, error, bandwidth)["apart"])


def overshoot(error: float, *, delay: float = DELAY, bandwidth: float = BANDWIDTH) -> float:
    """Return by how much SPA 1 overshoots, % of its goal."""
    found = late_step(delay, error, bandwidth)
    return float(100 * (np.max(found["SPA_1"]) / found["goal_1"] - 1))


def behind(difference: float, rate: float) -> float:
    """Return how far a finger that answers later by a difference, ms, is behind at a rate, deg/s.

    >>> behind(50.0, 20.0)
    1.0
    """
    return difference / 1000 * rate


def largest_rate(limit: float, difference: float = DIFFERENCE) -> float:
    """Return the rate, deg/s, at which such a difference keeps fingers a limit [deg] apart."""
    return limit / (difference / 1000)


TOGETHER = 1.0 * DEG
"""rad: as far apart as the third task allows."""
