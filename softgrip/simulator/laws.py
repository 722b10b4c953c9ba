"""The physics of the simulated rig: pressure, leakage, torque, and the slopes of all states."""

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
        pushes = [finger.torque_per_pressure for finger in fingers]
        self.torque_per_pressure = np.array(pushes)[:, None]
        self.memory = np.array([finger.memory for finger in fingers]).T[..., None]
        self.relaxation = 1 / np.array([finger.memory_time for finger in fingers]).T[..., None]
        self.ballooning = sum(finger.ballooning for finger in fingers)
        self.rest = sum(finger.rest_volume for finger in fingers) + parameters.gas.dead_volume
        self.push: Floats = np.zeros(chance.stiffness.shape)
        self.rows = MEMORY + len(self.memory)
        self.end = FINGERS + self.rows * len(fingers)
        self.states = self.end + (contact.states if contact else 0)

    def _column(self, name: str) -> Number:
        """Return a parameter of each finger, shape (fingers, 1); a number if all are alike."""
        values = [float(getattr(finger, name)) for finger in self.parameters.fingers]
        # NumPy is faster with numbers.
        return values[0] if len(set(values)) == 1 else np.array(values)[:, None]

    def fingers(self, state: Floats) -> Floats:
        """Return a view of the fingers' part of a state, shape (rows, fingers, runs)."""
        return state[FINGERS : self.end].reshape(self.rows, -1, state.shape[-1])

    def gauge_pressure(self, amount: Floats, angle: Floats, syringe_volume: Floats) -> Floats:
        """Return the pressure above the atmosphere, Pa, shape (runs,).

        Args:
            amount: n R T, J, shape (runs,).
            angle: rad, shape (fingers, runs).
            syringe_volume: Air in the syringe, m^3, shape (runs,).
        """
        swept = self.torque_per_pressure * angle
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
        held, loaded = rates[MEMORY:], own[MEMORY:]
        np.multiply(self.memory, secant * rate * self.power, out=held)
        held -= loaded * self.relaxation
        torque = self.torque_per_pressure * gauge
        torque -= secant * angle
        torque -= self.damping * rate
        for branch in loaded:
            torque -= branch
        torque -= self.friction * rate / np.sqrt(rate * rate + self.slow)
        torque += self.push
        if self.contact:
            torque += self.contact.slopes(angle, state[self.end :], slope[self.end :])
        rates[ANGLE] = rate
        np.divide(torque, self.inertia, out=rates[RATE])
        np.subtract(angle, own[SENSED_ANGLE], out=rates[SENSED_ANGLE])
        rates[SENSED_ANGLE] /= sensors.angle_lag
