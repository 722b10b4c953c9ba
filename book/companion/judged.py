"""Verdicts that a build has reached once, for all pages that tell them.

Judging all claims takes half a minute of computing, and the pages of the ledger, of the errata, of
the front and of the chapters all tell verdicts. The build judges each chapter in a process of its
own, and lays what came of it, with the files that it hangs on, where `VARIABLE` says.
"""

import os
import pickle
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from softgrip import reads

VARIABLE = "SOFTGRIP_JUDGED"
"""Names the folder, where there is one."""

Judged = tuple[Any, frozenset[Path]]
"""An entry, and the files that judging it read."""


def file_of(folder: Path, chapter: int) -> Path:
    """Return the file of a chapter."""
    return folder / f"chapter-{chapter}.pickle"


def write(path: Path, found: Mapping[str, Judged], used: frozenset[Path]) -> None:
    """Write what was judged, by id, and the files that all of it hangs on: all, or nothing."""
    aside = path.with_suffix(".part")
    aside.write_bytes(pickle.dumps((found, used)))
    aside.replace(path)


@cache
def _of_chapter(folder: str, chapter: int) -> Mapping[str, Judged]:
    path = file_of(Path(folder), chapter)
    if not path.is_file():
        return {}
    found, used = pickle.loads(path.read_bytes())
    reads.elsewhere |= used
    return found  # type: ignore[no-any-return]


def judged(chapter: int, claim: str) -> Any:
    """Return the entry of a claim that a build has judged; None without."""
    if not (folder := os.environ.get(VARIABLE)):
        return None
    entry, files = _of_chapter(folder, chapter).get(claim, (None, frozenset()))
    reads.note(files)
    return entry
