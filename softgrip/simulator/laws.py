"""The physics of the simulated rig: pressure, leakage, torque, and the slopes of all states.

The functions of numbers take arrays as well, and the kernel compiles them: they call NumPy alone.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from softgrip.arrays import Floats, Number
from softgrip.gripper.grasp import DiscBetweenFingers
from softgrip.pump.gas import charge_pressure
from softgrip.simulator.chance import Chance
from softgrip.simulator.parameters import FingerParameters, RigParameters

AMOUNT, SENSED_PRESSURE, FINGERS = range(3)
"""Rows of the state: n R T (J), Pa gauge, then the rows of the fingers, then those of a contact."""

ANGLE, RATE, SENSED_ANGLE, MEMORY = range(4)
"""What the fingers' rows hold, of all fingers each: rad, rad/s, rad, then N m for each branch of
memory."""


def leak(gauge: Number, leakage: Number, atmosphere: float) -> Number:
    """Return how fast n R T falls, W: laminar flow of an isothermal gas through a narrow gap.

    It goes with ``P**2 - P_atm**2``, which is ``p (p + 2 P_atm)`` in the gauge pressure p.

    Args:
        gauge: p, Pa.
        leakage: G, m^3/(s Pa), >= 0.
        atmosphere: P_atm, Pa.
    """
    return leakage / 2 * gauge * (gauge + 2 * atmosphere)


def settled_torque(angle: Number, finger: FingerParameters) -> Number:
    """Return ``K theta**n``, odd, N m: the torque that holds an angle for good."""
    return finger.stiffness * angle * np.abs(angle) ** (finger.fractional_power - 1)


def finger_volume(angle: Number, gauge: Number, finger: FingerParameters) -> Number:
    """Return the air in the finger, m^3, at an angle (rad) and a gauge pressure (Pa)."""
    return finger.rest_volume + finger.torque_per_pressure * angle + finger.ballooning * gauge


def driving_torque(
    gauge: Number, angle: Number, rate: Number, secant: Number, finger: Any
) -> Number:
    """Return what the air leaves after stiffness and damping, N m.

    Args:
        gauge: Pa.
        angle, rate: rad and rad/s.
        secant: Settled torque over angle, N m/rad.
        finger: Its `torque_per_pressure` and `damping`.
    """
    return finger.torque_per_pressure * gauge - secant * angle - finger.damping * rate


def friction_torque(rate: Number, friction: Number, slow: Number) -> Number:
    """Return the dry friction, N m, at a rate (rad/s), smoothed below the root of `slow`."""
    return friction * rate / np.sqrt(rate * rate + slow)


def memory_slope(held: Number, growth: Number, memory: Number, relaxation: Number) -> Number:
    """Return how fast the torque of a branch of memory grows, N m/s.

    Args:
        held: Its torque, N m.
        growth: How fast the settled torque grows, N m/s.
        memory: Part of that growth which it takes on.
        relaxation: Share of its own torque that it loses, 1/s.
    """
    return memory * growth - held * relaxation


class Plant:
    """The slopes of the states of fingers on one syringe, for a batch of runs.

    Args:
        parameters: Of the rig.
        chance: What each run has of stiffness, damping and leak.
        contact: What the fingers touch; None for nothing.

    Attributes:
        push: Torque from outside, N m, positive bends a finger further, shape (fingers, runs).
        states: Number of rows of the state.
    """

    def __init__(
        self, parameters: RigParameters, chance: Chance, contact: DiscBetweenFingers | None = None
    ) -> None:
        self.parameters, self.contact = parameters, contact
        self.stiffness = self._column("stiffness") * chance.stiffness
        self.damping = self._column("damping") * chance.damping
        self.leakage = parameters.gas.leakage * chance.leakage
        self.power, self.inertia = self._column("fractional_power"), self._column("inertia")
        self.friction, self.slow = self._column("friction"), self._column("friction_rate") ** 2
        fingers = parameters.fingers
        self.torque_per_pressure = _rows([finger.torque_per_pressure for finger in fingers])
        self.memory = _branches([finger.memory for finger in fingers])
        self.relaxation = 1 / _branches([finger.memory_time for finger in fingers])
        self.ballooning = sum(finger.ballooning for finger in fingers)
        self.rest = sum(finger.rest_volume for finger in fingers) + parameters.gas.dead_volume
        self.push: Floats = np.zeros(chance.stiffness.shape)
        self.rows = MEMORY + len(self.memory)
        self.end = FINGERS + self.rows * len(fingers)
        self.states = self.end + (contact.states if contact else 0)

    def _column(self, name: str) -> Number:
        """Return a parameter of each finger as `_rows` does; a number if all are alike."""
        values = _rows([getattr(finger, name) for finger in self.parameters.fingers])
        # NumPy is faster with numbers.
        return float(values[0, 0]) if (values == values[0, 0]).all() else values

    def fingers(self, state: Floats) -> Floats:
        """Return a view of the fingers' part of a state, shape (rows, fingers, ..., runs)."""
        return state[FINGERS : self.end].reshape(self.rows, -1, *state.shape[1:])

    def gauge_pressure(self, amount: Floats, angle: Floats, syringe_volume: Floats) -> Floats:
        """Return the pressure above the atmosphere, Pa, shape (..., runs).

        Args:
            amount: n R T, J, shape (..., runs).
            angle: rad, shape (fingers, ..., runs).
            syringe_volume: Air in the syringe, m^3, shape (..., runs).
        """
        swept = [own * one for own, one in zip(self.torque_per_pressure, angle, strict=True)]
        volume: Floats = sum(swept[1:], swept[0])
        volume += syringe_volume
        volume += self.rest
        atmosphere = self.parameters.gas.atmosphere
        pressure: Floats = charge_pressure(amount, volume, self.ballooning, atmosphere)
        pressure -= atmosphere
        return pressure

    def slopes(self, state: Floats, slope: Floats, syringe_volume: Floats) -> None:
        """Write the slope of each state, shape (states, runs)."""
        gas, sensors = self.parameters.gas, self.parameters.sensors
        own, rates = self.fingers(state), self.fingers(slope)
        angle, rate = own[ANGLE], own[RATE]
        gauge = self.gauge_pressure(state[AMOUNT], angle, syringe_volume)
        np.negative(leak(gauge, self.leakage, gas.atmosphere), out=slope[AMOUNT])
        np.subtract(gauge, state[SENSED_PRESSURE], out=slope[SENSED_PRESSURE])
        slope[SENSED_PRESSURE] /= sensors.pressure_lag
        secant = np.abs(angle) ** (self.power - 1)
        secant *= self.stiffness
        held = own[MEMORY:]
        growth = secant * rate * self.power
        rates[MEMORY:] = memory_slope(held, growth, self.memory, self.relaxation)
        torque = driving_torque(gauge, angle, rate, secant, self)
        for branch in held:
            torque -= branch
        torque -= friction_torque(rate, self.friction, self.slow)
        torque += self.push
        if self.contact:
            torque += self.contact.slopes(angle, state[self.end :], slope[self.end :])
        rates[ANGLE] = rate
        np.divide(torque, self.inertia, out=rates[RATE])
        np.subtract(angle, own[SENSED_ANGLE], out=rates[SENSED_ANGLE])
        rates[SENSED_ANGLE] /= sensors.angle_lag


def _rows(values: Sequence[Number]) -> Floats:
    """Return a parameter of some, shape (some, 1), or (some, runs) if the runs differ in it."""
    return np.array(np.broadcast_arrays(*map(np.atleast_1d, values)), dtype=np.float64)


def _branches(values: Sequence[tuple[Number, ...]]) -> Floats:
    """Return a parameter of each finger's branches, shape (branches, fingers, 1 or runs)."""
    shape = len(values[0]), len(values)
    of_all = [finger[branch] for branch in range(shape[0]) for finger in values]
    return _rows(of_all).reshape(*shape, -1) if of_all else np.empty((*shape, 1))
