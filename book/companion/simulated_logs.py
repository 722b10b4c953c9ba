"""The simulated logs that the book brings; ``python -m book.companion.simulated_logs`` makes them.

With names as arguments it makes these alone; each is the same, byte by byte, each time. A chapter
says in its file ``logs.py`` what writes each of its logs.
"""

import argparse
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path

from book.companion.exhibit import BOOK
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_folder

FOLDER = "simulated"
COMMAND = "python -m book.companion.simulated_logs"


def writers() -> dict[str, Callable[[Path, str], None]]:
    """Return what writes each log to a path, with the command that makes it, by name."""
    found: dict[str, Callable[[Path, str], None]] = {}
    for file in sorted(BOOK.glob("chapter_*/logs.py")):
        found |= import_module(f"book.{file.parent.name}.logs").LOGS
    return found


def make(name: str, folder: Path | None = None) -> Path:
    """Make one log, in place of the one that is there, and return its path.

    Parameters
    ----------
    name
        One of `writers`.
    folder
        Where to write it; None for ``data/simulated/``.

    Raises
    ------
    UnknownNameError
        If there is no such log.
    """
    known = writers()
    if name not in known:
        raise UnknownNameError("simulated log", name, list(known))
    path = (data_folder() / FOLDER if folder is None else folder) / f"{name}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    known[name](path, f"{COMMAND} {name}")
    return path


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the logs that are named, or all."""
    names = list(writers())
    parser = argparse.ArgumentParser(prog=COMMAND, description="Make simulated logs.")
    parser.add_argument("name", nargs="*", help=", ".join(names))
    for name in parser.parse_args(arguments).name or names:
        print(make(name))


if __name__ == "__main__":
    main()
