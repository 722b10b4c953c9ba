"""Judge the log of a step against the printed numbers; 1 if a band failed.

Example::

  softgrip accept lqr.csv --experiment lqr
  softgrip accept lqr.csv --experiment lqr --json
"""

import json
from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from math import isfinite
from typing import get_args

from softgrip.logs.reader import read_log
from softgrip.rig.acceptance import Band, Experiment, judge, report


def add_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("log", help="of a step, with its reference")
    parser.add_argument("--experiment", choices=get_args(Experiment), required=True)
    parser.add_argument("--json", action="store_true", help="all of it, for scripts")


def _record(band: Band) -> dict[str, object]:
    # JSON knows no infinity, which is the time of a step that does not settle.
    found = band.found if isfinite(band.found) else None
    return asdict(band) | {"found": found, "passed": band.passed}


def run(asked: Namespace) -> int:
    """Judge, print, and return the exit code."""
    bands, notes = judge(asked.log, asked.experiment), read_log(asked.log).repairs
    if asked.json:
        print(json.dumps({"notes": notes, "bands": [_record(band) for band in bands]}, indent=2))
    else:
        print("\n".join([*(f"note  {words}" for words in notes), report(bands)]))
    return int(not all(band.passed for band in bands))
