"""The simulated gripper: fingers on one syringe pump, driven by a sampled command."""

from dataclasses import dataclass, fields
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.dynamics.integrate import RungeKutta
from softgrip.errors import InvalidInputError
from softgrip.gripper.internal_model import PERIOD
from softgrip.simulator import motor
from softgrip.simulator.chance import streams
from softgrip.simulator.finger import LARGEST_STEP
from softgrip.simulator.gripper_laws import (
    AMOUNT,
    ANGLE,
    RATE,
    SENSED_ANGLE,
    SENSED_PRESSURE,
    Contact,
    GripperPlant,
)
from softgrip.simulator.parameters import GripperParameters
from softgrip.simulator.sensors import Measurement, from_counts, to_counts


@dataclass(frozen=True)
class GripperTruth:
    """What the sensors of a real gripper would not tell.

    Attributes
    ----------
    time
        s; a number, or shape (samples,) as the leading axis of all others.
    pressure, motor_speed, plunger, amount
        Pa gauge, rad/s, m, and n R T in J, shape (runs,).
    angle, rate
        rad and rad/s, shape (fingers, runs).
    contact
        States of what is touched, shape (states, runs).
    """

    time: float | Floats
    pressure: Floats
    motor_speed: Floats
    plunger: Floats
    amount: Floats
    angle: Floats
    rate: Floats
    contact: Floats


