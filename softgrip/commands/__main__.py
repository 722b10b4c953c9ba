"""What softgrip does to logs, tests, designs and rigs, from a shell.

Exit codes: 0 done, 1 judged and not passed, 2 could not be done, 130 interrupted. What went wrong
stands on the error stream, in one line.
"""

import sys
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Sequence
from importlib import import_module
from types import ModuleType

from softgrip.errors import SoftgripError

COMMANDS = {
    "check": "Say what a log of a rig or a pad holds, what it lacks, and what it can serve.",
    "fit": "Fit a material to a tensile test, or the simulated rig to logs, with intervals.",
    "design": "Find the best section of a finger, with a proof that no other is better: Eq. "
    "(3.20).",
    "accept": "Judge the log of a step against the printed numbers; 1 if a band failed.",
    "record": "Push the plunger of a rig, rest, and keep the log: what a rig is fitted to. The "
    "motor turns.",
    "figures": "Write figures and tables of the book, with their numbers as CSV; in a clone of "
    "the book.",
}
"""What each does, as the first line of its module says."""


def module(command: str) -> ModuleType:
    """Return what does a command: ``add_arguments`` says what it takes, ``run`` does it."""
    return import_module(f"softgrip.commands.{command}")


def parser(asked: str = "") -> ArgumentParser:
    """Return the parser, with the arguments of the command that is asked for.

    The other commands' modules are not imported.
    """
    whole = ArgumentParser(
        prog="softgrip", description=__doc__, formatter_class=RawDescriptionHelpFormatter
    )
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, about in COMMANDS.items():
        one = commands.add_parser(
            name, help=about, description=about, formatter_class=RawDescriptionHelpFormatter
        )
        if name == asked:
            example = str(module(name).__doc__).partition("\n\n")[2]
            one.epilog = example.replace("::\n\n", ":\n")
            module(name).add_arguments(one)
    return whole


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    asked = parser(next(iter(given), "")).parse_args(given)
    try:
        code: int = module(asked.command).run(asked)
    except (SoftgripError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return code


if __name__ == "__main__":
    sys.exit(main())
