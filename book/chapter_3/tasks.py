"""Answers of the questions and tasks of Chapter 3, where they are numbers."""

from math import log

import numpy as np
from scipy.optimize import brentq

from book.chapter_3.figures_control import PRINTED_TIME
from book.chapter_3.sliders import BAND, finger, lqr

TOP, BOTTOM, WALL = 20.0, 4.0, 1.5
"""Where the sliders of the finger start, mm: Design 1."""
LEAST_BOTTOM = 2.0
"""Where the slider of b begins and that of the wall ends, mm."""
LARGEST_P, LEAST_RATE, LARGEST_RATE = 10_000.0, 0.01, 0.3
"""Ends of the sliders of the regulator."""
LEAST_STEP, FIRST_STEP = 20.0, 60.0
"""The left end of its third slider, and where it starts, deg."""


def torque_of(*, top: float = TOP, bottom: float = BOTTOM, wall: float = WALL) -> float:
    """Return the torque in the title of the finger's explorer, N m.

    Args:
        top, bottom, wall: a, b and t, mm.
    """
    return float(finger(top, bottom, wall)["most"])


def frequency_of(*, top: float = TOP, bottom: float = BOTTOM, wall: float = WALL) -> float:
    """Return the frequency in that title, rad/s; arguments as of `torque_of`."""
    return float(finger(top, bottom, wall)["frequency"])


def weight_by_the_pole() -> float:
    """Return the weight on the rate whose pole alone settles in the printed time, within 5 %.

    For p to infinity the loop is ``exp(-t sqrt(q_1 / q_2))``, with q_1 = 1.
    """
    return (PRINTED_TIME / log(1 / BAND)) ** 2


def settling_time(rate: float, step: float) -> float:
    """Return what the regulator's explorer says with p at its right end, s.

    Args:
        rate: Weight on the rate.
        step: deg.
    """
    return float(lqr(LARGEST_P, rate, step)["settled"])


def weight_on_the_explorer() -> float:
    """Return the largest weight on the rate that settles the least step in the printed time."""
    # With a still smaller weight the angle overshoots its band, and the time jumps.
    return float(brentq(lambda q: settling_time(q, LEAST_STEP) - PRINTED_TIME, 0.015, LARGEST_RATE))


def least_time_on_the_explorer() -> float:
    """Return the least settling time of the step where the slider starts, p at its end, s."""
    rates = np.geomspace(LEAST_RATE, LARGEST_RATE, 25)
    return min(settling_time(float(rate), FIRST_STEP) for rate in rates)
