"""A simulated hand that does with the simulated pad what the words of a step say.

The words are the events of `softgrip.logs.contacts`. A press lasts as the constants below say, and
is made again and again until other words come; each contact is laid and pressed anew.
"""

from dataclasses import dataclass, replace

import numpy as np

from softgrip.arrays import Floats
from softgrip.logs.contacts import CONTACT, PRESS, REST, WEIGHT, weight_of
from softgrip.simulator.chance import SEED, streams
from softgrip.simulator.fitted_rigs import fitted_pad
from softgrip.simulator.pad import Pad, convert, make_pad, press, voltages
from softgrip.simulator.pad_objects import PadObject, pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.simulator.sensors import Counts
from softgrip.tactile.contacts import KINDS
from softgrip.units import DEG, MM

FORCES = (0.05, 0.3)
"""Least and largest contact force, N (assumed: they hold the three grasps of Section 2.4)."""
REACH = {"point": (12 * MM, 11 * MM), "line": (4 * MM, 4 * MM), "surface": (3 * MM, 3 * MM)}
"""Largest offset of an object's middle along and across the pad, m (assumed)."""
FULL = 0.3
"""Force that brings an element to the end of its range, N: above the 0.2 N of Section 2.2."""
CYCLE, CORNERS = 2.5, (0.4, 0.6, 2.1, 2.3)
"""s from press to press, and of a press: begin, full force, begin and end of the release."""
SCALE = pad_object("block 40 mm")
"""What weights stand on."""


def draw_pose(item: PadObject, tilt: float, chance: np.random.Generator) -> Pose:
    """Return a random pose: uniform place and angle, normal tilt with a deviation in rad."""
    reach = REACH[item.kind]
    x, y = (float(chance.uniform(-r, r)) for r in reach)
    angle = float(chance.uniform(-90 * DEG, 90 * DEG))
    along, across = (float(tilt * value) for value in chance.standard_normal(2))
    # A round object rolls until it is level: there is no way to hold it otherwise.
    level = {"point": (0.0, 0.0), "line": (along, 0.0), "surface": (along, across)}
    return Pose((x, y), angle, level[item.kind])


@dataclass(frozen=True)
class Press:
    """What the hand did: the object, how it lay, and its force, N."""

    item: PadObject
    pose: Pose
    force: float


class PadHand:
    """A hand with a pad before it.

    Args:
        seed: Of poses, forces, surfaces and noise.
        pad_seed: Of the pad.

    Attributes:
        presses: The contacts whose full force was reached; weights and calibration are none.
    """

    def __init__(self, *, seed: int = 0, pad_seed: int = SEED) -> None:
        self.parameters = fitted_pad()
        self.presses: list[Press] = []
        self._pad = self._own_pad = make_pad(self.parameters, pad_seed)
        self._chance, self._noise = streams(seed, 0)
        self._words, self._begun, self._number = REST, 0.0, -1
        self._coming: Press | None = None
        self._forces: Floats = np.zeros(self.parameters.layout.elements)

    def obey(self, words: str, time: float) -> None:
        """Begin at a time, s, to do what words say.

        Raises:
            UnknownNameError: If they name no object of `pad_objects`.
        """
        kind, _, name = words.partition(": ")
        if kind in (*KINDS, CONTACT):
            pad_object(name)
        self._words, self._begun, self._number, self._coming = words, time, -1, None

    def counts(self, time: float) -> Counts:
        """Return the counts of the nine channels at a time, s, shape (9,)."""
        number, phase = divmod(time - self._begun, CYCLE)
        if number != self._number:
            self._number = int(number)
            self._forces, self._pad = self._next()
        if self._coming and phase >= CORNERS[1]:
            self.presses.append(self._coming)
            self._coming = None
        share = np.interp(phase, CORNERS, (0.0, 1.0, 1.0, 0.0))
        volts = voltages(self._pad, share * self._forces, time)
        volts = volts + self.parameters.noise * self._noise.standard_normal(volts.size)
        return convert(volts, self.parameters)

    def _next(self) -> tuple[Floats, Pad]:
        """Return the forces on the elements of the next press, N, and the pad as it answers it."""
        own, chance = self._own_pad, self._chance
        elements = self.parameters.layout.elements
        drawn = self.parameters.repeatability * chance.standard_normal(elements)
        pad = replace(own, gain=own.gain * (1 + drawn))
        if self._words.startswith(PRESS):
            return FULL * np.eye(elements)[int(self._words.removeprefix(PRESS)) - 1], pad
        if self._words.startswith(WEIGHT):
            return press(own, SCALE, Pose((0.0, 0.0)), weight_of(self._words)), pad
        kind, _, name = self._words.partition(": ")
        if kind not in (*KINDS, CONTACT):
            return np.zeros(elements), pad
        item = pad_object(name)
        pose = draw_pose(item, self.parameters.tilt, chance)
        force = float(chance.uniform(*FORCES))
        self._coming = Press(item, pose, force)
        return press(own, item, pose, force, chance), pad
