"""``python -m softgrip.materials``: fit a test of yours, or make the kept fits and facts anew."""

import argparse
import sys
from collections.abc import Sequence

from softgrip.errors import SoftgripError
from softgrip.materials import facts, fitting
from softgrip.materials.fit_command import FIT_EXAMPLE, FIT_FORMAT, add_fit_arguments, run_fit


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m softgrip.materials", description=__doc__)
    commands = parser.add_subparsers(dest="command", help="without: the kept fits and facts")
    about = "E, n and Yeoh's law of a tensile test of any material, with intervals"
    add_fit_arguments(
        commands.add_parser(
            "fit", help=about, description=about, epilog=FIT_EXAMPLE, formatter_class=FIT_FORMAT
        )
    )
    asked = parser.parse_args(arguments)
    try:
        if asked.command == "fit":
            return run_fit(asked)
        fitting.KEPT.main()
        facts.KEPT.main()
    except (SoftgripError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
