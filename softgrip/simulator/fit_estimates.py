"""What a fit to logs says of each parameter: an interval, or that the logs cannot tell it.

The intervals are those of the problem made linear at the solution. What is left over is not white:
a model is never quite right, sensors lag, a converter rounds. So each channel of each log counts as
so many independent rows as the autocorrelation of its residuals leaves, with their real size.
"""

from dataclasses import dataclass
from functools import cached_property

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
        told: Whether the logs tell it: `is_told`.
    """

    name: str
    value: float
    low: float
    high: float
    told: bool


def is_told(width: float, parameter: Parameter) -> bool:
    """Return whether an interval tells a parameter, rather than its range alone.

    Its ends are less than `TOLD_WITHIN` apart, and it is less than half as wide as the range.

    Args:
        width: Of the logarithm.
        parameter: With its range.
    """
    return bool(width < min(np.log(TOLD_WITHIN), np.log(parameter.high / parameter.low) / 2))


@dataclass(frozen=True)
class Inferred:
    """What logs say of a rig.

    Attributes:
        problem: With the real noise.
        point: The solution.
        covariance: Of the logarithms of the free parameters, shape (parameters, parameters).
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
        found = self.problem.rig(self.problem.logarithms(self.point))
        trials = self.problem.trials
        noise = np.sqrt(np.maximum([one.noise**2 - one.rounding**2 for one in trials], 0.0))
        seen = np.array([one.believed.any(axis=1) for one in trials])
        pressure, angle = noise[:, 0][seen[:, 0]], noise[:, 1:][seen[:, 1:]]
        known = {"sensors.pressure_noise": pressure, "sensors.angle_noise": angle}
        return with_values(found, {k: float(np.median(v)) for k, v in known.items() if v.size})

    @property
    def values(self) -> Floats:
        """The free parameters, SI, shape (parameters,)."""
        return np.exp(self.problem.logarithms(self.point))

    @cached_property
    def estimates(self) -> tuple[Estimate, ...]:
        """What is said of each free parameter."""
        found = []
        for one, value, variance in zip(
            self.problem.space, self.values.tolist(), np.diag(self.covariance).tolist(), strict=True
        ):
            spread = float(np.exp(DEVIATIONS * variance**0.5))
            inside = min(max(value, one.low), one.high)
            low, high = max(value / spread, one.low), min(value * spread, one.high)
            found.append(Estimate(one.name, inside, low, high, is_told(2 * np.log(spread), one)))
        return tuple(found)
