"""``python -m book.companion.figures [NAME ...]``: write figures and tables into a folder.

Without a name all are written; a name is a title ("Figure 5.1") or a file's name ("figure-5-1").
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from book.companion.exhibit import exhibit, exhibits, with_logs
from book.companion.save import save
from softgrip.errors import InvalidInputError, SoftgripError


def _title(name: str) -> str:
    kind, _, number = name.replace(" ", "-").partition("-")
    return f"{kind} {number.replace('-', '.')}"


def write(names: Sequence[str], into: Path | str, logs: Sequence[Path | str] = ()) -> int:
    """Write the exhibits that are asked for, or all; say where, and return 0.

    Raises:
        UnknownNameError: If there is none of a name; the message lists those there are.
        InvalidInputError: If there are logs, and no names of exhibits that show them.
        DataFileError: If a log cannot be read.
    """
    if logs and not names:
        raise InvalidInputError("names", expected="what shall show the logs", got="none")
    asked = [exhibit(_title(name)) for name in names] or exhibits()
    for item in [with_logs(item, logs) for item in asked] if logs else asked:
        seconds = save(item, Path(into)).seconds
        print(f"{item.title:12} {seconds:6.2f} s  {Path(into) / item.name}", flush=True)
        for words in item.repairs:
            print(f"note  {words}")
    return 0


def main() -> int:
    """Write the exhibits that are asked for, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m book.companion.figures", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--into", type=Path, default=Path("book/_build/figures"), metavar="FOLDER")
    asked = parser.parse_args()
    try:
        return write(asked.names, asked.into)
    except (SoftgripError, OSError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
