"""Which files are read: by the interpreter's own audit, and through what is kept in memory."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

_open: list[set[Path]] = []
"""The records that are being taken, the innermost last."""
elsewhere: set[Path] = set()
"""What other processes read for this one."""


def listen(heard: Callable[[Path], object], *events: str) -> None:
    """Have every path told that an audit event, such as ``open``, reads from now on.

    The interpreter never lets a listener go: call this once.
    """

    def audit(event: str, args: tuple[object, ...]) -> None:
        if event in events and isinstance(args[0], str | os.PathLike):
            mode = args[1] if event == "open" else None
            if mode is None or (isinstance(mode, str) and "r" in mode):
                heard(Path(os.path.realpath(args[0])))

    sys.addaudithook(audit)


def note(paths: set[Path] | frozenset[Path]) -> None:
    """Count files as read, in all records that are being taken."""
    for record in _open:
        record |= paths


@cache
def _start() -> None:
    listen(lambda path: note({path}), "open")


@contextmanager
def recorded() -> Iterator[set[Path]]:
    """Return the files that are read within, also by those who are only `remembered`."""
    _start()
    _open.append(set())
    try:
        yield _open[-1]
    finally:
        _open.pop()


def remembered(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Cache a function, as `functools.cache` does, together with the files that it read.

    A result from memory counts as read from them again: whoever shows it can say where it is from.
    It is forgotten by ``cache_clear``, as there.
    """

    @cache
    def first(*args: Arguments.args, **kwargs: Arguments.kwargs) -> tuple[Result, frozenset[Path]]:
        with recorded() as files:
            result = function(*args, **kwargs)
        return result, frozenset(files)

    @wraps(function)
    def again(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        result, files = first(*args, **kwargs)  # type: ignore[arg-type]  # hashable, as for any cache
        note(files)
        return result

    again.cache_clear = first.cache_clear  # type: ignore[attr-defined]
    return again
