"""The loop of Section 6.4 as printed: its filters and P-dagger around the fingers of Eq. (6.26)."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.gripper.gripper_loop import GripperRun, run_gripper
from softgrip.gripper.internal_model import PERIOD, InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED, Gripper
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space

FILTERS = {"4.8/s": FAST, "2/s": SLOW}
"""The printed filters by their target loops."""

FINE = 0.005
"""Period that stands for continuous time, s: the filter's fastest pole is at 260 rad/s."""


def equal_targets(angle: float = np.pi / 3, gripper: Gripper = PRINTED) -> Floats:
    """Return proj(Y_d) for equal angles, rad: of pi/3 in Eq. (6.26), of pi/4 in Eq. (6.27)."""
    return project(gripper, [angle] * len(gripper.fingers)).reached


def run_loop(
    gripper: Gripper,
    coefficients: tuple[ArrayLike, ArrayLike],
    *,
    angle: float,
    period: float,
    duration: float,
    **conditions: Any,
) -> GripperRun:
    """Run the controller of Figure 6.3, with the mean of the inverses, on fingers that it knows.

    Args:
        gripper: The fingers.
        coefficients: Numerator and denominator of H(s), highest power first.
        angle: Wanted of all, rad.
        period, duration: s.
        **conditions: As of `run_gripper`: noise, push, limit, delay.
    """
    low_pass = filter_state_space(*coefficients)
    matrices = controller_matrices(gripper, mean_inverse(gripper), low_pass, period=period)
    controller = InternalModelController(matrices, equal_targets(angle, gripper))
    points = max(round(period / FINE), 1)
    return run_gripper(gripper, controller, duration=duration, points=points, **conditions)


def run_printed(
    target_loop: str = "4.8/s",
    *,
    angle: float = np.pi / 3,
    period: float = PERIOD,
    duration: float = 5.0,
    **conditions: Any,
) -> GripperRun:
    """Run the printed controller on the printed fingers.

    Args:
        target_loop: One of `FILTERS`.
        angle: Wanted of both, rad.
        period, duration: s.
        **conditions: As of `run_gripper`: noise, push, limit, delay.
    """
    return run_loop(
        PRINTED,
        FILTERS[target_loop],
        angle=angle,
        period=period,
        duration=duration,
        **conditions,
    )
