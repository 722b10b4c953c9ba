"""The trade-off of torque, bending, frequency, mass, size and air over materials and chambers.

A point of the front is an answer to one question: the largest torque at a pressure, of a finger of
so many chambers from one rubber, which bends by a quarter turn at least, does not buckle, and keeps
one limit more. (The method of epsilon constraints: V. Chankong and Y. Y. Haimes, Multiobjective
Decision Making, 1983; each point is one of the Pareto front, or has an equal that is.) Each answer
is certified by `limits_certificate`, also that there is none. ``python -m softgrip.actuator.front``
makes ``data/design/front.csv`` anew.
"""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product
from math import inf, nan, pi
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from softgrip.actuator.design import SCRIPT_MASS, FrequencyBand
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.limits import LimitedProblem, Limits
from softgrip.actuator.limits_certificate import NothingWithinLimitsError, best_within
from softgrip.arrays import Flags
from softgrip.journal import continued
from softgrip.kept import Kept
from softgrip.materials.table import table_5_1
from softgrip.units import MM

LEAST_ANGLE = pi / 2
"""Bending that every finger of the front has, rad."""
FASTEST = 1e3
"""Upper end of a band that limits the frequency from below alone, rad/s."""
CHAMBERS = (4, 6, 8)
PRESSURES = (30e3, 60e3, 120e3)
"""Pa: from what the softest rubbers bear to nearly the 0.15 MPa of the printed design."""
MASSES = (0.015, 0.030)
"""kg: the printed design has 34 g."""
FINE_MASSES = (0.018, 0.021, 0.024, 0.027)
"""Between them, for six chambers at the middle pressure."""
ENVELOPES = (30e3 * MM**3, 45e3 * MM**3)
AIRS = (10e-6, 20e-6)
FREQUENCIES = (1.5, 2.0)


@dataclass(frozen=True)
class Question:
    """What is asked of a finger.

    Attributes:
        material: Of Table 5.1.
        chambers: Their number; it says the length.
        pressure: Pa.
        largest_mass, largest_envelope, largest_air: kg, m^3 and m^3; infinity for no limit.
        least_frequency: Natural frequency with the mass of the author's script, rad/s; 0 for none.
    """

    material: str
    chambers: int
    pressure: float
    largest_mass: float = inf
    largest_envelope: float = inf
    largest_air: float = inf
    least_frequency: float = 0.0

    def problem(self) -> LimitedProblem:
        """Return the problem whose best section is the answer."""
        slow = self.least_frequency
        band = FrequencyBand(slow, FASTEST) if slow else None
        limits = Limits(
            angle=LEAST_ANGLE,
            mass=self.largest_mass,
            envelope=self.largest_envelope,
            air=self.largest_air,
            buckling=1.0,
        )
        return LimitedProblem.for_material(
            self.material,
            self.chambers,
            limits=limits,
            pressure=self.pressure,
            combined="torque",
            torque_scale=1.0,
            band=band,
        )


@dataclass(frozen=True)
class Answer:
    """The best finger; NaN and no words where there is none.

    Attributes:
        feasible: 1, or 0 if it is proved that no section will do.
        proven: 1 if the torque is proved to be the largest to `certificate.TOLERANCE`, or that
            there is none.
        top, bottom, width, wall: The section, m.
        torque, angle, frequency: N m, rad and rad/s.
        mass, envelope, air: kg, m^3 and m^3.
        buckling: Buckling pressure over the pressure.
        bound: No section has a larger torque, N m.
        boxes: Whose bound was taken.
        active: Limits and dimensions at whose ends it lies.
    """

    feasible: int
    proven: int
    top: float = nan
    bottom: float = nan
    width: float = nan
    wall: float = nan
    torque: float = nan
    angle: float = nan
    frequency: float = nan
    mass: float = nan
    envelope: float = nan
    air: float = nan
    buckling: float = nan
    bound: float = nan
    boxes: int = 0
    active: str = ""


@dataclass(frozen=True)
class Point:
    """A question and its answer."""

    question: Question
    answer: Answer


