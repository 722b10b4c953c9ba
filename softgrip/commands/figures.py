"""Write figures and tables of the book, with their numbers as CSV; in a clone of the book.

Example::

  softgrip figures "Figure 5.1" table-3-1 --into figures
  softgrip figures "Figure 4.5" --log run.csv --into figures
"""

from argparse import ArgumentParser, Namespace
from importlib import import_module
from importlib.util import find_spec

from softgrip.errors import InvalidInputError


def add_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="without any, all are written")
    parser.add_argument("--into", default="figures", metavar="FOLDER")
    parser.add_argument(
        "--log", action="append", default=[], help="of your own rig, for those that show logs"
    )


def run(asked: Namespace) -> int:
    """Write, say where, and return the exit code."""
    # The book lies beside the package in a clone; an installed package is without it.
    if find_spec("book") is None:
        raise InvalidInputError(
            "figures", expected="a clone of the book, in whose folder it is run", got="none"
        )
    write = import_module("book.companion.figures").write
    return int(write(asked.names, asked.into, asked.log))
