"""``python -m softgrip.logs check FILE``: what a log holds, what it lacks, what it can serve."""

import argparse
import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import asdict

from softgrip.errors import SoftgripError
from softgrip.logs.check import contents


def add_check_arguments(parser: ArgumentParser) -> None:
    """Say what ``check`` takes."""
    parser.add_argument("log", nargs="+", help="of any program; see the page 'Your own data'")
    parser.add_argument("--json", action="store_true", help="all of it, a list, for scripts")


def run_check(asked: Namespace) -> int:
    """Say what each log holds; return 0, or 2 if one cannot be read."""
    found, code = [], 0
    for path in asked.log:
        try:
            found.append(contents(path))
        except (SoftgripError, OSError) as error:
            print(error, file=sys.stderr)
            code = 2
    if asked.json:
        print(json.dumps([asdict(one) for one in found], indent=2))
    else:
        print("\n".join(map(str, found)))
    return code


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m softgrip.logs", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    add_check_arguments(
        commands.add_parser("check", help="say what a log holds and what it can serve")
    )
    return run_check(parser.parse_args(arguments))


if __name__ == "__main__":
    sys.exit(main())
