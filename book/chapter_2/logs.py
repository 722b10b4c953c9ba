"""The two simulated logs of the pad: how they are made; `simulator.pad_tests` says of what."""

from functools import partial
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.logs.contacts import PRESS, REST, TRUTH, read_contacts
from softgrip.logs.schema import PAD_CHANNELS, LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance, data_file
from softgrip.reads import remembered
from softgrip.simulator.chance import streams
from softgrip.simulator.fitted_rigs import fitted_pad
from softgrip.simulator.pad import convert, make_pad, press, to_volts, voltages
from softgrip.simulator.pad_hand import FULL
from softgrip.simulator.pad_tests import BETWEEN, PAD_SEED, PAD_TESTS, draw_contacts
from softgrip.tactile.contact_pose import PlaceErrors, place_errors
from softgrip.tactile.contacts import ELEMENTS, Contacts
from softgrip.tactile.pad_layout import THREE_TWO_THREE

ROUND = 9
"""Digits after the point in a log: a nanometre, a nanoradian."""


def write_pad_log(name: str, path: Path, source: str) -> None:
    """Write one simulated log; the path must be free.

    Args:
        name: A key of `PAD_TESTS`.
        path: Of the log.
        source: The command that makes it.
    """
    test, parameters = PAD_TESTS[name], fitted_pad()
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
