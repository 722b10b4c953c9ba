"""``python -m softgrip.logs check FILE``: what a log holds, what it lacks, what it can serve."""

import argparse
import sys
from collections.abc import Sequence

from softgrip.errors import SoftgripError
from softgrip.logs.check import describe


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code: 0, or 2 for a log that cannot be read."""
    parser = argparse.ArgumentParser(prog="python -m softgrip.logs", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("check", help="say what a log holds and what it can serve")
    one.add_argument("log", nargs="+")
    asked, code = parser.parse_args(arguments), 0
    for path in asked.log:
        try:
            print(describe(path))
        except (SoftgripError, OSError) as error:
            print(error, file=sys.stderr)
            code = 2
    return code


if __name__ == "__main__":
    sys.exit(main())
