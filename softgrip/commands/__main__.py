"""What softgrip does to logs, tests, designs and rigs, from a shell.

Exit codes: 0 done, 1 judged and not passed, 2 could not be done, 130 interrupted. What went wrong
stands on the error stream, in one line.
"""

import sys
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Sequence

from softgrip.commands import accept, check, design, figures, fit, record
from softgrip.errors import SoftgripError

COMMANDS = {
    "check": check,
    "fit": fit,
    "design": design,
    "accept": accept,
    "record": record,
    "figures": figures,
}
"""Each module says what it takes (``add_arguments``) and does it (``run``)."""


def parser() -> ArgumentParser:
    """Return the parser of all commands; the first line of a module says what its command does."""
    whole = ArgumentParser(
        prog="softgrip", description=__doc__, formatter_class=RawDescriptionHelpFormatter
    )
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, module in COMMANDS.items():
        about, _, example = str(module.__doc__).partition("\n\n")
        one = commands.add_parser(
            name,
            help=about,
            description=about,
            epilog=example.replace("::\n\n", ":\n"),
            formatter_class=RawDescriptionHelpFormatter,
        )
        module.add_arguments(one)
    return whole


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    asked = parser().parse_args(arguments)
    try:
        code: int = COMMANDS[asked.command].run(asked)
    except (SoftgripError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130
    return code


if __name__ == "__main__":
    sys.exit(main())
