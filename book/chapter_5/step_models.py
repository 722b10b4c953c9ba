"""The step tests of Section 5.4: linear and Ludwick model against the mean of seven runs.

The text does not say how its models got their numbers, nor what drove them. The way used for
Figures 5.6 and 5.7 is "identified at 60 deg": mass, damping and stiffness of either model are
fitted to the 60 deg test alone, Ludwick's with the estimated power of Table 5.2, and both then
answer the measured pressure of either test. The gain of the linear model is then matched to where
each test ends, as far as the fit to the printed errors says. `step_protocols` tries others.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.dynamics.ludwick_fit import FittedFinger, fit_finger
from softgrip.errors import UnknownNameError
from softgrip.logs.repeated_steps import StepTest, read_step_test
from softgrip.logs.steps import END
from softgrip.provenance import data_file
from softgrip.reads import remembered
from softgrip.units import DEG, MM, MPa

Kind = Literal["linear", "ludwick"]
KINDS: tuple[Kind, Kind] = ("linear", "ludwick")
ANGLES = (60, 90)
"""Set points of the two tests, deg."""
TORQUE_PER_PRESSURE = 0.359 / (0.25 * MPa)
"""N m/Pa, of Design 1 held straight: Figure 3.9."""
FORCE_PER_PRESSURE = TORQUE_PER_PRESSURE / (94 * MM)
"""F over P, N/Pa, of Figure 3.9 with ``T = F L`` of Eq. (3.24). It scales mass, damping and
stiffness alike, and no response."""


@dataclass(frozen=True)
class StepFinger:
    """A finger of Section 5.4.

    Attributes:
        material: As in Table 5.1.
        logs: What the names of its logs begin with.
        estimated, true: Fractional powers of Table 5.2.
    """

    material: str
    logs: str
    estimated: float
    true: float

    def paths(self, angle: int) -> tuple[str, ...]:
        """Return the names below ``data/`` of the seven logs of a test."""
        return tuple(f"simulated/{self.logs}-{angle}-{run}.csv" for run in range(1, 8))


FINGERS = {
    "Design 1": StepFinger("Dragon Skin 20", "step", 2.365, 2.174),
    "Design 2": StepFinger("Dragon Skin FX Pro", "step-fx", 1.727, 1.538),
}
"""The two fingers, by Chapter 5's names."""


def step_finger(design: str) -> StepFinger:
    """Find a finger; UnknownNameError if there is none."""
    if design not in FINGERS:
        raise UnknownNameError("finger of Chapter 5", design, list(FINGERS))
    return FINGERS[design]


@remembered
def kept_test(design: str, angle: int) -> StepTest:
    """Read the seven kept runs of a step to 60 or 90 deg."""
    return read_step_test([data_file(name).path for name in step_finger(design).paths(angle)])


def fit_test(test: StepTest, fractional_power: float | None) -> FittedFinger:
    """Fit a model to the mean of a test; a power of 1 makes it the linear one, None is fitted."""
    return fit_finger(
        test.time,
        test.pressure,
        test.angle,
        force_per_pressure=FORCE_PER_PRESSURE,
        fractional_power=fractional_power,
    )


@remembered
def identified_at(design: str, kind: Kind, angle: int = 60) -> FittedFinger:
    """Fit a model to the kept test at an angle, Ludwick's with the estimated power."""
    power = 1.0 if kind == "linear" else step_finger(design).estimated
    return fit_test(kept_test(design, angle), power)


def rms_error(model: Floats, test: StepTest) -> float:
    """Return the root mean square of model less mean of the runs, rad."""
    return float(np.sqrt(np.mean((model - test.angle) ** 2)))


def answer(kind: Kind, model: FittedFinger, test: StepTest) -> Floats:
    """Return what a model makes of a test, rad, shape (N,); the linear one with its gain matched.

    A share of 1 brings its end to that of the test, 0 leaves it as identified.
    """
    made: Floats = model.response(test.time, test.pressure)
    if kind != "linear":
        return made
    end = test.time >= test.time[-1] - END
    share = choice("linear_matched")
    return np.asarray(made * (test.angle[end].mean() / made[end].mean()) ** share)


@remembered
def step_test_error(design: str, kind: Kind, angle: int, *, identified: int = 60) -> float:
    """Return the RMS error, deg, of a model identified at one angle and held against another.

    >>> step_test_error("Design 1", "ludwick", 60) < step_test_error("Design 1", "linear", 60)
    True
    """
    test = kept_test(design, angle)
    fitted = identified_at(design, kind, identified)
    return rms_error(answer(kind, fitted, test), test) / DEG


def compare(
    design: str, logs: tuple[Sequence[Path | str], Sequence[Path | str]]
) -> tuple[tuple[StepTest, StepTest], dict[Kind, FittedFinger]]:
    """Read two tests of a finger and fit both models to the first.

    Args:
        design: A key of `FINGERS`, for the estimated power.
        logs: Paths of the runs of the first and of the second test.
    """
    tests = read_step_test(logs[0]), read_step_test(logs[1])
    power: dict[Kind, float] = {"linear": 1.0, "ludwick": step_finger(design).estimated}
    return tests, {kind: fit_test(tests[0], n) for kind, n in power.items()}
