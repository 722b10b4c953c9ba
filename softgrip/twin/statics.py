"""Fingers at rest, in closed form: angle, torque, plunger and volume, for many rigs at once."""

from collections.abc import Sequence

import numpy as np

from softgrip.arrays import Floats
from softgrip.pump.finger import Finger, swept_volume
from softgrip.simulator.parameters import FingerParameters, RigParameters


def of_fingers(fingers: Sequence[FingerParameters], name: str) -> Floats:
    """Return a parameter of each finger, shape (fingers,)."""
    return np.array([getattr(finger, name) for finger in fingers], dtype=np.float64)


def settled_angle(fingers: Sequence[FingerParameters], pressure: Floats | float) -> Floats:
    """Return the angles, rad, shape (fingers,), at which pressures, Pa, rest."""
    torque = of_fingers(fingers, "torque_per_pressure") * pressure
    power = of_fingers(fingers, "fractional_power")
    return np.asarray((torque / of_fingers(fingers, "stiffness")) ** (1 / power))


def settled_pressure(fingers: Sequence[FingerParameters], angle: Floats | float) -> Floats:
    """Return the pressures, Pa, shape (fingers,), that hold angles, rad: ``T = K theta**n``."""
    torque = of_fingers(fingers, "stiffness") * np.power(
        angle, of_fingers(fingers, "fractional_power")
    )
    return np.asarray(torque / of_fingers(fingers, "torque_per_pressure"))


def travel_for(rigs: Sequence[RigParameters], angle: Floats | float, after: float) -> Floats:
    """Return the travel of the plunger, m, that bends a rig's finger by about an angle.

    With what a fast push leaves of the memory after some time, but without what leaks away.

    Args:
        rigs: Of one finger each, with the plunger drawn out at the start.
        angle: rad, a number or shape (rigs,).
        after: Time since the push, s.
    """
    fingers = [rig.finger for rig in rigs]
    left = [
        1 + sum(p * np.exp(-after / t) for p, t in zip(f.memory, f.memory_time, strict=True))
        for f in fingers
    ]
    pressure = settled_pressure(fingers, angle) * left
    swept, ball, rest = (
        of_fingers(fingers, name) for name in ("torque_per_pressure", "ballooning", "rest_volume")
    )
    air = np.array([rig.pump.syringe_volume for rig in rigs])
    area, atmosphere, dead = np.array(
        [(rig.pump.area, rig.gas.atmosphere, rig.gas.dead_volume) for rig in rigs]
    ).T
    grown = swept * angle + ball * pressure
    whole = air + rest + dead
    return np.asarray((whole - whole * atmosphere / (atmosphere + pressure) + grown) / area)


def volume_for(rig: RigParameters, count: int, angle: float) -> float:
    """Return what the plunger must sweep to bend so many fingers by an angle [rad], m^3.

    The fingers are those of the rig, in turn; all are given the pressure that the stiffest of them
    needs. By the exact gas law, `pump.finger.swept_volume`.
    """
    fingers = [rig.fingers[k % len(rig.fingers)] for k in range(count)]
    pressure = float(settled_pressure(fingers, angle).max())
    at_rest = float(of_fingers(fingers, "rest_volume").sum())
    grown = of_fingers(fingers, "torque_per_pressure") * settled_angle(fingers, pressure)
    grown += of_fingers(fingers, "ballooning") * pressure
    asked = Finger(
        pressure, at_rest, at_rest + float(grown.sum()), rig.gas.dead_volume, rise_time=1.0
    )
    return swept_volume(asked, rig.pump.syringe_volume, rig.gas.atmosphere)
