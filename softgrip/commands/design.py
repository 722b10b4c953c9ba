r"""Find the best section of a finger, with a proof that no other is better: Eq. (3.20).

Example::

  softgrip design --pressure "80 kPa" --material "Dragon Skin 20" --length "80 mm" \
    --top "10 mm" "16 mm" --width "15 mm" "22 mm" --frequency 0.4 0.8 --mass "100 g"
  softgrip design --json
"""

import json
from argparse import ArgumentParser, Namespace
from dataclasses import asdict, fields

from softgrip.actuator.certificate import CertifiedDesign, certified_design
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand
from softgrip.commands.quantity import quantity
from softgrip.errors import InvalidInputError
from softgrip.units import DEG, MM

OF_PROBLEM = {
    "pressure": 'held, such as "80 kPa"',
    "young_modulus": 'E, such as "0.15 MPa"',
    "fractional_power": "n of Ludwick's law",
    "length": 'of the finger, such as "80 mm"',
}
"""Arguments that are fields of `DesignProblem`; without one, its own value holds."""


def add_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes; a number without a unit is in SI."""
    for name, about in OF_PROBLEM.items():
        parser.add_argument(f"--{name.replace('_', '-')}", type=quantity, help=about)
    parser.add_argument("--material", metavar="NAME", help="of Table 5.1, for its E and n")
    for one in fields(Bounds):
        parser.add_argument(
            f"--{one.name}",
            nargs=2,
            type=quantity,
            metavar=("LEAST", "LARGEST"),
            help='such as "10 mm" "16 mm"',
        )
    parser.add_argument(
        "--frequency",
        nargs=2,
        type=quantity,
        metavar=("LOW", "HIGH"),
        help="natural frequency, rad/s",
    )
    parser.add_argument("--mass", type=quantity, help='that swings, such as "100 g"')
    parser.add_argument("--json", action="store_true", help="all of it in SI, for scripts")


def problem(asked: Namespace) -> DesignProblem:
    """Return the problem that the arguments state; without any, that of the dissertation."""
    given = {name: getattr(asked, name) for name in OF_PROBLEM if getattr(asked, name) is not None}
    doubled = sorted(given.keys() & {"young_modulus", "fractional_power"})
    if asked.material is not None and doubled:
        raise InvalidInputError(
            "--material", expected="E and n of the table, or your own", got=f"both {doubled}"
        )
    if not isinstance(given.get("fractional_power", 1.0), float):
        raise InvalidInputError(
            "--fractional-power", expected="a number", got=given["fractional_power"]
        )
    own = {one.name: getattr(asked, one.name) for one in fields(Bounds)}
    bounds = Bounds(**{name: tuple(ends) for name, ends in own.items() if ends is not None})
    if asked.mass is not None and asked.frequency is None:
        raise InvalidInputError("--mass", expected="--frequency beside it", got="none")
    masses = {} if asked.mass is None else {"least_mass": asked.mass, "largest_mass": asked.mass}
    band = None if asked.frequency is None else FrequencyBand(*asked.frequency, **masses)
    if asked.material is not None:
        return DesignProblem.for_material(asked.material, **given, bounds=bounds, band=band)
    return DesignProblem(**given, bounds=bounds, band=band)


def words(found: CertifiedDesign) -> str:
    """Return a design in words."""
    design, proof = found.design, found.certificate
    sizes = ", ".join(
        f"{name} {value / MM:.3g} mm" for name, value in asdict(design.section).items()
    )
    proved = (
        f"no other section is better by more than {proof.upper_bound / proof.objective - 1:.1e}"
        f" of the objective: {proof.boxes} boxes were bounded"
        if proof.proven
        else f"not proved: one of up to {proof.upper_bound:.6g} may be there"
    )
    return "\n".join(
        [
            sizes,
            f"torque {design.torque:.3g} N m, bending {design.angle / DEG:.3g} deg,"
            f" objective {design.objective:.6g}",
            f"at its ends: {', '.join(design.active) or 'none'}",
            proved,
        ]
    )


def run(asked: Namespace) -> int:
    """Solve, print, and return the exit code: 1 if the design could not be proved."""
    found = certified_design(problem(asked))
    print(json.dumps(asdict(found), indent=2) if asked.json else words(found))
    return int(not found.certificate.proven)