class GripperRig:
    """A batch of runs of a gripper, from rest at atmospheric pressure.

    Parameters
    ----------
    parameters
        Of the gripper; `gripper_parameters.printed_gripper` gives the calibrated ones.
    runs, seed, first, period
        As of `SimulatedRig`: run i of a batch is run 0 of ``GripperRig(..., first=i)``.
    contact
        What the fingers touch; None for nothing.
    step
        Largest step of the integration, s; a stiff contact asks for a shorter one.

    Raises
    ------
    InvalidInputError
        If a value is out of range.

    Examples
    --------
    >>> from softgrip.simulator.gripper_parameters import printed_gripper
    >>> rig = GripperRig(printed_gripper(), runs=3)
    >>> rig.advance(5.0).angle.shape
    (2, 3)
    """

    def __init__(
        self,
        parameters: GripperParameters,
        *,
        runs: int = 1,
        seed: int = 0,
        first: int = 0,
        period: float = PERIOD,
        contact: Contact | None = None,
        step: float = LARGEST_STEP,
    ) -> None:
        if runs < 1 or seed < 0 or first < 0:
            raise InvalidInputError(
                "runs, seed, first", expected=">= 1, >= 0, >= 0", got=(runs, seed, first)
            )
        if not (0 < period < 10 and 0 < step <= LARGEST_STEP):
            raise InvalidInputError(
                "period, step", expected=f"0 to 10 s, 0 to {LARGEST_STEP} s", got=(period, step)
            )
        self.parameters, self.runs, self.period = parameters, runs, period
        count, spread = len(parameters.fingers), parameters.spread
        pairs = [streams(seed, first + run) for run in range(runs)]
        # Leak, then stiffness and damping of each finger: another finger leaves the others alone.
        drawn = np.array([own.standard_normal(1 + 2 * count) for own, _ in pairs]).T
        self._noise = [noise for _, noise in pairs]
        self._plant = GripperPlant(
            parameters,
            np.exp(spread.stiffness * drawn[1::2]),
            np.exp(spread.damping * drawn[2::2]),
            np.exp(spread.leakage * drawn[0]),
            contact,
        )
        self._plunger, self._speed, self._samples = np.zeros(runs), np.zeros(runs), 0
        self._state = np.zeros((self._plant.states, runs))
        syringe = parameters.pump.syringe_volume
        volume = syringe + self._plant.rest
        self._state[AMOUNT] = parameters.gas.atmosphere * volume
        # Stages of a step fall on its ends and its middle.
        self._steps = ceil(period / step - 1e-9)
        self._half = period / (2 * self._steps)
        self._elapsed: Floats = np.arange(2.0 * self._steps + 1)[:, None] * self._half
        self._syringe = np.full((self._elapsed.size, runs), syringe)
        self._method = RungeKutta(self._slopes, (self._plant.states, runs))

    def _slopes(self, time: float, state: Floats, slope: Floats) -> None:
        self._plant.slopes(state, slope, self._syringe[round(time / self._half)])

    @property
    def time(self) -> float:
        """Time of the last sample, s."""
        return self._samples * self.period

    @property
    def truth(self) -> GripperTruth:
        """The true state now; for tests and figures, not for controllers."""
        own, amount = self._plant.fingers(self._state), self._state[AMOUNT]
        pressure = self._plant.gauge_pressure(amount, own[:, ANGLE], self._syringe[-1])
        return GripperTruth(
            self.time,
            pressure,
            self._speed.copy(),
            self._plunger.copy(),
            amount.copy(),
            own[:, ANGLE].copy(),
            own[:, RATE].copy(),
            self._state[self._plant.end :].copy(),
        )

    def push(self, torque: ArrayLike) -> None:
        """Push on the fingers from now on.

        Parameters
        ----------
        torque
            N m, positive bends a finger further; broadcasts to shape (fingers, runs).
        """
        values = np.broadcast_to(np.asarray(torque, np.float64), self._plant.push.shape)
        if not np.isfinite(values).all():
            raise InvalidInputError("torque", expected="finite numbers, N m", got=torque)
        self._plant.push = values.copy()

    def measure(self) -> Measurement:
        """Read the sensors now: as of `SimulatedRig`, but angles of shape (fingers, runs)."""
        sensors, own = self.parameters.sensors, self._plant.fingers(self._state)
        noise = np.array([source.standard_normal(1 + len(own)) for source in self._noise]).T
        pressure = np.minimum(self._state[SENSED_PRESSURE], sensors.pressure_range)
        angle = np.minimum(own[:, SENSED_ANGLE], sensors.angle_range)
        pressure_counts = to_counts(
            pressure + sensors.pressure_noise * noise[0], sensors.pressure_range, sensors
        )
        angle_counts = to_counts(
            angle + sensors.angle_noise * noise[1:], sensors.angle_range, sensors
        )
        return Measurement(
            self.time,
            from_counts(pressure_counts, sensors.pressure_range, sensors),
            from_counts(angle_counts, sensors.angle_range, sensors),
            pressure_counts,
            angle_counts,
        )

    def advance(self, command: ArrayLike) -> Measurement:
        """Hold a motor speed for one period and give the measurement at its end.

        Parameters
        ----------
        command
            rad/s, positive into the syringe, a number or shape (runs,); the motor follows within
            its limits.
        """
        values = np.broadcast_to(np.asarray(command, dtype=np.float64), (self.runs,))
        if not np.isfinite(values).all():
            raise InvalidInputError("command", expected="finite motor speeds, rad/s", got=command)
        pump = self.parameters.pump
        places = self._plunger + motor.travel(self._speed, values, self._elapsed, pump)
        places = np.clip(places, 0.0, pump.stroke)
        self._syringe = pump.syringe_volume - pump.area * places
        self._method.advance(0.0, self._state, 2 * self._half, self._steps)
        place = self._plunger = places[-1]
        speed = motor.speed(self._speed, values, self._elapsed[-1], pump)
        # A motor that has run its plunger against an end stands still.
        stopped = ((place <= 0) & (speed < 0)) | ((place >= pump.stroke) & (speed > 0))
        self._speed = np.where(stopped, 0.0, speed)
        self._samples += 1
        return self.measure()


def together(seen: list[Measurement]) -> Measurement:
    """Join measurements along a leading axis of samples."""
    return Measurement(
        *(np.array([getattr(one, field.name) for one in seen]) for field in fields(Measurement))
    )


def truths_together(seen: list[GripperTruth]) -> GripperTruth:
    """Join truths along a leading axis of samples."""
    return GripperTruth(
        *(np.array([getattr(one, field.name) for one in seen]) for field in fields(GripperTruth))
    )