def questions() -> list[Question]:
    """Return what is asked.

    Each material, number of chambers and pressure with a limit of mass, and six chambers at the
    middle pressure with other limits of mass, or one of size, of air, or of frequency.
    """
    names = [*table_5_1()]
    asked = [
        Question(name, chambers, pressure, mass)
        for name, chambers, pressure, mass in product(names, CHAMBERS, PRESSURES, MASSES)
    ]
    for name in names:
        plain = Question(name, CHAMBERS[1], PRESSURES[1])
        asked += [replace(plain, largest_mass=most) for most in FINE_MASSES]
        asked += [replace(plain, largest_envelope=most) for most in ENVELOPES]
        asked += [replace(plain, largest_air=most) for most in AIRS]
        asked += [replace(plain, least_frequency=least) for least in FREQUENCIES]
    return asked


def answer(question: Question) -> Answer:
    """Return the certified answer to a question."""
    limited = question.problem()
    try:
        found = best_within(limited)
    except NothingWithinLimitsError as none:
        return Answer(feasible=0, proven=int("proved" in str(none)))
    values = found.values
    moves = natural_frequency(limited.problem.finger(found.section), SCRIPT_MASS)
    return Answer(
        feasible=1,
        proven=int(found.proven),
        **asdict(found.section),
        frequency=float(moves),
        bound=found.upper_bound * limited.problem.torque_scale,
        boxes=found.boxes,
        active=" ".join(found.active),
        buckling=min(values["up"], values["aside"]),
        **{name: values[name] for name in ("torque", "angle", "mass", "envelope", "air")},
    )


def _worked(question: Question) -> Mapping[str, Any]:
    return asdict(answer(question))


def sweep(asked: Sequence[Question], journal: Path, *, jobs: int | None = None) -> list[Point]:
    """Return the point of each question; see `journal.continued`, which goes on where it stopped.

    Args:
        asked: The questions.
        journal: File of the answers that are there.
        jobs: As joblib's `n_jobs`; None leaves it to its configuration.
    """
    found = continued(_worked, asked, journal, jobs=jobs)
    return [Point(one, Answer(**each)) for one, each in zip(asked, found, strict=True)]


OBJECTIVES = {"torque": 1, "angle": 1, "frequency": 1, "mass": -1, "envelope": -1, "air": -1}
"""What is traded, and whether more of it is better."""


def undominated(points: Sequence[Point]) -> Flags:
    """Tell which points no other of the same pressure is as good as in all and better in one."""
    good = np.array(
        [[sign * getattr(p.answer, name) for name, sign in OBJECTIVES.items()] for p in points]
    )
    pressure = np.array([p.question.pressure for p in points])
    best = np.array([p.answer.feasible == 1 for p in points])
    for k in np.flatnonzero(best):
        rivals = (pressure == pressure[k]) & np.array([p.answer.feasible == 1 for p in points])
        with np.errstate(invalid="ignore"):
            as_good = (good >= good[k]).all(axis=1) & rivals
            best[k] = not (as_good & (good > good[k]).any(axis=1)).any()
    return best


def _made(journal: Path | None = None, jobs: int | None = None) -> list[Point]:
    if journal is not None:
        return sweep(questions(), journal, jobs=jobs)
    with TemporaryDirectory() as folder:
        return sweep(questions(), Path(folder) / "front.jsonl", jobs=jobs)


KEPT = Kept(
    "design/front.csv",
    Point,
    _made,
    "python -m softgrip.actuator.front",
    notes="SI; E, n and density of each rubber are printed and its supplier's. Each row is "
    "certified; see softgrip.actuator.limits_certificate.",
    number=".7g",
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Make the kept front anew."""
    parser = argparse.ArgumentParser(prog="python -m softgrip.actuator.front", description=__doc__)
    parser.add_argument("--journal", type=Path, help="of answers; with one that is there, go on")
    parser.add_argument("--jobs", type=int, help="processes; all that joblib's configuration says")
    chosen = parser.parse_args(arguments)
    print(replace(KEPT, make=partial(_made, chosen.journal, chosen.jobs)).write())


if __name__ == "__main__":
    main()
