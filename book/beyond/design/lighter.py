"""How much lighter than Design 1 a finger can be that does as much.

``python -m book.beyond.design.lighter`` makes ``data/design/lighter.csv`` anew. The rubber is
Dragon Skin 20: as Table 5.1 has it, and each draw of its tensile test.
"""

import argparse
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from softgrip.actuator.design import (
    SCRIPT_BOUNDS,
    SCRIPT_MASS,
    Bounds,
    DesignProblem,
    FrequencyBand,
)
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.limits import LimitedProblem, Limits, measures
from softgrip.actuator.limits_certificate import lightest
from softgrip.actuator.printed import table_3_1
from softgrip.arrays import Floats
from softgrip.journal import continued
from softgrip.kept import Kept
from softgrip.materials.draws import draws
from softgrip.materials.table import material

RUBBER = "Dragon Skin 20"
FASTEST = 1e3
"""Upper end of a band that limits the frequency from below alone, rad/s."""
ROOM = 1e-7
"""By which part what Design 1 does is asked for less, so that it is itself within the limits."""
PRINTED = -1
"""Instead of the number of a draw: E and n of Table 5.1."""


@dataclass(frozen=True)
class Case:
    """What a lighter finger must keep of Design 1.

    Attributes:
        goal: "sum" of Eq. (3.17), or "torque": then the angle, too.
        share: Of each, that it must have.
        frequency: Whether it must be as fast.
        script: Whether the limits of a and b are those of the author's script, or of Section 3.3.
    """

    goal: str
    share: float
    frequency: bool
    script: bool


CASES: Mapping[str, Case] = {
    "limits of the script": Case("sum", 1.0, False, True),
    "the same sum": Case("sum", 1.0, False, False),
    "the same torque, angle and frequency": Case("torque", 1.0, True, False),
    "nine tenths of torque and angle": Case("torque", 0.9, False, False),
}


@dataclass(frozen=True)
class Asked:
    """A case and a draw."""

    case: str
    draw: int


@dataclass(frozen=True)
class Lighter:
    """The lightest finger of a case.

    Attributes:
        case, draw: Of `CASES`, and the number of the draw or `PRINTED`.
        mass: Its rubber, kg.
        saved: Share of Design 1's rubber.
        proven: 1 if it is proved that none is lighter, to a thousandth.
        top, bottom, width, wall: Its section, m.
    """

    case: str
    draw: int
    mass: float
    saved: float
    proven: int
    top: float
    bottom: float
    width: float
    wall: float


def elasticity(draw: int) -> tuple[float, float]:
    """Return E, Pa, and n of a draw."""
    if draw == PRINTED:
        rubber = material(RUBBER)
        return rubber.young_modulus, rubber.fractional_power
    E, n = draws()[RUBBER][draw].tolist()
    return E, n


def problem(asked: Asked) -> tuple[LimitedProblem, float, float]:
    """Return the problem, the objective that is wanted, and the mass of Design 1, kg."""
    case = CASES[asked.case]
    E, n = elasticity(asked.draw)
    stated = DesignProblem(
        young_modulus=E,
        fractional_power=n,
        bounds=SCRIPT_BOUNDS if case.script else Bounds(),
        combined="sum" if case.goal == "sum" else "torque",
    )
    design_1 = table_3_1()["Opt. parameters"]
    found = measures(LimitedProblem(stated), design_1)
    part = case.share * (1 - ROOM)
    if case.frequency:
        moves = float(natural_frequency(stated.finger(design_1), SCRIPT_MASS))
        stated = replace(stated, band=FrequencyBand(part * moves, FASTEST))
    angle = part * float(found["angle"]) if case.goal != "sum" else 0.0
    limits = Limits(angle=angle, buckling=1.0)
    wanted = part * float(found["objective"])
    return LimitedProblem(stated, limits=limits), wanted, float(found["mass"])


def lighter(asked: Asked) -> Lighter:
    """Return the lightest finger of a case and a draw."""
    limited, wanted, heavy = problem(asked)
    found = lightest(limited, wanted)
    sides = asdict(found.section)
    saved = 1 - found.mass / heavy
    return Lighter(asked.case, asked.draw, found.mass, saved, int(found.proven), **sides)


def _worked(asked: Asked) -> dict[str, Any]:
    return asdict(lighter(asked))


def asked() -> list[Asked]:
    """Return all cases with the printed rubber and each draw."""
    numbers = (PRINTED, *range(len(draws()[RUBBER])))
    return [Asked(case, draw) for case in CASES for draw in numbers]


def _made(journal: Path | None = None, jobs: int | None = None) -> Iterable[Lighter]:
    if journal is not None:
        return [Lighter(**each) for each in continued(_worked, asked(), journal, jobs=jobs)]
    with TemporaryDirectory() as folder:
        return _made(Path(folder) / "lighter.jsonl", jobs)


KEPT = Kept(
    "design/lighter.csv",
    Lighter,
    _made,
    "python -m book.beyond.design.lighter",
    notes=f"SI; {RUBBER}; draw {PRINTED} is E and n of Table 5.1, others are of "
    "materials/draws.csv. Each row is certified.",
    number=".7g",
)


def saved(case: str) -> tuple[float, Floats]:
    """Return the share of mass that is saved: with the printed rubber, and by draw."""
    rows = [row for row in KEPT.read() if row.case == case]
    printed = next(row.saved for row in rows if row.draw == PRINTED)
    return printed, np.array([row.saved for row in rows if row.draw != PRINTED])


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the kept table anew."""
    parser = argparse.ArgumentParser(
        prog="python -m book.beyond.design.lighter", description=__doc__
    )
    parser.add_argument("--journal", type=Path, help="of answers; with one that is there, go on")
    parser.add_argument("--jobs", type=int, help="processes; all that joblib's configuration says")
    chosen = parser.parse_args(arguments)
    print(replace(KEPT, make=partial(_made, chosen.journal, chosen.jobs)).write())


if __name__ == "__main__":
    main()
