"""Where the linear model stops being good enough: errors over the size of the step.

``python -m book.chapter_5.step_sweep`` writes ``data/dynamics/step_sweep.csv``: for steps of 10 to
140 deg of the simulated rig, without its sensors, the RMS error of several models against the mean
of seven runs. The models that are identified at 60 deg are so on the step of this sweep, so that no
lag of a sensor is in them. The rig's own spring is one of Ludwick's law: that this law fares well
here is no finding. What the linear model loses is.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import nan

import numpy as np
from scipy.optimize import minimize

from book.chapter_5.step_models import (
    FINGERS,
    FORCE_PER_PRESSURE,
    fit_test,
    rms_error,
)
from softgrip.arrays import Floats
from softgrip.dynamics.linear import second_order
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import InvalidInputError
from softgrip.kept import Kept
from softgrip.logs.repeated_steps import StepTest
from softgrip.simulator.chance import SEED
from softgrip.simulator.fitted_rigs import design_1, design_3
from softgrip.simulator.steps import simulate_step_test, travel_to
from softgrip.units import DEG

ANGLES = tuple(range(10, 141, 10))
IDENTIFIED = 60
"""deg: of the first step test."""
RIGS = {"Design 1": design_1, "Design 2": design_3}


@dataclass(frozen=True)
class SweepPoint:
    """Errors at one step; all RMS against the mean of seven runs, deg.

    Attributes:
        design: Chapter 5's name of the finger.
        angle: At which the median run ends, deg.
        linear, ludwick: Of the two models identified at 60 deg.
        linear_again, ludwick_again: Of models identified anew on this very step; NaN if it tells
            none.
        linear_range: The largest, among the steps up to this one, of the one linear model that
            keeps it least.
        runs: Of the single runs: what the material's spread alone makes.
    """

    design: str
    angle: int
    linear: float
    ludwick: float
    linear_again: float
    ludwick_again: float
    linear_range: float
    runs: float


def one_for_all(tests: Sequence[StepTest], start: SecondOrder) -> tuple[SecondOrder, float]:
    """Return the linear model whose largest RMS error over several tests is least, and that, rad.

    Args:
        tests: Of one sampling.
        start: Where the search begins.
    """
    time = tests[0].time
    pressure, angle = (np.stack([getattr(t, n) for t in tests]) for n in ("pressure", "angle"))

    def system(x: Floats) -> SecondOrder:
        return SecondOrder(*(float(v) for v in np.exp(x)))

    def largest(x: Floats) -> float:
        off = response(system(x), time, pressure, initial_pressure=0.0) - angle
        return float(np.sqrt((off**2).mean(axis=1)).max())

    x = np.log([start.natural_frequency, start.damping_ratio, start.gain])
    found = minimize(largest, x, method="Nelder-Mead", options={"xatol": 1e-4, "fatol": 1e-6})
    return system(found.x), float(found.fun)


def step_test(design: str, angle: int) -> StepTest:
    """Simulate seven steps of a finger to an angle, deg, without sensors."""
    rig = RIGS[design]()
    return simulate_step_test(rig, travel_to(rig, angle * DEG), runs=7, seed=SEED)


def _rms_again(test: StepTest, power: float) -> float:
    """Return the RMS error of a model fitted to a test, rad; NaN if the test does not tell one."""
    try:
        return fit_test(test, power).rms
    except InvalidInputError:
        return nan


def sweep() -> Iterator[SweepPoint]:
    """Simulate the steps and hold the models against them; takes a minute."""
    for design in RIGS:
        tests: list[StepTest] = []
        powers = (1.0, FINGERS[design].estimated)
        models = [fit_test(step_test(design, IDENTIFIED), power) for power in powers]
        start = second_order(models[0].finger, FORCE_PER_PRESSURE)
        for angle in ANGLES:
            tests.append(test := step_test(design, angle))
            start, worst = one_for_all(tests, start)
            errors = [
                *(rms_error(model.response(test.time, test.pressure), test) for model in models),
                *(_rms_again(test, power) for power in powers),
                worst,
                float(np.sqrt(np.mean((test.angles - test.angle) ** 2))),
            ]
            yield SweepPoint(design, angle, *(error / DEG for error in errors))


KEPT = Kept(
    "dynamics/step_sweep.csv",
    SweepPoint,
    sweep,
    "python -m book.chapter_5.step_sweep",
    notes="angle and errors in deg",
    number=".4g",
)

if __name__ == "__main__":
    KEPT.main()
