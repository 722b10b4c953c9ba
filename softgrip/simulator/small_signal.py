"""Small motions of a finger about an angle: the linear model that its law has there."""

import numpy as np
from numpy.typing import NDArray

from softgrip.simulator.parameters import FingerParameters
from softgrip.units import DEG

OPERATING_ANGLE = 60 * DEG
"""Of the first step test of Section 5.4, rad."""


def memory_gain(
    laplace: complex, memory: tuple[float, ...], memory_time: tuple[float, ...]
) -> complex:
    """Return by what the memory multiplies the settled stiffness at a complex frequency, rad/s.

    >>> abs(memory_gain(0j, (0.1,), (2.0,))), round(abs(memory_gain(1e9j, (0.1,), (2.0,))), 6)
    (1.0, 1.1)
    """
    branches = zip(memory, memory_time, strict=True)
    return 1 + sum(
        (part * laplace * time / (1 + laplace * time) for part, time in branches), start=0j
    )


def small_signal_stiffness(finger: FingerParameters, angle: float) -> float:
    """Return the slope of the settled torque at an angle (rad), N m/rad."""
    n = finger.fractional_power
    return float(n * finger.stiffness * abs(angle) ** (n - 1))


def small_signal_poles(finger: FingerParameters, angle: float) -> NDArray[np.complex128]:
    """Return the poles from pressure to angle at an angle (rad), shape (2 + branches,), rad/s.

    Without dry friction, which a linear model does not have. The pair that swings comes first.
    """
    k = small_signal_stiffness(finger, angle)
    size = 2 + len(finger.memory)
    matrix = np.zeros((size, size))
    matrix[0, 1] = 1
    matrix[1] = np.array([-k, -finger.damping, *[-1.0] * len(finger.memory)]) / finger.inertia
    for row, (part, time) in enumerate(
        zip(finger.memory, finger.memory_time, strict=True), start=2
    ):
        matrix[row, 1], matrix[row, row] = part * k, -1 / time
    poles = np.linalg.eigvals(matrix).astype(np.complex128)
    return poles[np.argsort(-np.abs(poles.imag), kind="stable")]
