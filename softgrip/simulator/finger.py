"""The simulated rig: a syringe pump, a finger and two sensors, driven by a sampled command."""

from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.dynamics.integrate import RungeKutta
from softgrip.errors import InvalidInputError
from softgrip.simulator import motor
from softgrip.simulator.chance import CHANNELS, Chance
from softgrip.simulator.laws import (
    AMOUNT,
    ANGLE,
    MEMORY,
    RATE,
    SENSED_ANGLE,
    SENSED_PRESSURE,
    Plant,
)
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.sensors import Measurement, measure
from softgrip.simulator.truth import Truth, truth_of

LARGEST_STEP = 0.025
"""Of the integration, s. Under abrupt commands, against a step 16 times shorter, the error is below
2e-4 rad and 5 Pa: a tenth and a hundredth of a count of the converter. A test measures it."""


class SimulatedRig:
    """A batch of runs of the rig, from rest at atmospheric pressure.

    Parameters
    ----------
    parameters
        Of the rig; `calibration.design_1` gives the calibrated ones.
    runs
        Number of runs.
    seed
        Of all chance.
    first
        Number of the first run: run i of a batch is run 0 of ``SimulatedRig(..., first=i)``.
    period
        Sampling period, s; commands are held over it.
    plunger
        Travel of the plunger at the start, m, a number or shape (runs,).

    Raises
    ------
    InvalidInputError
        If a value is out of range.

    Examples
    --------
    >>> from softgrip.simulator.calibration import design_1
    >>> rig = SimulatedRig(design_1(), runs=2)
    >>> rig.advance(5.0, 1.0).angle.shape
    (2,)
    """

    def __init__(
        self,
        parameters: RigParameters,
        *,
        runs: int = 1,
        seed: int = 0,
        first: int = 0,
        period: float = 0.025,
        plunger: ArrayLike = 0.0,
    ) -> None:
        if runs < 1 or seed < 0 or first < 0:
            raise InvalidInputError(
                "runs, seed, first", expected=">= 1, >= 0, >= 0", got=(runs, seed, first)
            )
        if not 0 < period < 10:
            raise InvalidInputError("period", expected="0 to 10 s", got=period)
        place = np.array(np.broadcast_to(np.asarray(plunger, dtype=np.float64), (runs,)))
        if not ((place >= 0) & (place <= parameters.pump.stroke)).all():
            raise InvalidInputError(
                "plunger", expected=f"0 to {parameters.pump.stroke:g} m", got=plunger
            )
        self.parameters, self.runs, self.period = parameters, runs, period
        self._chance = Chance(parameters.spread, seed=seed, first=first, runs=runs)
        chance = self._chance
        self._plant = Plant(parameters, chance.stiffness, chance.damping, chance.leakage)
        self._plunger, self._speed = place, np.zeros(runs)
        self._samples = 0
        gas, pump, finger = parameters.gas, parameters.pump, parameters.finger
        self._state = np.zeros((MEMORY + len(finger.memory), runs))
        volume = pump.syringe_volume - pump.area * place + gas.dead_volume + finger.rest_volume
        self._state[AMOUNT] = gas.atmosphere * volume
        # Stages of a step fall on its ends and its middle.
        self._steps = ceil(period / LARGEST_STEP - 1e-9)
        self._half = period / (2 * self._steps)
        self._elapsed: Floats = np.arange(2.0 * self._steps + 1)[:, None] * self._half
        self._syringe = np.empty((self._elapsed.size, runs))
        self._method = RungeKutta(self._slopes, self._state.shape)

    def _slopes(self, time: float, state: Floats, slope: Floats) -> None:
        self._plant.slopes(state, slope, self._syringe[round(time / self._half)])

    @property
    def time(self) -> float:
        """Time of the last sample, s."""
        return self._samples * self.period

    @property
    def truth(self) -> Truth:
        """The true state now; for tests and figures, not for controllers."""
        state = self._state[AMOUNT], self._state[ANGLE], self._state[RATE]
        return truth_of(self.parameters, self.time, state, self._speed, self._plunger)

    def _step(self, command: Floats) -> None:
        """Hold a command for one period."""
        pump = self.parameters.pump
        places = motor.travel(self._speed, command, self._elapsed, pump)
        places += self._plunger
        np.maximum(places, 0.0, out=places)
        np.minimum(places, pump.stroke, out=places)
        np.multiply(places, -pump.area, out=self._syringe)
        self._syringe += pump.syringe_volume
        self._method.advance(0.0, self._state, 2 * self._half, self._steps)
        place = self._plunger = places[-1]
        speed = motor.speed(self._speed, command, self._elapsed[-1], pump)
        # A motor that has run its plunger against an end stands still.
        stopped = ((place <= 0) & (speed < 0)) | ((place >= pump.stroke) & (speed > 0))
        self._speed = np.where(stopped, 0.0, speed)
        self._samples += 1

    def _command(self, command: ArrayLike) -> Floats:
        values = np.asarray(command, dtype=np.float64)
        values = np.broadcast_to(values, (*values.shape[:-1], self.runs))
        if not np.isfinite(values).all():
            raise InvalidInputError("command", expected="finite motor speeds, rad/s", got=command)
        return values

    def advance(self, command: ArrayLike, duration: float | None = None) -> Measurement:
        """Hold a command and give the measurement at its end.

        Parameters
        ----------
        command
            Motor speed, rad/s, positive into the syringe, a number or shape (runs,). The motor
            follows within its limits.
        duration
            s, a whole number of periods, or 0 to measure only; None for one period.
        """
        count = 1 if duration is None else round(duration / self.period)
        if count < 0 or (duration is not None and abs(count * self.period - duration) > 1e-9):
            raise InvalidInputError(
                "duration", expected=f"a whole number of periods of {self.period} s", got=duration
            )
        values = self._command(command)
        for _ in range(count):
            self._step(values)
            noise = self._chance.noise()
        if count == 0:
            noise = self._chance.noise()
        sensed = self._state[SENSED_PRESSURE], self._state[SENSED_ANGLE]
        return measure(self.time, *sensed, noise, self.parameters.sensors)

    def open_loop(self, commands: ArrayLike) -> tuple[Measurement, Truth]:
        """Run a whole sequence of commands, one a period.

        Parameters
        ----------
        commands
            Motor speeds, rad/s, shape (samples,) for all runs or (samples, runs).

        Returns
        -------
        Measurement, Truth
            With a leading axis of samples; sample k is taken at the end of command k.
        """
        sequence = np.asarray(commands, dtype=np.float64)
        if sequence.ndim not in (1, 2) or sequence.shape[0] == 0:
            raise InvalidInputError(
                "commands", expected="shape (samples,) or (samples, runs)", got=sequence.shape
            )
        sequence = self._command(sequence if sequence.ndim == 2 else sequence[:, None])
        count = sequence.shape[0]
        times: Floats = (self._samples + 1 + np.arange(count, dtype=np.float64)) * self.period
        state = np.empty((MEMORY, count, self.runs))
        speed, place = np.empty((count, self.runs)), np.empty((count, self.runs))
        noise = np.empty((CHANNELS, count, self.runs))
        for k in range(count):
            self._step(sequence[k])
            state[:, k], speed[k], place[k] = self._state[:MEMORY], self._speed, self._plunger
            noise[:, k] = self._chance.noise()
        sensed = measure(
            times, state[SENSED_PRESSURE], state[SENSED_ANGLE], noise, self.parameters.sensors
        )
        own = state[AMOUNT], state[ANGLE], state[RATE]
        return sensed, truth_of(self.parameters, times, own, speed, place)
