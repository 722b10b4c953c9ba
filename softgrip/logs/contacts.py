"""What a log of the pad says of the contacts: which elements answered, and to what.

A log brings its own calibration. Its first row is the pad at rest, the next eight press one element
each, up to its full range; then each row is one settled contact. The event says what it is, such as
``line: small carrot``; columns say where.
"""

from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_CHANNELS, Log
from softgrip.tactile.contacts import ELEMENTS, KINDS, Contacts

TRUTH = {"contact_x": "m", "contact_y": "m", "contact_angle": "rad"}
"""Columns beside those of the set-up: middle of the contact, angle of a line (else 0)."""
REST, PRESS = "rest", "press: element "
"""Events of the rows of the calibration."""
LARGEST_COUNT = 1023


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
