"""The tests at rest of Section 3.4 on the simulated rig: blocked torque and free bending.

Each design is fitted to a printed torque, but the second, and to a printed angle, among all other
prints; what is shown at other pressures is the simulated rig's.
"""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.chance import SEED, Chance
from softgrip.simulator.fitted_rigs import design_1, design_2, design_3
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


def _gauge(pressure: ArrayLike) -> Floats:
    gauge = np.asarray(pressure, dtype=np.float64)
    if not (np.isfinite(gauge).all() and (gauge >= 0).all()):
        raise InvalidInputError("pressure", expected="finite, >= 0 Pa", got=gauge.tolist())
    return gauge


def blocked_torque(finger: FingerParameters, pressure: ArrayLike) -> Floats:
    """Return the torque of Eq. (3.24), N m: the force on the scale, as it reads, times the length.

    Args:
        finger: Held straight, so that its spring is at rest.
        pressure: Gauge, Pa, >= 0, any shape.
    """
    pushed = finger.torque_per_pressure * _gauge(pressure)
    return np.asarray(np.rint(pushed / LENGTH / SCALE) * SCALE * LENGTH)


def settled_angles(
    rig: RigParameters, pressure: ArrayLike, *, runs: int = 7, seed: int = SEED
) -> Floats:
    """Return the angle at rest of several runs, rad, shape (runs, N).

    Args:
        rig: Its finger, and how runs differ.
        pressure: Gauge, Pa, >= 0, shape (N,).
        runs, seed: As of `Simulation`.

    >>> from softgrip.simulator.fitted_rigs import design_1
    >>> alike = settled_angles(design_1(spread=False), [0.075e6, 0.15e6], runs=1)
    >>> power = design_1().finger.fractional_power
    >>> bool(np.isclose(alike[0, 1] / alike[0, 0], 2 ** (1 / power)))
    True
    """
    finger = rig.finger
    chance = Chance(rig.spread, fingers=1, seed=seed, first=0, runs=runs)
    stiffness = finger.stiffness * chance.stiffness.T
    torque = finger.torque_per_pressure * _gauge(pressure)
    return np.asarray((torque / stiffness) ** (1 / finger.fractional_power))
