"""The physics of several fingers on one syringe: as `simulator.laws`, for one volume of gas."""

from typing import Protocol

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.laws import Value, absolute_pressure, leak
from softgrip.simulator.parameters import GripperParameters

AMOUNT, SENSED_PRESSURE, FINGERS = range(3)
"""Rows of the state: n R T (J), Pa gauge, then the rows of each finger, then those of a contact."""

ANGLE, RATE, SENSED_ANGLE, MEMORY = range(4)
"""Rows of a finger: rad, rad/s, rad, then N m for each branch of memory."""


class Contact(Protocol):
    """What the fingers touch; see `softgrip.gripper.grasp`."""

    @property
    def states(self) -> int:
        """Number of states of its own; they start at zero."""
        ...

    def slopes(self, angle: Floats, own: Floats, slope: Floats) -> Floats:
        """Write the slopes of its states, shape (states, runs), and return the torque on the
        fingers at their angles, N m and rad, both of shape (fingers, runs).
        """  # noqa: D205
        ...


class GripperPlant:
    """The slopes of a gripper's states for a batch of runs.

    Parameters
    ----------
    parameters
        Of the gripper.
    stiffness, damping
        What each finger has of these in each run, as multiples, shape (fingers, runs).
    leakage
        The same of the leak, shape (runs,).
    contact
        What the fingers touch; None for nothing.

    Attributes
    ----------
    push
        Torque from outside, N m, positive bends a finger further, shape (fingers, runs).
    """

    def __init__(
        self,
        parameters: GripperParameters,
        stiffness: Floats,
        damping: Floats,
        leakage: Floats,
        contact: Contact | None = None,
    ) -> None:
        self.parameters, self.contact = parameters, contact
        self.stiffness = self._column("stiffness") * stiffness
        self.damping = self._column("damping") * damping
        self.leakage = parameters.gas.leakage * leakage
        self.power, self.inertia = self._column("fractional_power"), self._column("inertia")
        self.torque_per_pressure = self._column("torque_per_pressure")
        self.friction, self.friction_rate = self._column("friction"), self._column("friction_rate")
        self.memory = self._column("memory")[..., 0][..., None]
        self.relaxation = 1 / self._column("memory_time")[..., 0][..., None]
        self.ballooning = float(self._column("ballooning").sum())
        self.rest = parameters.gas.dead_volume + float(self._column("rest_volume").sum())
        self.push: Floats = np.zeros(stiffness.shape)
        self.rows = MEMORY + self.memory.shape[1]
        self.end = FINGERS + len(parameters.fingers) * self.rows
        self.states = self.end + (contact.states if contact else 0)

    def _column(self, name: str) -> Floats:
        values = np.array([getattr(finger, name) for finger in self.parameters.fingers])
        return values.astype(np.float64)[..., None]

    def fingers(self, state: Floats) -> Floats:
        """Return a view of the fingers' part of a state, shape (fingers, rows, runs)."""
        return state[FINGERS : self.end].reshape(-1, self.rows, state.shape[-1])

    def gauge_pressure(self, amount: Value, angle: Value, syringe_volume: Value) -> Value:
        """Return the pressure above the atmosphere, Pa, shape (..., runs).

        Parameters
        ----------
        amount
            n R T, J, shape (..., runs).
        angle
            rad, shape (..., fingers, runs).
        syringe_volume
            Air in the syringe, m^3, shape (..., runs).
        """
        swept = (self.torque_per_pressure * angle).sum(axis=-2)
        atmosphere = self.parameters.gas.atmosphere
        volume = syringe_volume + self.rest + swept
        return absolute_pressure(amount, volume, self.ballooning, atmosphere) - atmosphere

    def slopes(self, state: Floats, slope: Floats, syringe_volume: Floats) -> None:
        """Write the slope of each state, shape (states, runs)."""
        gas, sensors = self.parameters.gas, self.parameters.sensors
        own, rates = self.fingers(state), self.fingers(slope)
        angle, rate = own[:, ANGLE], own[:, RATE]
        gauge = self.gauge_pressure(state[AMOUNT], angle, syringe_volume)
        slope[AMOUNT] = -leak(gauge, self.leakage, gas.atmosphere)
        slope[SENSED_PRESSURE] = (gauge - state[SENSED_PRESSURE]) / sensors.pressure_lag
        secant = self.stiffness * np.abs(angle) ** (self.power - 1)
        loaded = own[:, MEMORY:]
        stretch = (secant * rate * self.power)[:, None]
        rates[:, MEMORY:] = self.memory * stretch - loaded * self.relaxation
        torque = self.torque_per_pressure * gauge - secant * angle - self.damping * rate
        torque -= loaded.sum(axis=1)
        torque -= self.friction * rate / np.hypot(rate, self.friction_rate)
        torque += self.push
        if self.contact:
            torque += self.contact.slopes(angle, state[self.end :], slope[self.end :])
        rates[:, ANGLE], rates[:, RATE] = rate, torque / self.inertia
        rates[:, SENSED_ANGLE] = (angle - own[:, SENSED_ANGLE]) / sensors.angle_lag
