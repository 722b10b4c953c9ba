"""What is pressed on the simulated pad in Sections 2.3 and 2.4, and in which order.

630 contacts to learn from (their objects are not printed: here 21, seven a kind, 30 contacts each),
and the eight foods with ten contacts each. Objects, places and angles come in random order.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from softgrip.simulator.chance import SEED
from softgrip.simulator.pad_hand import FORCES, draw_pose
from softgrip.simulator.pad_objects import FOODS, OTHERS, PadObject
from softgrip.simulator.pad_surface import Pose

BETWEEN = 10.0
"""Time from contact to contact, s (assumed)."""


@dataclass(frozen=True)
class PadTest:
    """What a log of the pad holds.

    Attributes:
        objects: What is pressed on it.
        repeats: Contacts of each.
        seed: Of order, places, forces, surfaces and noise.
        words: What the log shows.
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
