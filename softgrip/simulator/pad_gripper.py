"""The simulated two-finger gripper: a servomotor, the pad on one finger, plain rubber on the other.

Section 2.4 says that it is custom-made, two-fingered, driven by a servomotor and run every 25 ms.
Everything else is assumed, in `GraspGripper`.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats
from softgrip.checks import check_fields
from softgrip.simulator.pad import Pad
from softgrip.simulator.pad_contact import bed_points, force_at_depth, spring_stiffness
from softgrip.simulator.pad_objects import PadObject
from softgrip.simulator.pad_surface import Pose, gap
from softgrip.tactile.element import STATED_MODULUS
from softgrip.tactile.pad_layout import PAD_SIZE
from softgrip.units import MM


@dataclass(frozen=True)
class GraspGripper:
    """The gripper's parameters; each with the reason for its value. All but two are assumed.

    Attributes:
        lag: s, of the servomotor's position. Assumed: a hobby servo without load.
        speed: Largest speed of closing, m/s. Assumed: 60 degrees in 0.2 s on a stroke of 40 mm in
            180 degrees give 67 mm/s; with a load, some less.
        resolution: m, of the commanded position. Assumed: that stroke in 2000 pulse widths of a
            microsecond each. Dead band and play of the gears are left out.
        delay: Periods by which a command comes late. Assumed: a servo takes one in every 20 ms.
        opening: m, between finger and object at first. Assumed.
        plain_thickness: m, of the rubber on the other finger: that of the printed pad (Section
            2.2).
        plain_modulus: Pa, of that rubber: the printed one.
    """

    lag: float = 0.030
    speed: float = 0.050
    resolution: float = 0.02 * MM
    delay: int = 1
    opening: float = 5 * MM
    plain_thickness: float = 8 * MM
    plain_modulus: float = STATED_MODULUS

    def __post_init__(self) -> None:
        check_fields(self, zero=("delay", "opening"))


@dataclass(frozen=True, eq=False)
class Squeeze:
    """Contact force, N, by how far the gripper has closed from the first touch, m.

    Attributes:
        closing, force: Shape (points,), both rising from zero; between the points it is straight.
    """

    closing: Floats
    force: Floats

    def at(self, closing: Floats) -> Floats:
        """Return the force at a closing, N, same shape; zero before the touch."""
        found: Floats = np.interp(closing, self.closing, self.force)
        return found

    def stiffness(self, force: float) -> float:
        """Return the slope about a force, N/m, over a tenth of it to both sides."""
        ends = np.interp((0.9 * force, 1.1 * force), self.force, self.closing)
        return float(0.2 * force / (ends[1] - ends[0]))


DEEPEST, DEPTHS = 30 * MM, 1001
"""Depth up to which a side is tabulated, and how many depths are: closer near zero."""
LARGEST, FORCES = 1.0, 501
"""N, end of the tabulated force: beyond the range of the force layer; and how many are."""
CELL = 1 * MM
"""Side of the cells of the plain rubber."""


def pad_side(pad: Pad, item: PadObject, pose: Pose, depth: Floats) -> Floats:
    """Return the force, N, of the pad on a smooth object at depths beyond the touch, m."""
    gaps = gap(item, pose, bed_points(pad.parameters)) - pad.height[:, None]
    ordered = np.sort(gaps - gaps.min(), axis=-1)
    k = np.full(len(ordered), spring_stiffness(pad.parameters, item.softness))
    deep = np.broadcast_to(depth[:, None], (depth.size, len(ordered)))
    found: Floats = force_at_depth(deep, ordered, k, pad.compliance).sum(axis=-1)
    return found


def plain_side(gripper: GraspGripper, item: PadObject, pose: Pose, depth: Floats) -> Floats:
    """Return the same of the plain rubber, taken as a mattress of the pad's area.

    A mattress lets each of its cells be pressed alone; a slab of rubber is stiffer under a wide
    object. As it is stiffer than the pad anyway, that matters little.
    """
    x, y = (np.arange(-size / 2 + CELL / 2, size / 2, CELL) for size in PAD_SIZE)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    soft = gripper.plain_thickness / gripper.plain_modulus + item.softness
    dents = np.maximum(depth[:, None] - gap(item, pose, points), 0.0)
    found: Floats = CELL**2 / soft * dents.sum(axis=-1)
    return found


def squeeze(pad: Pad, item: PadObject, pose: Pose, gripper: GraspGripper) -> Squeeze:
    """Return how the force rises as the gripper closes: both sides bear it, one after the other.

    Args:
        pad: On one finger.
        item, pose: What is grasped, and how it lies against both fingers; smooth.
        gripper: With the other finger.
    """
    depth = DEEPEST * np.linspace(0, 1, DEPTHS) ** 2
    force = np.linspace(0, LARGEST, FORCES)
    sides = (pad_side(pad, item, pose, depth), plain_side(gripper, item, pose, depth))
    return Squeeze(sum((np.interp(force, side, depth) for side in sides), 0.0 * force), force)


def servo_position(position: Floats, target: Floats, time: float, gripper: GraspGripper) -> Floats:
    """Return where the servomotor is after a time, m: a first-order lag whose speed is limited.

    Args:
        position, target: m, shape (runs,).
        time: s, >= 0.
        gripper: Its lag and speed.
    """
    away = target - position
    fast = np.clip((np.abs(away) - gripper.speed * gripper.lag) / gripper.speed, 0.0, time)
    moved = np.sign(away) * gripper.speed * fast
    found: Floats = position + moved + (away - moved) * -np.expm1(-(time - fast) / gripper.lag)
    return found
