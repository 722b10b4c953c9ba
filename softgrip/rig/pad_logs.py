"""Logs of the pad: how the simulated ones are written, and how contacts are read from any.

A log brings its own calibration. Its first row is the pad at rest, the next eight press one element
each, up to its full range; then each row is one settled contact. The event says what it is, such as
``line: small carrot``; columns say where.
"""

from pathlib import Path

import numpy as np
import pandas as pd

from softgrip.errors import DataFileError
from softgrip.materials.arrays import Floats
from softgrip.provenance import Provenance, data_file
from softgrip.rig.chance import streams
from softgrip.rig.log_reader import read_log
from softgrip.rig.log_schema import PAD_CHANNELS, Log, LogHeader
from softgrip.rig.logs import LogWriter
from softgrip.rig.pad_parameters import PadParameters
from softgrip.rig.pad_protocol import BETWEEN, PAD_SEED, PAD_TESTS, draw_contacts
from softgrip.rig.pad_rig import convert, make_pad, press, to_volts, voltages
from softgrip.tactile.contacts import ELEMENTS, KINDS, Contacts

TRUTH = {"contact_x": "m", "contact_y": "m", "contact_angle": "rad"}
"""Columns beside those of the set-up: middle of the contact, angle of a line (else 0)."""
REST, PRESS = "rest", "press: element "
"""Events of the rows of the calibration."""
FULL = 0.3
"""Force that brings an element to the end of its range, N: above the 0.2 N of Section 2.2."""
ROUND = 9
"""Digits after the point in a log: a nanometre, a nanoradian."""
LARGEST_COUNT = 1023


def write_pad_log(name: str, path: Path, source: str) -> None:
    """Write one simulated log; the path must be free.

    Parameters
    ----------
    name
        A key of `pad_protocol.PAD_TESTS`.
    path
        Of the log.
    source
        The command that makes it.
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


def normalized(log: Log, path: Path) -> Floats:
    """Return the responses of the elements in each row, 0 at rest to 1 pressed, shape (rows, 8).

    Parameters
    ----------
    log
        Of a pad, with the rows of its calibration.
    path
        Named in errors.

    Raises
    ------
    DataFileError
        If it has no such rows, a channel is at the end of the converter's range, or an element
        does not change when it is pressed.
    """
    for name in PAD_CHANNELS[:ELEMENTS]:
        counts = log[f"{name}_counts"]
        if ((counts <= 0) | (counts >= LARGEST_COUNT)).any():
            row = int(np.argmax((counts <= 0) | (counts >= LARGEST_COUNT)))
            raise DataFileError(
                path,
                expected=f"{name}_counts between 1 and {LARGEST_COUNT - 1}",
                got=f"{counts[row]:g} at {log['time'][row]:g} s: saturated, or a broken wire",
            )
    volts = np.stack([log[name] for name in PAD_CHANNELS[:ELEMENTS]], axis=1)
    rows = {event: int(np.searchsorted(log["time"], time)) for time, event in log.events}
    wanted = [REST, *(f"{PRESS}{k + 1}" for k in range(ELEMENTS))]
    if missing := [event for event in wanted if event not in rows]:
        raise DataFileError(path, expected=f"rows with the events {wanted}", got=f"no {missing}")
    rest = volts[rows[REST]]
    full = np.diag(volts[[rows[event] for event in wanted[1:]]])
    for name, change in zip(PAD_CHANNELS, full - rest, strict=False):
        if not change > 0:
            raise DataFileError(
                path, expected=f"{name} to rise when pressed", got=f"a change of {change:g} V"
            )
    found: Floats = np.clip((volts - rest) / (full - rest), 0, 1)
    return found


def read_contacts(path: Path | str) -> Contacts:
    """Read the contacts of a log of the pad.

    Parameters
    ----------
    path
        Of the log.

    Raises
    ------
    DataFileError
        If it is no log of a pad, says no truth of its contacts, or as of `normalized`.
    """
    file = Path(path)
    log = read_log(file)
    if log.header.set_up != "pad":
        raise DataFileError(file, expected="the set-up pad", got=log.header.set_up)
    if missing := [name for name in TRUTH if name not in log.columns]:
        raise DataFileError(file, expected=f"the columns {list(TRUTH)}", got=f"no {missing}")
    responses = normalized(log, file)
    # A kind of contact, a colon, the name of an object; other events are no contacts.
    told = [(time, *event.partition(": ")[::2]) for time, event in log.events]
    found = [(time, kind, name) for time, kind, name in told if kind in KINDS]
    rows = np.searchsorted(log["time"], [time for time, _, _ in found])
    kinds = np.array([kind for _, kind, _ in found], dtype=str)
    return Contacts(
        responses=responses[rows],
        kinds=kinds,
        objects=np.array([name for _, _, name in found], dtype=str),
        places=np.stack([log["contact_x"], log["contact_y"]], axis=1)[rows],
        angles=np.where(kinds == "line", log["contact_angle"][rows], np.nan),
        forces=log["command"][rows],
    )


def write_readings(log: str, path: Path | str) -> None:
    """Write a kept log as a reader would write readings of a pad: volts of each element, the kind.

    Parameters
    ----------
    log
        Below ``data/``.
    path
        Of the CSV file; elements ``e1`` to ``e8``, 1 V at rest and 4 V at full range.
    """
    felt = read_contacts(data_file(log).path)
    frame = pd.DataFrame(1 + 3 * felt.responses, columns=[f"e{k + 1}" for k in range(ELEMENTS)])
    frame.assign(kind=felt.kinds).round(4).to_csv(path, index=False)
