"""Writing a log while the run goes on, so that a crash or a pulled plug costs a second at most."""

import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Self

import numpy as np

from softgrip.errors import InvalidInputError
from softgrip.files import path_of
from softgrip.logs.schema import EVENT, LogHeader
from softgrip.text_table import LARGEST

SYNC_EVERY = 1.0
"""Longest time, s, that a written row waits for the disk, as long as rows keep coming."""
INSTEAD = {",": ";", '"': "'", "#": "[hash]"}
"""What parts, quotes and cuts a row where it is read as CSV with comments, and what is said for
it when words that nobody chose, such as those of an error, go into a row."""


class LogWriter:
    """Append rows to a new log; a context manager.

    Each row leaves the process at once, and goes to the disk once a second.

    Args:
        path: File to make; it must not exist, since a log is never written over.
        header: What stands before the rows.
        more: Columns beside those of the header's set-up, with their units.
        clock: Gives the seconds by which the disk is reached.

    Raises:
        InvalidInputError: If the file exists.

    >>> import tempfile
    >>> from softgrip.provenance import Provenance
    >>> header = LogHeader(Provenance.SIMULATED, "an example", "simulated rig", 0.025)
    >>> path = Path(tempfile.mkdtemp()) / "log.csv"
    >>> with LogWriter(path, header) as log:
    ...     log.write(time=0.0, command=0, pressure_counts=102, angle_counts=102,
    ...               pressure=0.0, angle=0.0, event="start")
    >>> path.read_text().splitlines()[-1]
    '0.0,0.0,102,102,0.0,0.0,start'
    """

    def __init__(
        self,
        path: Path,
        header: LogHeader,
        *,
        more: Mapping[str, str] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.units = {**header.columns, **(more or {})}
        for name, unit in self.units.items():
            if any(c in name + unit for c in '",#\r\n[]') or name == EVENT:
                raise InvalidInputError("more", expected="plain names and units", got=(name, unit))
        try:
            self._file = path_of(path).open("x", encoding="utf-8", newline="", buffering=1)
        except FileExistsError:
            raise InvalidInputError(
                "path", expected="a file that does not exist yet", got=str(path)
            ) from None
        self._clock, self._last = clock, clock()
        self._time = -np.inf
        for key, value in header.lines().items():
            self._file.write(f"# {key}: {value}".rstrip() + "\n")
        names = [f"{name} [{unit}]" for name, unit in self.units.items()]
        self._file.write(",".join([*names, EVENT]) + "\n")
        self._sync()

    def _sync(self) -> None:
        self._file.flush()
        os.fsync(self._file.fileno())

    def write(self, *, event: str = "", **values: float) -> None:
        """Append one row.

        Args:
            event: Words without comma, quote, ``#`` or anything that cannot be printed, such as a
                break. `queued_writer.plain` makes such of any.
            **values: A number for each column, in its unit, up to `LARGEST`; time must rise.
        """
        if values.keys() != self.units.keys():
            raise InvalidInputError("values", expected=f"{list(self.units)}", got=list(values))
        if any(c in INSTEAD or not c.isprintable() for c in event) or event != event.strip():
            raise InvalidInputError(
                "event", expected="words without comma, quote, # or break, not padded", got=event
            )
        cells = []
        for name, unit in self.units.items():
            value = float(values[name])
            if not abs(value) <= LARGEST or (unit == "count" and value != int(value)):
                raise InvalidInputError(name, expected=f"a finite number in {unit}", got=value)
            cells.append(str(int(value)) if unit == "count" else repr(value))
        if not values["time"] > self._time:
            raise InvalidInputError("time", expected=f"above {self._time}", got=values["time"])
        self._time = values["time"]
        self._file.write(",".join([*cells, event]) + "\n")
        if self._clock() - self._last >= SYNC_EVERY:
            self._sync()
            self._last = self._clock()

    def close(self) -> None:
        """Bring all rows to the disk and close the file."""
        if not self._file.closed:
            try:
                self._sync()
            finally:
                self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()
