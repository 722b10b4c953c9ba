"""Which contacts the two simulated logs of the pad hold.

As in Sections 2.3 and 2.4: 630 contacts to learn from (its objects are not printed: here 21, seven
a kind, 30 contacts each), and the eight foods with ten contacts each. Objects, places and angles
come in random order.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from softgrip.simulator.chance import SEED
from softgrip.simulator.pad_objects import FOODS, OTHERS, PadObject
from softgrip.simulator.pad_surface import Pose
from softgrip.units import DEG, MM

FORCES = (0.05, 0.3)
"""Least and largest contact force, N (assumed: they hold the three grasps of Section 2.4)."""
REACH = {"point": (12 * MM, 11 * MM), "line": (4 * MM, 4 * MM), "surface": (3 * MM, 3 * MM)}
"""Largest offset of an object's middle along and across the pad, m (assumed)."""
BETWEEN = 10.0
"""Time from contact to contact, s (assumed)."""


@dataclass(frozen=True)
class PadTest:
    """What a log of the pad holds.

    Attributes
    ----------
    objects
        What is pressed on it.
    repeats
        Contacts of each.
    seed
        Of order, places, forces, surfaces and noise.
    words
        What the log shows.
    """

    objects: tuple[PadObject, ...]
    repeats: int
    seed: int
    words: str


PAD_SEED = SEED
"""Of the pad: both logs are of the same one."""

PAD_TESTS = {
    "pad-training": PadTest(
        (*FOODS, *OTHERS), 30, 2025, "630 contacts of 21 objects to learn the contact kind from"
    ),
    "pad-objects": PadTest(FOODS, 10, 2026, "80 contacts of the eight foods of Section 2.4"),
}
"""The logs by name."""


def draw_pose(item: PadObject, tilt: float, chance: np.random.Generator) -> Pose:
    """Return a random pose: uniform place and angle, normal tilt with a deviation in rad."""
    reach = REACH[item.kind]
    x, y = (float(chance.uniform(-r, r)) for r in reach)
    angle = float(chance.uniform(-90 * DEG, 90 * DEG))
    along, across = (float(tilt * value) for value in chance.standard_normal(2))
    # A round object rolls until it is level: there is no way to hold it otherwise.
    level = {"point": (0.0, 0.0), "line": (along, 0.0), "surface": (along, across)}
    return Pose((x, y), angle, level[item.kind])


def draw_contacts(
    test: PadTest, tilt: float, chance: np.random.Generator
) -> Iterator[tuple[PadObject, Pose, float]]:
    """Yield the contacts of a test in their order: object, pose and force, N."""
    order = chance.permutation(np.repeat(np.arange(len(test.objects)), test.repeats))
    for number in order:
        item = test.objects[number]
        pose = draw_pose(item, tilt, chance)
        # To a millinewton, as the command of a press would be.
        yield item, pose, round(float(chance.uniform(*FORCES)), 3)
