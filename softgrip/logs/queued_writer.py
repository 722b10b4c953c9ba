"""A log that never holds up the run that writes it: rows wait in a queue, a thread writes them."""

import sys
import threading
from collections.abc import Mapping
from pathlib import Path
from queue import SimpleQueue
from typing import Self

from softgrip.errors import SoftgripError
from softgrip.files import path_of
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import INSTEAD, LogWriter


class RunLog:
    """A `LogWriter` behind a queue; a context manager.

    An error that ends the run is told in the last row. A disk that is full, or a row that cannot be
    written, ends the log and not the run: `failure` then says what happened, and a line on the
    standard error stream says it at once.

    Args:
        path, header, more: As of `LogWriter`, whose errors on opening are raised here too.

    Attributes:
        failure: Why rows are missing; empty if none is.
    """

    def __init__(
        self, path: Path, header: LogHeader, *, more: Mapping[str, str] | None = None
    ) -> None:
        self.path, self.failure = path_of(path), ""
        self._log = LogWriter(path, header, more=more)
        self._last: tuple[str, dict[str, float]] | None = None
        self._rows: SimpleQueue[tuple[str, dict[str, float]] | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._drain, name="softgrip log", daemon=True)
        self._thread.start()

    def write(self, *, event: str = "", **values: float) -> None:
        """Take a row, as of `LogWriter.write`, and return at once."""
        self._release()
        self._last = event, values

    def note(self, words: str) -> None:
        """Add words to the last row, which therefore waits for the next one."""
        if self._last is not None:
            event, values = self._last
            self._last = "; ".join(filter(None, (event, plain(words)))), values

    def _release(self) -> None:
        if self._last is not None:
            self._rows.put(self._last)
            self._last = None

    def _drain(self) -> None:
        while (row := self._rows.get()) is not None:
            if self.failure:
                continue
            event, values = row
            try:
                self._log.write(event=event, **values)
            except (OSError, SoftgripError) as error:
                self._fail(error)

    def _fail(self, error: Exception) -> None:
        self.failure = f"{type(error).__name__}: {error}"
        print(f"{self.path}: the log ends here, the run goes on ({error})", file=sys.stderr)

    def close(self) -> None:
        """Write what waits, and close the file."""
        if self._thread.is_alive():
            self._release()
            self._rows.put(None)
            self._thread.join()
        try:
            self._log.close()
        except OSError as error:
            if not self.failure:
                self._fail(error)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type | None, error: object, trace: object) -> None:
        if kind is not None:  # Ctrl-C too: the log says why it ends
            self.note(f"ended by {kind.__name__}: {error}")
        self.close()


def plain(words: str) -> str:
    r"""Return words as a log can hold them; what it cannot hold stays to be seen.

    >>> plain('lost, "again", at #3')
    "lost; 'again'; at [hash]3"
    >>> print(plain("two" + chr(10) + "lines" + chr(7)))
    two lines\x07
    """
    joined = " ".join("".join(INSTEAD.get(c, c) for c in words).split())
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in joined)
