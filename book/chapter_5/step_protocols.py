"""The eight RMS errors of Section 5.4 under each way to make the models that the text leaves open.

``python -m book.chapter_5.step_protocols`` writes ``data/dynamics/step_test_errors.csv``.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from book.chapter_5.step_models import (
    ANGLES,
    FINGERS,
    FORCE_PER_PRESSURE,
    KINDS,
    Kind,
    answer,
    fit_test,
    identified_at,
    kept_test,
    rms_error,
)
from book.chapter_5.step_sweep import step_test
from softgrip.arrays import Floats
from softgrip.dynamics import linear, ludwick
from softgrip.dynamics.ludwick_fit import fit_finger
from softgrip.errors import InvalidInputError
from softgrip.kept import Kept
from softgrip.materials.table import material
from softgrip.units import DEG, MM

SIZE = {"width": 30 * MM, "height": 24 * MM, "length": 94 * MM}
"""Of both fingers (Section 3.4)."""
SMALL = 30
"""deg: the step that stands for small angles."""
UNIT = 1e4
"""Pa: any pressure, where the force is named by the angle that it holds."""

Model = Callable[[str, Kind, int], Floats]
"""``model(design, kind, angle)`` gives the angle, rad, shape (N,), for a test."""


def _power(design: str, kind: Kind) -> float:
    return 1.0 if kind == "linear" else FINGERS[design].estimated


def at_60(design: str, kind: Kind, angle: int) -> Floats:
    """Identify at 60 deg, with the estimated power."""
    test = kept_test(design, angle)
    return identified_at(design, kind).response(test.time, test.pressure)


def matched(design: str, kind: Kind, angle: int) -> Floats:
    """Identify at 60 deg, the gain of the linear model matched to each test: as the ledger does."""
    return answer(kind, identified_at(design, kind), kept_test(design, angle))


def _at_60_with(power: float, design: str, kind: Kind, angle: int) -> Floats:
    test, power = kept_test(design, angle), power if kind == "ludwick" else 1.0
    return fit_test(kept_test(design, 60), power).response(test.time, test.pressure)


def with_true_power(design: str, kind: Kind, angle: int) -> Floats:
    """Identify at 60 deg, with the power that Table 5.2 calls true."""
    return _at_60_with(FINGERS[design].true, design, kind, angle)


def with_table_power(design: str, kind: Kind, angle: int) -> Floats:
    """Identify at 60 deg, with the power of Table 5.1."""
    power = material(FINGERS[design].material).fractional_power
    return _at_60_with(power, design, kind, angle)


def each_by_itself(design: str, kind: Kind, angle: int) -> Floats:
    """Identify at the very test that the model is held against."""
    return identified_at(design, kind, angle).fitted


def at_small_angles(design: str, kind: Kind, angle: int) -> Floats:
    """Identify on a simulated step to 30 deg, without sensors."""
    test, small = kept_test(design, angle), step_test(design, SMALL)
    return fit_test(small, _power(design, kind)).response(test.time, test.pressure)


def driven_by_a_step(design: str, kind: Kind, angle: int) -> Floats:
    """Drive by a step of the force that holds the set point; mass and damping from 60 deg."""
    first, test, n = kept_test(design, 60), kept_test(design, angle), _power(design, kind)
    fitted = fit_finger(
        first.time,
        np.full_like(first.time, UNIT),
        first.angle,
        force_per_pressure=FORCE_PER_PRESSURE,
        fractional_power=n,
        stiffness=FORCE_PER_PRESSURE * UNIT / (60 * DEG) ** n,
    )
    return fitted.response(test.time, np.full_like(test.time, UNIT * (angle / 60) ** n))


def stated_stiffness(design: str, kind: Kind) -> float:
    """Return the stiffness by Eq. (5.10) or (5.13) as printed, N."""
    modulus = material(FINGERS[design].material).young_modulus
    if kind == "linear":
        return float(linear.spring_constant(modulus, **SIZE))
    return float(ludwick.spring_constant(modulus, FINGERS[design].estimated, **SIZE))


def stiffness_as_stated(design: str, kind: Kind, angle: int) -> Floats:
    """Hold the stiffness at Eq. (5.10) or (5.13) as printed; mass and damping from 60 deg."""
    first, test = kept_test(design, 60), kept_test(design, angle)
    fitted = fit_finger(
        first.time,
        first.pressure,
        first.angle,
        force_per_pressure=FORCE_PER_PRESSURE,
        fractional_power=_power(design, kind),
        stiffness=stated_stiffness(design, kind),
    )
    return fitted.response(test.time, test.pressure)


PROTOCOLS: dict[str, Model] = {
    "identified at 60 deg": at_60,
    "the same, the gain matched": matched,
    "the same, n true (Table 5.2)": with_true_power,
    "the same, n of Table 5.1": with_table_power,
    "each test by itself": each_by_itself,
    "identified at 30 deg": at_small_angles,
    "driven by a step of force": driven_by_a_step,
    "stiffness as printed": stiffness_as_stated,
}
"""Ways to make the models, by name."""


@dataclass(frozen=True)
class Misfit:
    """How far a model made in one way is from one test."""

    protocol: str
    design: str
    angle: int
    """Of the test, deg."""
    kind: Kind
    error: float
    """RMS, deg; NaN where the record does not determine the model."""


def errors(protocols: Iterable[str] = PROTOCOLS) -> Iterator[Misfit]:
    """Hold the models of protocols, by name, against the tests."""
    for name, design, angle, kind in product(protocols, FINGERS, ANGLES, KINDS):
        try:
            made = PROTOCOLS[name](design, kind, angle)
            error = rms_error(made, kept_test(design, angle)) / DEG
        except InvalidInputError:
            error = float("nan")
        yield Misfit(name, design, angle, kind, error)


KEPT = Kept(
    "dynamics/step_test_errors.csv",
    Misfit,
    errors,
    "python -m book.chapter_5.step_protocols",
    notes="RMS errors in deg",
    number=".4g",
)


def kept_errors() -> dict[str, dict[tuple[str, int, Kind], float]]:
    """Read the kept errors, deg, by protocol and then by (design, angle, kind)."""
    found: dict[str, dict[tuple[str, int, Kind], float]] = {}
    for row in KEPT.read():
        found.setdefault(row.protocol, {})[row.design, row.angle, row.kind] = row.error
    return found


if __name__ == "__main__":
    KEPT.main()
