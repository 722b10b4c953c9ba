"""What a fit to logs says of each parameter: an interval, or that the logs cannot tell it.

The intervals are those of the problem made linear at the solution. What is left over is not white:
a model is never quite right, sensors lag, a converter rounds. So each channel of each log counts as
so many independent rows as the autocorrelation of its residuals leaves, with their real size.
"""

from dataclasses import dataclass
from functools import cached_property
from math import exp

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.fit_problem import DEVIATIONS, Problem
from softgrip.simulator.free_parameters import Parameter, with_values
from softgrip.simulator.parameters import RigParameters

TOLD_WITHIN = 3.0
"""High over low end of an interval, above which a parameter is not told."""


@dataclass(frozen=True)
class Estimate:
    """What logs say of one parameter, or of one combination of parameters.

    Attributes:
        name: Of it.
        value: SI.
        low, high: Ends of its interval of `LEVEL`, within the declared range.
        told: Whether the logs tell it, rather than its range: the ends are less than `TOLD_WITHIN`
            apart, and less than half the range.
    """

    name: str
    value: float
    low: float
    high: float
    told: bool


def estimate(parameter: Parameter, value: float, deviation: float) -> Estimate:
    """Return what is said of a parameter.

    Args:
        parameter: Which.
        value: SI.
        deviation: Its standard deviation on its scale.
    """
    half, logarithmic = DEVIATIONS * deviation, parameter.scale == "log"
    factor = exp(half)
    ends = (value / factor, value * factor) if logarithmic else (value - half, value + half)
    told = ends[1] < TOLD_WITHIN * ends[0] and parameter.share(*ends) < 0.5
    low, high = max(ends[0], parameter.low), min(ends[1], parameter.high)
    return Estimate(parameter.name, min(max(value, low), high), low, high, told)


@dataclass(frozen=True)
class Inferred:
    """What logs say of a rig.

    Attributes:
        problem: With the real noise.
        point: The solution.
        covariance: Of the free parameters on their scales, shape (parameters, parameters).
        misfit: Root mean square of the residuals of each log over the noise from row to row, shape
            (1 + fingers,) each, NaN for a channel that is not believed. 1 if the model is right.
        alike: To how many rows one independent row comes, same shapes; 1 if residuals are white.
    """

    problem: Problem
    point: Floats
    covariance: Floats
    misfit: tuple[Floats, ...]
    alike: tuple[Floats, ...]

    @property
    def rig(self) -> RigParameters:
        """The rig, with the noise that the logs have."""
        found = self.problem.rig(self.values)
        trials = self.problem.trials
        noise = np.sqrt(np.maximum([one.noise**2 - one.rounding**2 for one in trials], 0.0))
        seen = np.array([one.believed.any(axis=1) for one in trials])
        pressure, angle = noise[:, 0][seen[:, 0]], noise[:, 1:][seen[:, 1:]]
        known = {"sensors.pressure_noise": pressure, "sensors.angle_noise": angle}
        return with_values(found, {k: float(np.median(v)) for k, v in known.items() if v.size})

    @property
    def values(self) -> Floats:
        """The free parameters, SI, shape (parameters,)."""
        return self.problem.values(self.point)

    @cached_property
    def estimates(self) -> tuple[Estimate, ...]:
        """What is said of each free parameter."""
        rows = zip(self.problem.space, self.values, np.sqrt(np.diag(self.covariance)), strict=True)
        return tuple(estimate(one, float(value), float(width)) for one, value, width in rows)
