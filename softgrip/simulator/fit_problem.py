"""A rig's fit to logs as one least-squares problem: what is sought, what is left over, its slopes.

The logs' own commands are put through the rig, and what its sensors feel is compared with what was
measured. Sought are the free parameters on their scales, and what each log has of its own: its
run (finger and leak differ from run to run by the rig's spread), the pressure at which it began,
the zeros of its sensors. Each of these has a normal law of its own, so that the answer is finite
whatever the logs tell: a declared range is the 90 % interval of what is known without logs, and
what logs do not tell stays near the middle of its range.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.simulator.each_rig import felt
from softgrip.simulator.free_parameters import Parameter, free_parameters, with_values
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.trial import Trial
from softgrip.units import DEG

DEVIATIONS = 1.6449
"""Half width of the 90 % interval of a normal law, in its standard deviations."""
START, ZERO = 1500.0, (1000.0, 5 * DEG)
"""Standard deviations, known without logs: of the pressure at the start, Pa (homing draws a little
air thin), and of the zeros of pressure sensor and flex sensors, Pa and rad (one or two counts; a
finger that is not quite straight)."""
HANGING = 10.0
"""For how long a weight has hung on a finger when its log begins, s."""
DIFFERENCE = 1e-4
"""Step of the slopes, in standard deviations of a range."""


@dataclass(frozen=True)
class Problem:
    """What is sought, in numbers of which each has a standard normal law if there are no logs.

    A point holds those of the free parameters, then those of each log: what its run has of
    stiffness and damping of each finger and of the leak, its start, its zeros.

    Attributes:
        base: What is not free, and the spread from run to run.
        trials: The logs, with as many fingers as the rig.
        noise: Of each log, as its `Trial.noise`, but with the real size of the residuals.
    """

    base: RigParameters
    trials: tuple[Trial, ...]
    noise: tuple[Floats, ...]

    @cached_property
    def space(self) -> tuple[Parameter, ...]:
        """What is free."""
        return free_parameters(len(self.base.fingers))

    @cached_property
    def logarithmic(self) -> NDArray[np.bool_]:
        """Which parameters are sought by their logarithms, shape (parameters,)."""
        return np.array([one.scale == "log" for one in self.space])

    @cached_property
    def middle(self) -> Floats:
        """Middles of the ranges on their scales, shape (parameters,)."""
        low, high = self.on_scale(self._ends)
        return np.asarray(low + high) / 2

    @cached_property
    def deviation(self) -> Floats:
        """Standard deviations on their scales that are known without logs, shape (parameters,)."""
        low, high = self.on_scale(self._ends)
        return np.asarray(high - low) / 2 / DEVIATIONS

    @cached_property
    def _ends(self) -> Floats:
        return np.array([(one.low, one.high) for one in self.space]).T

    def on_scale(self, values: Floats) -> Floats:
        """Return logarithms of the values where these are sought, shape (..., parameters)."""
        return np.asarray(np.log(values, out=np.array(values), where=self.logarithmic))

    def values(self, point: Floats) -> Floats:
        """Return the free parameters at a point, SI, shape (..., parameters)."""
        scaled = self.middle + self.deviation * point[..., : len(self.space)]
        return np.asarray(np.exp(scaled, out=scaled.copy(), where=self.logarithmic))

    def slopes_of_values(self, values: Floats) -> Floats:
        """Return the slopes of values by their places on the scales, shape (parameters,)."""
        return np.where(self.logarithmic, values, 1.0)

    @cached_property
    def own(self) -> Floats:
        """What the numbers of a run add to the logarithms, shape (parameters, 2 fingers + 1)."""
        spread, names = self.base.spread, [one.name for one in self.space]
        columns = [
            (name, value)
            for entry, value in (("stiffness", spread.stiffness), ("damping", spread.damping))
            for name in names
            if name.endswith(f".{entry}")
        ]
        found = np.zeros((len(names), len(columns) + 1))
        for k, (name, value) in enumerate([*columns, ("gas.leakage", spread.leakage)]):
            found[names.index(name), k] = value
        return found

    @property
    def locals(self) -> int:
        """How many numbers a log has of its own."""
        return int(self.own.shape[1]) + 2 + len(self.base.fingers)

    @property
    def size(self) -> int:
        """Length of a point."""
        return len(self.space) + len(self.trials) * self.locals

    def rig(self, values: Floats) -> RigParameters:
        """Return the rig with these free parameters."""
        names = (one.name for one in self.space)
        return with_values(self.base, dict(zip(names, values.tolist(), strict=True)))

    def split(self, point: Floats, trial: int) -> tuple[Floats, float, Floats]:
        """Return what a log's run has: its factors of the values, its start, its zeros.

        Factors of shape (parameters,), the start in Pa, the zeros in Pa and rad, (1 + fingers,).
        """
        first = len(self.space) + trial * self.locals
        runs = self.own.shape[1]
        local = point[first : first + self.locals]
        factors = np.exp(self.own @ local[:runs])
        return factors, START * float(local[runs]), self.zeros * local[runs + 1 :]

    @cached_property
    def zeros(self) -> Floats:
        """Standard deviations of the sensors' zeros, shape (1 + fingers,)."""
        return np.array([ZERO[0], *[ZERO[1]] * len(self.base.fingers)])

    def linear(self, point: Floats) -> tuple[Floats, Floats]:
        """Return what is left over at a point, and its slopes by the point's numbers.

        First come the believed residuals of each log, in their standard deviations, then the point
        itself. To a batch of runs the slopes cost little more than the residuals alone.
        """
        logs = [self.linear_trial(point, k) for k in range(len(self.trials))]
        rows, count = sum(len(residuals) for residuals, _ in logs), len(self.space)
        slopes = np.zeros((rows + self.size, self.size))
        row = 0
        for k, (_, own) in enumerate(logs):
            some = slice(row, row := row + len(own))
            first = count + k * self.locals
            slopes[some, :count] = own[:, :count]
            slopes[some, first : first + self.locals] = own[:, count:]
        slopes[rows:] = np.eye(self.size)
        return np.concatenate([*(residuals for residuals, _ in logs), point]), slopes

    def linear_trial(self, point: Floats, k: int) -> tuple[Floats, Floats]:
        """Return a log's residuals, shape (believed,), and slopes, (believed, parameters + locals).

        By the free parameters, then by what is the log's own.
        """
        trial, noise = self.trials[k], self.noise[k]
        factors, start, zeros = self.split(point, k)
        values = self.values(point)
        run, count = values * factors, len(values)
        # Each rig but the last is moved in one of the values or in its start.
        steps = np.append(DIFFERENCE * self.deviation * self.slopes_of_values(run), 1.0)
        moved = np.diag(steps)[:, : count + 1]
        moved = np.vstack([moved, np.zeros(count + 1)])
        found = self.predict(trial, run + moved[:, :count], start + moved[:, count])
        residuals = (found[..., -1] + zeros[:, None] - trial.measured) / noise[:, None]
        slopes = (found[..., :-1] - found[..., -1:]) / steps / noise[:, None, None]
        by_run, by_start = slopes[..., :count], slopes[..., count:] * START
        free = by_run * (factors * self.slopes_of_values(values) * self.deviation)
        by_zero = np.diag(self.zeros / noise)[:, None]
        by_zero = np.broadcast_to(by_zero, (*trial.measured.shape, len(noise)))
        columns = (free, by_run @ (run[:, None] * self.own), by_start, by_zero)
        believed = trial.believed
        return residuals[believed], np.concatenate(columns, axis=-1)[believed]

    def predict(self, trial: Trial, values: Floats, start: Floats) -> Floats:
        """Return what the sensors of several rigs feel at the rows of a log.

        Args:
            trial: The log.
            values: The free parameters, SI, shape (rigs, parameters).
            start: Gauge pressure at the start, Pa, shape (rigs,).

        Returns:
            ndarray: Pressure and angles, shape (1 + fingers, rows, rigs).
        """
        rigs = [self.rig(row) for row in values]
        # Air that begins at another pressure is as air that begins in another atmosphere, with a
        # torque that makes up for it. Only the leak is a little off.
        gains = np.array([[one.torque_per_pressure for one in rig.fingers] for rig in rigs])
        rigs = [_begun_at(rig, p) for rig, p in zip(rigs, start.tolist(), strict=True)]
        if trial.clamped:
            rigs = [_clamped(rig) for rig in rigs]
        # A weight has hung on the finger since before the log began.
        still = round(HANGING / trial.period) if trial.torque else 0
        pressure, angle = felt(
            rigs,
            np.concatenate([np.zeros(still), trial.commands]),
            period=trial.period,
            plunger=trial.plunger,
            torque=gains.T * start + trial.torque,
        )
        even = np.concatenate([(pressure + start)[:, None], angle], axis=1)[still:]
        before = np.minimum(trial.at.astype(int), len(even) - 2)
        share = (trial.at - before)[:, None, None]
        rows = (1 - share) * even[before] + share * even[before + 1]
        return np.asarray(np.moveaxis(rows, 1, 0))


def _begun_at(rig: RigParameters, pressure: float) -> RigParameters:
    return replace(rig, gas=replace(rig.gas, atmosphere=rig.gas.atmosphere + pressure))


def _clamped(rig: RigParameters) -> RigParameters:
    """Return a rig whose fingers get no air: none in them, none that they take."""
    shut = [
        replace(one, torque_per_pressure=0.0, rest_volume=1e-12, ballooning=0.0)
        for one in rig.fingers
    ]
    return replace(rig, fingers=tuple(shut))
