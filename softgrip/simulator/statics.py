"""Fingers at rest, in closed form: angle, torque, plunger and volume, for many rigs at once."""

import numpy as np

from softgrip.arrays import Floats, Number
from softgrip.pump.finger import Finger, swept_volume
from softgrip.simulator.parameters import FingerParameters, RigParameters
from softgrip.units import MPa

FULL_PRESSURE = 0.15 * MPa
"""At which Figure 3.10 ends, Pa."""


def settled_angle(finger: FingerParameters, pressure: Number) -> Number:
    """Return the angles, rad, at which pressures, Pa, rest; all broadcast."""
    torque = finger.torque_per_pressure * pressure
    return (torque / finger.stiffness) ** (1 / finger.fractional_power)


def settled_pressure(finger: FingerParameters, angle: Number) -> Number:
    """Return the pressures, Pa, that hold angles, rad: ``T = K theta**n``."""
    return finger.stiffness * angle**finger.fractional_power / finger.torque_per_pressure


def travel_for(rigs: RigParameters, angle: Number, after: float) -> Floats:
    """Return the travel of the plunger, m, that bends a rig's finger by about an angle.

    With what a fast push leaves of the memory after some time, but without what leaks away.

    Args:
        rigs: Of one finger each, with the plunger drawn out at the start.
        angle: rad, a number or shape (rigs,).
        after: Time since the push, s.
    """
    f, gas = rigs.finger, rigs.gas
    left = sum(p * np.exp(-after / t) for p, t in zip(f.memory, f.memory_time, strict=True))
    pressure = settled_pressure(f, angle) * (1 + left)
    grown = f.torque_per_pressure * angle + f.ballooning * pressure
    whole = rigs.pump.syringe_volume + f.rest_volume + gas.dead_volume
    shrunk = whole * pressure / (gas.atmosphere + pressure)
    return np.asarray((shrunk + grown) / rigs.pump.area)


def volume_for(rig: RigParameters, count: int, angle: float) -> Number:
    """Return what the plunger must sweep to bend so many fingers by an angle [rad], m^3.

    The fingers are those of the rig, in turn; all are given the pressure that the stiffest of them
    needs. By the exact gas law, `pump.finger.swept_volume`.
    """
    fingers = [rig.fingers[k % len(rig.fingers)] for k in range(count)]
    pressure = np.max([settled_pressure(finger, angle) for finger in fingers], axis=0)
    at_rest = sum(finger.rest_volume for finger in fingers)
    grown = sum(
        finger.torque_per_pressure * settled_angle(finger, pressure) + finger.ballooning * pressure
        for finger in fingers
    )
    asked = Finger(pressure, at_rest, at_rest + grown, rig.gas.dead_volume, rise_time=1.0)
    return swept_volume(asked, rig.pump.syringe_volume, rig.gas.atmosphere)
