"""Fit a material to a tensile test, or the simulated rig to logs, with intervals.

Example::

  softgrip fit material rubber.csv --gauge-length "30 mm" --area "12 mm^2"
  softgrip fit rig step.csv push.csv -o my-rig.csv
"""

from argparse import ArgumentParser, Namespace

from softgrip.materials.fit_command import add_fit_arguments as add_material
from softgrip.materials.fit_command import run_fit as fit_material
from softgrip.rig.fit import add_fit_arguments as add_rig
from softgrip.rig.fit import run_fit as fit_rig

WHAT = {
    "material": (add_material, fit_material, "E, n and Yeoh's law of a tensile test"),
    "rig": (add_rig, fit_rig, "a simulated rig like yours, for connect('simulated:FILE')"),
}


def add_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    kinds = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    for name, (add, _, about) in WHAT.items():
        add(kinds.add_parser(name, help=about, description=about))


def run(asked: Namespace) -> int:
    """Fit, print, and return the exit code."""
    return WHAT[asked.what][1](asked)
