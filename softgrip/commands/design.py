r"""Find the best section of a finger, with a proof that no other is better: Eq. (3.20).

Example::

  softgrip design --pressure "80 kPa" --material "Dragon Skin 20" --length "80 mm" \
    --top "10 mm" "16 mm" --width "15 mm" "22 mm" --frequency 0.4 0.8 --mass "100 g"
  softgrip design --material "Dragon Skin 20" --rubber "25 g" --buckling 1 --stl mould
  softgrip design --json
"""

import json
from argparse import ArgumentParser, Namespace
from dataclasses import asdict, fields
from math import inf
from pathlib import Path

from softgrip.actuator.certificate import CertifiedDesign, certified_design
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand
from softgrip.actuator.limits import DRAGON_SKIN_20, LimitedProblem, Limits
from softgrip.actuator.limits_certificate import LimitedDesign, best_within
from softgrip.actuator.mould import write_mould
from softgrip.actuator.section import Section
from softgrip.actuator.size import CHAMBERS, Layout, air_volume, check_layout, finger_mass
from softgrip.commands.quantity import quantity
from softgrip.errors import InvalidInputError
from softgrip.materials.densities import density
from softgrip.units import DEG, ML, MM

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
    parser.add_argument("--chambers", type=int, default=CHAMBERS, help="%(default)s if not given")
    parser.add_argument(
        "--rubber",
        type=quantity,
        metavar="MASS",
        help='largest mass of the rubber, such as "25 g"',
    )
    parser.add_argument(
        "--buckling",
        type=float,
        metavar="FACTOR",
        help="least buckling pressure over the pressure, such as 1; without it, it may buckle",
    )
    parser.add_argument(
        "--stl",
        type=Path,
        metavar="FOLDER",
        help="write a mould there, two trays and a core: STL files, which have no unit, in mm",
    )
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


def layout(asked: Namespace, stated: DesignProblem) -> Layout:
    """Return the finger's chambers and length."""
    return Layout(asked.chambers, stated.length)


def rubber(asked: Namespace) -> float:
    """Return the density of the rubber, kg/m^3: that of the dissertation's without a material."""
    return DRAGON_SKIN_20 if asked.material is None else density(asked.material)


def words(found: CertifiedDesign) -> str:
    """Return a design in words."""
    design, proof = found.design, found.certificate
    return "\n".join(
        [
            *_does(design.section, design.torque, design.angle, design.objective, design.active),
            _proof(design.objective, proof.upper_bound, proof.boxes, proof.proven),
        ]
    )


def limited_words(found: LimitedDesign) -> str:
    """Return a design within limits in words."""
    values = found.values
    return "\n".join(
        [
            *_does(
                found.section, values["torque"], values["angle"], values["objective"], found.active
            ),
            _proof(values["objective"], found.upper_bound, found.boxes, found.proven),
        ]
    )


def _does(
    section: Section, torque: float, angle: float, objective: float, active: tuple[str, ...]
) -> list[str]:
    sizes = ", ".join(f"{name} {value / MM:.3g} mm" for name, value in asdict(section).items())
    return [
        sizes,
        f"torque {torque:.3g} N m, bending {angle / DEG:.3g} deg, objective {objective:.6g}",
        f"at its ends: {', '.join(active) or 'none'}",
    ]


def _proof(objective: float, bound: float, boxes: int, proven: bool) -> str:
    if not proven:
        return f"not proved: one of up to {bound:.6g} may be there"
    return (
        f"no other section is better by more than {bound / objective - 1:.1e}"
        f" of the objective: {boxes} boxes were bounded"
    )


def run(asked: Namespace) -> int:
    """Solve, print, and return the exit code: 1 if the design could not be proved."""
    stated = problem(asked)
    placed, heavy = layout(asked, stated), rubber(asked)
    limited = asked.rubber is not None or asked.buckling is not None
    if not limited:
        whole = certified_design(stated)
        section, proven = whole.design.section, whole.certificate.proven
        found, said = asdict(whole), words(whole)
    else:
        most = inf if asked.rubber is None else asked.rubber
        limits = Limits(mass=most, buckling=asked.buckling or 0.0)
        light = best_within(LimitedProblem(stated, placed, heavy, limits))
        section, proven = light.section, light.proven
        found, said = asdict(light), limited_words(light)
    if asked.stl is not None or limited:
        check_layout(placed, section)
        mass, air = finger_mass(section, placed, heavy), air_volume(section, placed)
        found |= {"mass": mass, "air": air}
        said += (
            f"\n{placed.chambers} chambers: {1e3 * mass:.3g} g of rubber of {heavy:g} kg/m^3,"
            f" {air / ML:.3g} mL of air"
        )
    if asked.stl is not None:
        files = write_mould(section, placed, asked.stl)
        found |= {"stl": list(map(str, files))}
        said += "".join(f"\nwritten, in mm: {file}" for file in files)
    print(json.dumps(found, indent=2) if asked.json else said)
    return int(not proven)
