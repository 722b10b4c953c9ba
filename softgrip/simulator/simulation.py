"""The simulated rig: a syringe pump, fingers and sensors, driven by a sampled command."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import ceil
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.dynamics.integrate import RungeKutta
from softgrip.errors import InvalidInputError
from softgrip.gripper.grasp import DiscBetweenFingers
from softgrip.pump.gas import GAS_CONSTANT
from softgrip.simulator import motor
from softgrip.simulator.chance import Chance
from softgrip.simulator.laws import AMOUNT, ANGLE, RATE, SENSED_ANGLE, SENSED_PRESSURE, Plant
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.rig_batch import check_runs, run_count, stacked
from softgrip.simulator.sensors import Measurement, measure
from softgrip.simulator.step_size import LARGEST_STEP, steps_for

Sample = TypeVar("Sample", Measurement, "Truth")


@dataclass(frozen=True)
class Truth:
    """What the sensors of a real rig would not tell.

    Attributes:
        time: s; a number, or shape (samples,) as the leading axis of all others.
        pressure, motor_speed: Pa gauge and rad/s, shape (runs,).
        plunger: Travel from where it is drawn out, m, shape (runs,).
        amount: Air in the rig, mol, shape (runs,).
        angle, rate: rad and rad/s, shape (fingers, runs).
        contact: States of what is touched, shape (states, runs).
    """

    time: float | Floats
    pressure: Floats
    motor_speed: Floats
    plunger: Floats
    amount: Floats
    angle: Floats
    rate: Floats
    contact: Floats


class Simulation:
    """A batch of runs of a rig, from rest at atmospheric pressure.

    Args:
        parameters: Of the rig; `calibration.design_1` and `gripper_parameters.printed_gripper` give
            the calibrated ones. Of all runs, or one for each; they must have as many fingers and
            branches of memory.
        runs: Number of runs; None for as many as the parameters are of.
        seed: Of all chance.
        first: Number of the first run: run i of a batch is run 0 of ``Simulation(..., first=i)``.
        cycle: Runs after which these numbers begin again; None for never. Rigs that are repeated as
            often each, one after the other, then meet the same chance.
        period: Sampling period, s; commands are held over it.
        plunger: Travel of the plunger at the start, m, a number or shape (runs,).
        contact: What the fingers touch; None for nothing.
        step: Largest step of the integration, s, as for a stiff contact; None for `steps_for`.

    Raises:
        InvalidInputError: If a value is out of range.

    >>> from softgrip.simulator.fitted_rigs import printed_gripper
    >>> rig = Simulation(printed_gripper(), runs=3)
    >>> rig.advance(5.0).angle.shape
    (2, 3)
    """

    def __init__(
        self,
        parameters: RigParameters | Sequence[RigParameters],
        *,
        runs: int | None = None,
        seed: int = 0,
        first: int = 0,
        cycle: int | None = None,
        period: float = PERIOD,
        plunger: ArrayLike = 0.0,
        contact: DiscBetweenFingers | None = None,
        step: float | None = None,
    ) -> None:
        if isinstance(parameters, RigParameters):
            rig, known = parameters, run_count(parameters)
        else:
            rig, known = stacked(parameters), len(parameters)
            if runs not in (None, known):
                raise InvalidInputError("runs", expected=f"{known}, one a rig", got=runs)
        runs = known if runs is None else runs
        if runs < 1 or seed < 0 or first < 0:
            raise InvalidInputError(
                "runs, seed, first", expected=">= 1, >= 0, >= 0", got=(runs, seed, first)
            )
        if not (0 < period < 10 and 0 < (step or LARGEST_STEP) <= LARGEST_STEP):
            raise InvalidInputError(
                "period, step", expected=f"0 to 10 s, 0 to {LARGEST_STEP} s", got=(period, step)
            )
        check_runs(rig, runs)
        pump, gas = rig.pump, rig.gas
        place = np.array(np.broadcast_to(np.asarray(plunger, dtype=np.float64), (runs,)))
        if not ((place >= 0) & (place <= pump.stroke)).all():
            raise InvalidInputError(
                "plunger", expected=f"0 to {np.min(pump.stroke):g} m", got=plunger
            )
        self.parameters, self.runs, self.period = rig, runs, period
        count = len(rig.fingers)
        self.chance = Chance(
            rig.spread, fingers=count, seed=seed, first=first, runs=runs, cycle=cycle
        )
        self.plant = Plant(rig, self.chance, contact)
        # The screw stands where it has drawn the plunger to.
        self._plunger, self._screw = place, place
        self._speed, self._samples = np.zeros(runs), 0
        self._state = np.zeros((self.plant.states, runs))
        # Stages of a step fall on its ends and its middle.
        self.steps = ceil(period / step - 1e-9) if step else int(steps_for(rig, period).max())
        self._half = period / (2 * self.steps)
        self._elapsed: Floats = np.arange(2.0 * self.steps + 1)[:, None] * self._half
        self._syringe = np.empty((self._elapsed.size, runs))
        self._syringe[:] = pump.syringe_volume - pump.area * place
        self._state[AMOUNT] = gas.atmosphere * (self._syringe[-1] + self.plant.rest)
        self._method = RungeKutta(self._slopes, self._state.shape)

    def _slopes(self, time: float, state: Floats, slope: Floats) -> None:
        self.plant.slopes(state, slope, self._syringe[round(time / self._half)])

    @property
    def time(self) -> float:
        """Time of the last sample, s."""
        return self._samples * self.period

    @property
    def truth(self) -> Truth:
        """The true state now; for tests and figures, not for controllers."""
        return self._true(self.time, self._state, self._speed, self._plunger)

    def _true(self, time: float | Floats, state: Floats, speed: Floats, plunger: Floats) -> Truth:
        own, amount, pump = self.plant.fingers(state), state[AMOUNT], self.parameters.pump
        syringe = pump.syringe_volume - pump.area * plunger
        return Truth(
            time,
            self.plant.gauge_pressure(amount, own[ANGLE], syringe),
            speed.copy(),
            plunger.copy(),
            amount / (GAS_CONSTANT * self.parameters.gas.temperature),
            own[ANGLE].copy(),
            own[RATE].copy(),
            state[self.plant.end :].copy(),
        )

    def push(self, torque: ArrayLike) -> None:
        """Push on the fingers from now on.

        Args:
            torque: N m, positive bends a finger further; broadcasts to shape (fingers, runs).
        """
        values = np.broadcast_to(np.asarray(torque, np.float64), self.plant.push.shape)
        if not np.isfinite(values).all():
            raise InvalidInputError("torque", expected="finite numbers, N m", got=torque)
        self.plant.push = values.copy()

    @property
    def felt(self) -> tuple[Floats, Floats]:
        """What the sensors feel now, without noise, range or converter: Pa and rad.

        Shapes (runs,) and (fingers, runs).
        """
        own = self.plant.fingers(self._state)[SENSED_ANGLE]
        return self._state[SENSED_PRESSURE].copy(), own.copy()

    def measure(self) -> Measurement:
        """Read the sensors now, each time with other noise."""
        return self._sensed(self.time, self._state, self.chance.noise())

    def _sensed(self, time: float | Floats, state: Floats, noise: Floats) -> Measurement:
        angle = self.plant.fingers(state)[SENSED_ANGLE]
        return measure(time, state[SENSED_PRESSURE], angle, noise, self.parameters.sensors)

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period and give the measurement at its end.

        Args:
            command: rad/s, positive into the syringe, a number or shape (runs,); the motor follows
                within its limits.
        """
        self.hold(command)
        return self.measure()

    def hold(self, command: ArrayLike) -> None:
        """Hold a motor speed for one period, as `advance`, and read no sensor."""
        values = np.broadcast_to(np.asarray(command, dtype=np.float64), (self.runs,))
        if not np.isfinite(values).all():
            raise InvalidInputError("command", expected="finite motor speeds, rad/s", got=command)
        pump = self.parameters.pump
        end = pump.stroke + pump.backlash
        screw = motor.travel(self._speed, values, self._elapsed, pump)
        screw += self._screw
        np.maximum(screw, 0.0, out=screw)
        np.minimum(screw, end, out=screw)
        places = screw
        if np.any(pump.backlash):
            turned = np.minimum(self._elapsed, motor.turning_time(self._speed, values, pump))
            peak = self._screw + motor.travel(self._speed, values, turned, pump)
            behind = motor.follow(self._plunger, np.clip(peak, 0.0, end), pump.backlash)
            places = motor.follow(behind, screw, pump.backlash)
        self._screw, self._plunger = screw[-1], places[-1]
        np.multiply(places, -pump.area, out=self._syringe)
        self._syringe += pump.syringe_volume
        self._method.advance(0.0, self._state, 2 * self._half, self.steps)
        speed = motor.speed(self._speed, values, self._elapsed[-1], pump)
        # A motor that has run its plunger against an end stands still.
        stopped = ((screw[-1] <= 0) & (speed < 0)) | ((screw[-1] >= end) & (speed > 0))
        self._speed = np.where(stopped, 0.0, speed)
        self._samples += 1

    def open_loop(self, commands: ArrayLike) -> tuple[Measurement, Truth]:
        """Run a whole sequence of commands, one a period.

        Args:
            commands: Motor speeds, rad/s, shape (samples,) for all runs or (samples, runs).

        Returns:
            Measurement, Truth: With a leading axis of samples; sample k is taken at the end of
                command k.
        """
        sequence = np.asarray(commands, dtype=np.float64)
        if sequence.ndim not in (1, 2) or sequence.shape[0] == 0:
            raise InvalidInputError(
                "commands", expected="shape (samples,) or (samples, runs)", got=sequence.shape
            )
        count = len(sequence)
        times: Floats = (self._samples + 1 + np.arange(float(count))) * self.period
        state = np.empty((self.plant.states, count, self.runs))
        noise = np.empty((1 + len(self.parameters.fingers), count, self.runs))
        motor_state = np.empty((2, count, self.runs))
        for k, command in enumerate(sequence):
            self.hold(command)
            state[:, k], noise[:, k] = self._state, self.chance.noise()
            motor_state[:, k] = self._speed, self._plunger
        # One call for all samples: one for each would double their cost.
        seen, true = self._sensed(times, state, noise), self._true(times, state, *motor_state)
        return _by_sample(seen), _by_sample(true)


def _by_sample(found: Sample) -> Sample:
    """Return values of shape (..., samples, runs) as (samples, ..., runs)."""
    arrays = [getattr(found, field.name) for field in fields(found)[1:]]
    return type(found)(found.time, *(np.moveaxis(each, -2, 0) for each in arrays))


def together(seen: list[Sample]) -> Sample:
    """Join measurements or truths along a leading axis of samples."""
    names = [field.name for field in fields(seen[0])]
    return type(seen[0])(*(np.array([getattr(one, name) for one in seen]) for name in names))


def sample(found: Sample, k: int) -> Sample:
    """Return one of the samples of a measurement or a truth with a leading axis of samples."""
    return type(found)(*(getattr(found, field.name)[k] for field in fields(found)))
