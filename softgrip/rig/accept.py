"""The command that judges the log of a step: ``python -m softgrip.rig accept``."""

import json
from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from math import isfinite
from typing import get_args

from softgrip.logs.reader import read_log
from softgrip.rig.acceptance import Band, Experiment, judge, report


def add_accept_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("log", help="of a step, with its reference")
    parser.add_argument("--experiment", choices=get_args(Experiment), required=True)
    parser.add_argument("--json", action="store_true", help="all of it, for scripts")


def run_accept(asked: Namespace) -> int:
    """Judge, print, and return the exit code: 1 if a band failed."""
    notes, bands = read_log(asked.log).repairs, judge(asked.log, asked.experiment)
    if asked.json:
        print(json.dumps({"notes": notes, "bands": [_record(band) for band in bands]}, indent=2))
    else:
        print("\n".join([*(f"note  {words}" for words in notes), report(bands)]))
    return int(not all(band.passed for band in bands))


def _record(band: Band) -> dict[str, object]:
    # JSON knows no infinity, which is the time of a step that does not settle.
    found = band.found if isfinite(band.found) else None
    return asdict(band) | {"found": found, "passed": band.passed}
