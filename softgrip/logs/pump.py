"""The pump of a log, from its header."""

from pathlib import Path

from softgrip.errors import DataFileError
from softgrip.logs.schema import Log
from softgrip.pump.flow import Pump


def pump_of(path: Path, log: Log) -> Pump:
    """Return the pump that a log names by ``area`` in m^2 and ``lead`` in m.

    Raises:
        DataFileError: If the header lacks one of them, or has another unit.
    """
    notes = log.header.notes
    try:
        area, lead = (notes[name].split() for name in ("area", "lead"))
        if (area[1], lead[1]) != ("m^2", "m"):
            raise ValueError(f"{area[1]}, {lead[1]}")
        return Pump(float(area[0]), float(lead[0]))
    except (KeyError, ValueError, IndexError) as error:
        raise DataFileError(
            path, expected="'area: <number> m^2' and 'lead: <number> m' in the header",
            got=repr(error),
        ) from None  # fmt: skip
