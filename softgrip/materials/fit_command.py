"""Elasticity from a tester's export: ``python -m softgrip.materials fit``."""

import json
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from dataclasses import asdict
from typing import get_args

from softgrip.errors import InvalidInputError
from softgrip.materials.elasticity import Elasticity, Estimate, elasticity
from softgrip.materials.first_loading import Zero
from softgrip.materials.tester import Export, read_export
from softgrip.materials.tester_columns import UNITS
from softgrip.quantities import in_si

FIT_EXAMPLE = """example:
  python -m softgrip.materials fit rubber.csv --gauge-length "30 mm" --area "12 mm^2"
  python -m softgrip.materials fit rubber.csv --column strain="my strain [%]" --json

exit codes: 0 fitted, 2 could not be judged
"""
FIT_FORMAT = RawDescriptionHelpFormatter


def add_fit_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("file", help="text table of force and extension, or of stress and strain")
    parser.add_argument("--gauge-length", metavar="LENGTH", help='such as "30 mm"')
    parser.add_argument("--area", help='first cross-section, such as "12 mm^2"')
    parser.add_argument(
        "--column", action="append", default=[], metavar="WHAT=HEADING",
        help=f"heading of a column, where it is not found; WHAT is one of {', '.join(UNITS)}",
    )  # fmt: skip
    parser.add_argument(
        "--zero", choices=get_args(Zero), help="what the strain is counted from, if it is asked"
    )
    parser.add_argument(
        "--compression-positive", action="store_true", help="the tester counts tension below zero"
    )
    parser.add_argument(
        "--young-modulus",
        metavar="STRESS",
        help='E to hold, such as "0.1 MPa"; without, it is fitted',
    )
    parser.add_argument("--json", action="store_true", help="all of it in SI, for scripts")


def run_fit(asked: Namespace) -> int:
    """Read, fit and print; return the exit code."""
    pairs = [one.partition("=") for one in asked.column]
    if wrong := next((what for what, sign, _ in pairs if not sign), None):
        raise InvalidInputError("--column", expected="WHAT=HEADING", got=wrong)
    export = read_export(
        asked.file,
        columns={what: name for what, _, name in pairs},
        gauge_length=asked.gauge_length,
        area=asked.area,
        zero=asked.zero,
        compression_positive=asked.compression_positive,
    )
    held = asked.young_modulus and in_si("young_modulus", asked.young_modulus, "Pa")
    found = elasticity(export.test, young_modulus=held, preload_error=export.preload_error)
    if asked.json:
        read = {"slack": export.slack, "preload": export.preload, "notes": export.notes}
        print(json.dumps(asdict(found) | read, indent=2))
    else:
        print(words(found, export))
    return 0


def words(found: Elasticity, export: Export) -> str:
    """Return a fit in words."""
    lines = [
        f"{found.name}: {found.rows} rows, up to a strain of {found.largest_strain:.4g}; "
        f"intervals of {found.confidence:.0%}, of this specimen",
        f"Ludwick's law, off by {_kpa(found.ludwick_rms)} kPa root mean square",
        f"  E, its stress at strain 1  {_interval(found.young_modulus, 1e3)} kPa",
        f"  n                          {_interval(found.fractional_power)}",
        f"Slope up to a strain of {found.window:.3g}",
        f"                             {_interval(found.small_strain_modulus, 1e3)} kPa",
        f"Yeoh's law, off by {_kpa(found.yeoh_rms)} kPa root mean square",
        *(
            f"  C{k}                         {_interval(one, 1e3)} kPa"
            for k, one in enumerate(found.yeoh, start=1)
        ),
        *(
            []
            if found.ludwick_holds
            else ["note  Ludwick's law does not hold: it misses the curve"]
        ),
        *(f"note  {note}" for note in export.notes),
    ]
    return "\n".join(lines)


def _kpa(stress: float) -> str:
    return f"{stress / 1e3:.3g}"


def _interval(one: Estimate, unit: float = 1.0) -> str:
    value, low, high = (f"{x / unit:.4g}" for x in (one.value, one.low, one.high))
    return f"{value} ({low} to {high})"
