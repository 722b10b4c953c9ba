"""The loop of Section 6.4 as printed: its filters and P-dagger around the fingers of Eq. (6.26)."""

from typing import Any

import numpy as np

from softgrip.arrays import Floats
from softgrip.gripper.gripper_loop import GripperRun, run_gripper
from softgrip.gripper.internal_model import PERIOD, InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space

FILTERS = {"4.8/s": FAST, "2/s": SLOW}
"""The printed filters by their target loops."""

FINE = 0.005
"""Period that stands for continuous time, s: the filter's fastest pole is at 260 rad/s."""


def equal_targets(angle: float = np.pi / 3) -> Floats:
    """Return proj(Y_d) for equal angles, rad: of pi/3 in Eq. (6.26), of pi/4 in Eq. (6.27)."""
    return project(PRINTED, [angle, angle]).reached


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
    low_pass = filter_state_space(*FILTERS[target_loop])
    matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass, period=period)
    controller = InternalModelController(matrices, equal_targets(angle))
    points = max(round(period / FINE), 1)
    return run_gripper(PRINTED, controller, duration=duration, points=points, **conditions)
