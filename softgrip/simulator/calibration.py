"""The parameters of the simulated rig that follow from a few printed measurements.

`softgrip.simulator.calibration_table` lists them with what is assumed, and says how far off the rig
is. The three fingers bear Chapter 3's names. Chapter 5 calls the third one, of FX-Pro, Design 2.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from softgrip.simulator.parameters import FingerParameters, RigParameters, Spread
from softgrip.units import DEG, MM, MPa

FULL_ANGLE, FULL_PRESSURE = 206 * DEG, 0.15 * MPa  # Design 1 in Figure 3.10
TORQUE_PER_PRESSURE = 0.359 / (0.25 * MPa)
"""N m/Pa: Design 1 in Figure 3.9, held straight. All fingers are alike in it up to 0.1 MPa."""
DAMPING_RATIO, DAMPING_SPREAD = 0.7, 0.1  # Section 3.4
OPERATING_ANGLE = 60 * DEG  # of the first step test of Section 5.4
SPREAD_ANGLE, SPREAD_RMS = 75 * DEG, 2.5 * DEG  # middles of 60 to 90 deg and 2 to 3 deg (5.4)


@dataclass(frozen=True)
class PrintedFinger:
    """What is printed of a finger and sets its parameters.

    Attributes:
        full_angle: Bending angle at `FULL_PRESSURE` (Section 3.4), rad.
        frequency: Natural frequency (Table 3.3), rad/s.
        fractional_power: n of its rubber (Table 5.1).
        width: mm (Table 3.1).
    """

    full_angle: float
    frequency: float
    fractional_power: float
    width: float = 30

    @property
    def rest_volume(self) -> float:
        """Air at rest, m^3: half the length of Section 3.4 in walls of 1.5 mm (Table 3.1)."""
        return (24 - 2 * 1.5) * (self.width - 2 * 1.5) * (94 / 2) * MM**3


DESIGN_1 = PrintedFinger(FULL_ANGLE, 2.86, 2.5)
"""Dragon Skin 20; Table 5.2 has 2.174 and 2.365 for the n of the same rubber."""
DESIGN_2 = PrintedFinger(201 * DEG, 2.78, 2.5, width=29)
"""Dragon Skin 20, narrower."""
DESIGN_3 = PrintedFinger(232 * DEG, 1.72, 1.538)
"""Dragon Skin FX-Pro."""


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


def calibrated(printed: PrintedFinger, *, spread: bool = True) -> RigParameters:
    """Return the rig with a finger of which a few numbers are printed.

    The stiffness follows from the angle at 0.15 MPa; inertia and damping follow, in closed form,
    from the pole that the printed frequency and damping ratio name at `OPERATING_ANGLE`.

    Args:
        printed: The numbers.
        spread: Whether runs differ.
    """
    n = printed.fractional_power
    bare = FingerParameters(
        stiffness=TORQUE_PER_PRESSURE * FULL_PRESSURE / printed.full_angle**n,
        fractional_power=n,
        inertia=1.0,
        damping=1.0,
        torque_per_pressure=TORQUE_PER_PRESSURE,
        rest_volume=printed.rest_volume,
    )
    pole = printed.frequency * complex(-DAMPING_RATIO, (1 - DAMPING_RATIO**2) ** 0.5)
    pull = -small_signal_stiffness(bare, OPERATING_ANGLE) * memory_gain(
        pole, bare.memory, bare.memory_time
    )
    square = pole**2
    inertia, damping = np.linalg.solve(
        [[square.real, pole.real], [square.imag, pole.imag]], [pull.real, pull.imag]
    )
    between_runs = Spread(
        stiffness=n * SPREAD_RMS / SPREAD_ANGLE, damping=DAMPING_SPREAD / DAMPING_RATIO, leakage=0.3
    )
    return RigParameters(
        (replace(bare, inertia=float(inertia), damping=float(damping)),),
        spread=between_runs if spread else Spread(),
    )


def design_1(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 1, made of Dragon Skin 20; without `spread` runs are alike."""
    return calibrated(DESIGN_1, spread=spread)


def design_2(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 2 of Chapter 3, a narrower Design 1."""
    return calibrated(DESIGN_2, spread=spread)


def design_3(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 3 of Chapter 3, of Dragon Skin FX-Pro: Chapter 5's Design 2."""
    return calibrated(DESIGN_3, spread=spread)
