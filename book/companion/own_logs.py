"""A reader's logs in the place of those of the book."""

from collections.abc import Sequence
from pathlib import Path

from softgrip.errors import InvalidInputError
from softgrip.logs.reader import kept_log


def in_place(logs: Sequence[Path | str], kept: Sequence[str]) -> tuple[Path | str, ...]:
    """Return the logs that a reader gives, in the order of the kept ones, or these without any.

    Raises:
        InvalidInputError: If there are more than an exhibit has places.
    """
    if len(logs) > len(kept):
        expected = f"{len(kept)} at most, in the places of {', '.join(kept)}"
        raise InvalidInputError("logs", expected=expected, got=len(logs))
    return tuple(logs) or tuple(kept_log(name) for name in kept)
