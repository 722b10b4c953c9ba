"""The two simulated logs of the pad: which contacts they hold, and how they are made.

As in Sections 2.3 and 2.4: 630 contacts to learn from (its objects are not printed: here 21, seven
a kind, 30 contacts each), and the eight foods with ten contacts each. Objects, places and angles
come in random order.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.logs.contacts import PRESS, REST, TRUTH, read_contacts
from softgrip.logs.schema import PAD_CHANNELS, LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance, data_file
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED, streams
from softgrip.simulator.pad import convert, make_pad, press, to_volts, voltages
from softgrip.simulator.pad_hand import FORCES, FULL, draw_pose
from softgrip.simulator.pad_objects import FOODS, OTHERS, PadObject
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import PlaceErrors, place_errors
from softgrip.tactile.contacts import ELEMENTS, Contacts
from softgrip.tactile.pad_layout import THREE_TWO_THREE

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


ROUND = 9
"""Digits after the point in a log: a nanometre, a nanoradian."""


def write_pad_log(name: str, path: Path, source: str) -> None:
    """Write one simulated log; the path must be free.

    Args:
        name: A key of `PAD_TESTS`.
        path: Of the log.
        source: The command that makes it.
    """
    test, parameters = PAD_TESTS[name], PadParameters()
    pad = make_pad(parameters, PAD_SEED)
    laid, noise = streams(test.seed, 0)
    header = LogHeader(
        provenance=Provenance.SIMULATED,
        source=source,
        back_end="simulated rig",
        period=BETWEEN,
        calibration="data/calibration/pad.csv",
        seed=f"{test.seed}, pad {PAD_SEED}",
        notes={"shows": test.words},
        set_up="pad",
    )
    with LogWriter(path, header, more=TRUTH) as log:
        rows = 0

        def write(event: str, force: float, forces: Floats, truth: tuple[float, ...]) -> None:
            nonlocal rows
            rows += 1
            time = BETWEEN * rows
            counts = convert(voltages(pad, forces, time, noise), parameters)
            values = dict(zip(PAD_CHANNELS, map(float, to_volts(counts, parameters)), strict=True))
            values |= {f"{c}_counts": int(v) for c, v in zip(PAD_CHANNELS, counts, strict=True)}
            values |= {name: round(v, ROUND) for name, v in zip(TRUTH, truth, strict=True)}
            log.write(time=time, command=force, event=event, **values)

        nowhere = (0.0, 0.0, 0.0)
        write(REST, 0.0, np.zeros(ELEMENTS), nowhere)
        for k, one in enumerate(np.eye(ELEMENTS)):
            write(f"{PRESS}{k + 1}", FULL, FULL * one, (*pad.parameters.layout.places[k], 0.0))
        for item, pose, force in draw_contacts(test, parameters.tilt, laid):
            forces = press(pad, item, pose, force, laid)
            angle = pose.angle if item.kind == "line" else 0.0
            write(f"{item.kind}: {item.name}", force, forces, (*pose.place, angle))


LOGS = {name: partial(write_pad_log, name) for name in PAD_TESTS}
"""What writes each log, by name, to a path, with the command that makes it."""

TRAINING, OBJECTS = "simulated/pad-training.csv", "simulated/pad-objects.csv"
"""The logs below ``data/``."""


@remembered
def contacts(name: str) -> Contacts:
    """Read a log of the simulated pad, `TRAINING` or `OBJECTS`."""
    return read_contacts(data_file(name).path)


@remembered
def errors(name: str) -> PlaceErrors:
    """Return the errors of place and angle of its contacts."""
    return place_errors(contacts(name), THREE_TWO_THREE)
