"""Torque and bending of Chapter 3's designs, in closed form."""

import numpy as np

from book.twin import rigs
from book.twin.laboratory import Laboratory
from book.twin.step_tests import Measures
from softgrip.simulator.statics import settled_angle
from softgrip.units import DEG, MPa

DESIGNS = {"design-1": rigs.design_1, "design-2": rigs.design_2, "design-3": rigs.design_3}
TORQUE_PRESSURE, ANGLE_PRESSURE = 0.25 * MPa, 0.15 * MPa
TORQUE_SCALE, ANGLE_SCALE = 0.4, 1.4 * np.pi
"""N m and rad, of Eq. (3.20)."""


def statics(lab: Laboratory) -> Measures:
    """Return torque held straight at 0.25 MPa, N m, and angle, deg, and the sum at 0.15 MPa."""
    found: Measures = {}
    for name, make in DESIGNS.items():
        finger = make(lab.values).finger
        pushes, angle = finger.torque_per_pressure, settled_angle(finger, ANGLE_PRESSURE)
        found[f"torque-{name}"] = pushes * TORQUE_PRESSURE
        found[f"angle-{name}"] = angle / DEG
        found[f"sum-{name}"] = pushes * ANGLE_PRESSURE / TORQUE_SCALE + angle / ANGLE_SCALE
    return found


FAST = {"statics": statics}
