"""The printed filters H(s) of Section 6.4, designed anew by the rule that brings them out."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from softgrip.arrays import Floats
from softgrip.gripper.fixed_order_shaping import (
    ASYMPTOTE,
    SHARE,
    ShapedLoop,
    loop_of_filter,
    shape_loop,
    weights,
)
from softgrip.gripper.loop_shaping import BACK_OFF
from softgrip.gripper.plant import FingerDynamics, finger_state_space
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import far_pole
from softgrip.reads import remembered

DAMPING_RATIO, NATURAL_FREQUENCY = 0.7, 1.812
"""Of the finger in the author's control script (data/claims/sources.toml), rad/s."""
CROSSOVER = {"4.8/s": 5.0, "2/s": 2.0}
"""Of the target loops that the printed filters come out with, rad/s, by the name in the text."""

KEPT = SHARE / BACK_OFF
"""Share of the largest margin that the rule keeps."""
FREQUENCY = np.geomspace(1e-2, 1e2, 2001)
"""Over the crossover, at which peaks are sought."""


def label(name: str) -> str:
    """Return what is shown for a control: one that goes by its filter is that filter's.

    >>> label("2/s"), label("2/s, knows limit"), label("faster LQR")
    ('H for 2/s', 'H for 2/s, knows limit', 'faster LQR')
    """
    return f"H for {name}" if name.partition(", ")[0] in FILTERS else name


def author_plant(
    natural_frequency: float = NATURAL_FREQUENCY, damping_ratio: float = DAMPING_RATIO
) -> FingerDynamics:
    """Return the finger of the author's control script, with pump; its gain does not matter."""
    return FingerDynamics(2 * damping_ratio * natural_frequency, natural_frequency**2, 1.0)


@remembered
def shaped(crossover: float, finger: FingerDynamics, held_pole: float | None = None) -> ShapedLoop:
    """Return the loop that the rule gives for a finger, with the far pole held if it is given."""
    return shape_loop(finger_state_space(finger), crossover, held_pole=held_pole)


def designed(
    target: str, crossover: float, finger: FingerDynamics, hold: bool = True
) -> ShapedLoop:
    """Return the loop that the rule gives for a finger.

    Args:
        target: Of the printed filter, whose far pole is taken from it with ``hold``.
        crossover: Of the target loop, rad/s.
        finger: That is shaped, with pump.
        hold: Whether the far pole, which the criterion hardly sees, is that of the print.
    """
    return shaped(crossover, finger, far_pole(*FILTERS[target]) if hold else None)


def as_printed(target: str) -> ShapedLoop:
    """Return the loop that a printed filter is of, for the author's plant, with no design."""
    plant = finger_state_space(author_plant())
    return loop_of_filter(*FILTERS[target], plant, CROSSOVER[target])


def deviations(target: str, loop: ShapedLoop) -> Floats:
    """Return by how many percent the nine free coefficients of H are off the printed ones."""
    (top, low), (over, under) = FILTERS[target], loop.coefficients
    found, print_ = (np.concatenate([a, b[1:-1]]) for a, b in ((over, under), (top, low)))
    return np.asarray(100 * (found / print_ - 1))


def crossover_of_peaks(
    numerator: ArrayLike, denominator: ArrayLike, asymptote: float = ASYMPTOTE
) -> float:
    """Return the c for which the peaks of a filter's mixed sensitivity are equal, rad/s.

    Above it one of them is larger, below it another: there the largest is least. An optimum has
    them equal, so it is the target loop that a filter was designed for. No plant and no design are
    in it, but the rule's weights are, with their asymptote.
    """
    top, low = np.asarray(numerator, np.float64), np.asarray(denominator, np.float64)
    W1, W3 = weights(1j * FREQUENCY, asymptote)

    def peak(crossover: float) -> float:
        s = 1j * FREQUENCY * crossover
        under = np.polyval(low, s)
        S, T = np.polyval(np.polysub(low, top), s) / under, np.polyval(top, s) / under
        return float(np.max(abs(W1 * S) ** 2 + abs(W3 * T) ** 2))

    found = minimize_scalar(peak, bounds=(1.0, 10.0), method="bounded", options={"xatol": 1e-7})
    return float(found.x)
