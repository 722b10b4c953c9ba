"""Where the linear model stops being good enough: errors over the size of the step.

``python -m book.chapter_5.step_sweep`` writes ``data/dynamics/step_sweep.csv``: for steps of 10 to
140 deg of the simulated rig, without its sensors, the RMS error of several models against the mean
of seven runs. The rig's own spring is one of Ludwick's law: that this law fares well here is no
finding. What the linear model loses is.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from book.chapter_5.step_models import (
    FINGERS,
    FORCE_PER_PRESSURE,
    KINDS,
    fit_test,
    identified_at,
    rms_error,
)
from softgrip.arrays import Floats
from softgrip.dynamics.linear import second_order
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.kept import Kept
from softgrip.logs.repeated_steps import StepTest
from softgrip.simulator.calibration import design_1, design_3
from softgrip.simulator.chance import SEED
from softgrip.simulator.steps import simulate_step_test, travel_to
from softgrip.units import DEG

ANGLES = tuple(range(10, 141, 10))
RIGS = {"Design 1": design_1, "Design 2": design_3}


@dataclass(frozen=True)
class SweepPoint:
    """Errors at one step; all RMS against the mean of seven runs, deg.

    Attributes:
        design: Chapter 5's name of the finger.
        angle: At which the median run ends, deg.
        linear, ludwick: Of the two models identified on the logs of the 60 deg test.
        linear_again, ludwick_again: Of models identified anew on this very step.
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


def sweep() -> Iterator[SweepPoint]:
    """Simulate the steps and hold the models against them; takes a minute."""
    for design, rig in RIGS.items():
        tests: list[StepTest] = []
        start = second_order(identified_at(design, "linear").finger, FORCE_PER_PRESSURE)
        for angle in ANGLES:
            plunger = travel_to(rig(), angle * DEG)
            tests.append(test := simulate_step_test(rig(), plunger, runs=7, seed=SEED))
            start, worst = one_for_all(tests, start)
            kept = [identified_at(design, kind) for kind in KINDS]
            errors = [
                *(rms_error(model.response(test.time, test.pressure), test) for model in kept),
                fit_test(test, 1.0).rms,
                fit_test(test, FINGERS[design].estimated).rms,
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
