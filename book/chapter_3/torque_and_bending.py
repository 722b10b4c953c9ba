"""The tests at rest of Section 3.4 on the simulated rig: blocked torque and free bending.

Torque and angle of each design are calibrated to one printed number each, so at that pressure they
agree with the print by construction; what is shown at other pressures is the simulated rig's.
"""

from collections.abc import Callable, Mapping
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.calibration import design_1, design_2, design_3
from softgrip.simulator.chance import SEED, Chance
from softgrip.simulator.parameters import FingerParameters, RigParameters
from softgrip.units import GRAM_FORCE, MM

LENGTH = 94 * MM
"""L_i of Eq. (3.24), m."""

SCALE = 0.01 * GRAM_FORCE
"""Step of the scale that the tip presses on, N (Section 3.4)."""


DESIGNS: Mapping[str, Callable[[], RigParameters]] = {
    "Design 1(E1)": design_1,
    "Design 2(E1)": design_2,
    "Design 3(E2)": design_3,
}
"""What makes the simulated rig with each design of Figures 3.9 and 3.10."""

BUCKLING_TORQUE = {"Design 3(E2)": 0.15}
"""Above which the structure of a design gives way, N m (Section 3.4: about 0.15)."""


def _gauge(pressure: ArrayLike) -> Floats:
    gauge = np.asarray(pressure, dtype=np.float64)
    if not (np.isfinite(gauge).all() and (gauge >= 0).all()):
        raise InvalidInputError("pressure", expected="finite, >= 0 Pa", got=gauge.tolist())
    return gauge


def blocked_torque(
    finger: FingerParameters, pressure: ArrayLike, *, buckling_torque: float = inf
) -> Floats:
    """Return the torque of Eq. (3.24), N m: the force on the scale, as it reads, times the length.

    Args:
        finger: Held straight, so that its spring is at rest.
        pressure: Gauge, Pa, >= 0, any shape.
        buckling_torque: The torque that the finger's structure holds, N m.
    """
    pushed = np.minimum(finger.torque_per_pressure * _gauge(pressure), buckling_torque)
    return np.asarray(np.rint(pushed / LENGTH / SCALE) * SCALE * LENGTH)


def settled_angles(
    rig: RigParameters, pressure: ArrayLike, *, runs: int = 7, seed: int = SEED
) -> Floats:
    """Return the angle at rest of several runs, rad, shape (runs, N).

    Args:
        rig: Its finger, and how runs differ.
        pressure: Gauge, Pa, >= 0, shape (N,).
        runs, seed: As of `Simulation`.

    >>> from softgrip.simulator.calibration import design_1
    >>> from softgrip.units import DEG
    >>> alike = settled_angles(design_1(spread=False), [0.15e6], runs=1)
    >>> round(float(alike[0, 0]) / DEG, 3)
    206.0
    """
    finger = rig.finger
    chance = Chance(rig.spread, fingers=1, seed=seed, first=0, runs=runs)
    stiffness = finger.stiffness * chance.stiffness.T
    torque = finger.torque_per_pressure * _gauge(pressure)
    return np.asarray((torque / stiffness) ** (1 / finger.fractional_power))
