"""``python -m softgrip.rig``: check a rig, find a board, judge a log, or fit a rig to logs."""

import argparse
import sys
from collections.abc import Sequence

from softgrip.board.find import candidates
from softgrip.errors import SoftgripError
from softgrip.rig.accept import add_accept_arguments, run_accept
from softgrip.rig.check import run_check
from softgrip.rig.connect import connect
from softgrip.rig.fit import add_fit_arguments, run_fit


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    parser = argparse.ArgumentParser(prog="python -m softgrip.rig", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("check", help="diagnose a rig; nothing moves")
    one.add_argument("--port", help="a port, a URL, simulated, emulated, replay:PATH; none: look")
    one.add_argument("--fingers", type=int, default=1)
    one.add_argument("--calibration", help="file of the board's calibration")
    commands.add_parser("find", help="list the ports that may be a board")
    one = commands.add_parser("accept", help="judge the log of a step against the printed numbers")
    add_accept_arguments(one)
    one = commands.add_parser("fit", help="fit the simulated rig to your own logs")
    add_fit_arguments(one)
    asked = parser.parse_args(arguments)
    try:
        if asked.command == "check":
            return run_check(
                lambda: connect(asked.port, fingers=asked.fingers, calibration=asked.calibration)
            )
        if asked.command == "find":
            seen = candidates()
            print("\n".join(map(str, seen)) or "no USB port of a known maker")
            return int(not any(candidate.answered for candidate in seen))
        return run_fit(asked) if asked.command == "fit" else run_accept(asked)
    except (SoftgripError, OSError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
