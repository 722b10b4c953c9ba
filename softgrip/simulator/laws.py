"""The physics of the simulated rig: pressure, leakage, torque, and the slopes of all states."""

from typing import Any

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.parameters import FingerParameters, RigParameters

Value = Any
"""A float or an array: a law returns what it was given, and broadcasts."""

AMOUNT, ANGLE, RATE, SENSED_PRESSURE, SENSED_ANGLE, MEMORY = range(6)
"""Rows of the state: n R T (J), rad, rad/s, Pa gauge, rad, then N m for each branch of memory."""

GAS_CONSTANT = 8.314462618
"""J/(mol K)."""


def absolute_pressure(
    amount: Value, free_volume: Value, ballooning: float, atmosphere: float
) -> Value:
    """Return the pressure of an ideal gas in a vessel that balloons.

    It solves ``P (V + b (P - P_atm)) = n R T`` for P.

    Parameters
    ----------
    amount
        n R T, J, > 0: constant for a closed gas at one temperature.
    free_volume
        V, m^3, > 0: all volume but that due to ballooning.
    ballooning
        b, m^3/Pa, >= 0.
    atmosphere
        P_atm, Pa.

    Returns
    -------
    float or ndarray
        Pa, absolute.

    Examples
    --------
    >>> absolute_pressure(10.0, 1e-4, 0.0, 101325.0)
    100000.0
    """
    linear = free_volume - ballooning * atmosphere
    # This form of the root stays exact as the ballooning goes to zero.
    return 2 * amount / (linear + (linear * linear + 4 * ballooning * amount) ** 0.5)


def leak(gauge: Value, leakage: Value, atmosphere: float) -> Value:
    """Return how fast n R T falls, W: laminar flow of an isothermal gas through a narrow gap.

    It goes with ``P**2 - P_atm**2``, which is ``p (p + 2 P_atm)`` in the gauge pressure p.

    Parameters
    ----------
    gauge
        p, Pa.
    leakage
        G, m^3/(s Pa), >= 0.
    atmosphere
        P_atm, Pa.
    """
    return leakage / 2 * gauge * (gauge + 2 * atmosphere)


def settled_torque(angle: Value, finger: FingerParameters) -> Value:
    """Return ``K theta**n``, odd, N m: the torque that holds an angle for good."""
    return finger.stiffness * angle * np.abs(angle) ** (finger.fractional_power - 1)


def finger_volume(angle: Value, gauge: Value, finger: FingerParameters) -> Value:
    """Return the air in the finger, m^3, at an angle (rad) and a gauge pressure (Pa)."""
    return finger.rest_volume + finger.torque_per_pressure * angle + finger.ballooning * gauge


class Plant:
    """The slopes of the rig's states for a batch of runs.

    Parameters
    ----------
    parameters
        Of the rig.
    stiffness, damping, leakage
        What each run has of these, shape (runs,), as multiples of the parameters.
    """

    def __init__(
        self, parameters: RigParameters, stiffness: Floats, damping: Floats, leakage: Floats
    ) -> None:
        finger, gas = parameters.finger, parameters.gas
        self.parameters = parameters
        self.stiffness = finger.stiffness * stiffness
        self.damping = finger.damping * damping
        self.leakage = gas.leakage * leakage
        self._memory = np.array(finger.memory)[:, None]
        self._relaxation = 1 / np.array(finger.memory_time)[:, None]

    def gauge_pressure(self, state: Floats, syringe_volume: Floats) -> Floats:
        """Return the pressure above the atmosphere, Pa, shape (runs,).

        Parameters
        ----------
        state
            Shape (states, runs).
        syringe_volume
            Air in the syringe, m^3, shape (runs,).
        """
        finger, gas = self.parameters.finger, self.parameters.gas
        volume = finger.torque_per_pressure * state[ANGLE]
        volume += syringe_volume
        volume += finger.rest_volume + gas.dead_volume
        pressure: Floats = absolute_pressure(
            state[AMOUNT], volume, finger.ballooning, gas.atmosphere
        )
        pressure -= gas.atmosphere
        return pressure

    def slopes(self, state: Floats, slope: Floats, syringe_volume: Floats) -> None:
        """Write the slope of each state; shapes as in `gauge_pressure`."""
        finger, gas, sensors = (
            self.parameters.finger,
            self.parameters.gas,
            self.parameters.sensors,
        )
        angle, rate = state[ANGLE], state[RATE]
        gauge = self.gauge_pressure(state, syringe_volume)
        np.negative(leak(gauge, self.leakage, gas.atmosphere), out=slope[AMOUNT])
        slope[ANGLE] = rate
        secant = np.abs(angle) ** (finger.fractional_power - 1)
        secant *= self.stiffness
        held, loaded = slope[MEMORY:], state[MEMORY:]
        np.multiply(self._memory, secant * rate * finger.fractional_power, out=held)
        held -= loaded * self._relaxation
        torque = finger.torque_per_pressure * gauge
        torque -= secant * angle
        torque -= self.damping * rate
        for branch in loaded:
            torque -= branch
        if finger.friction:
            torque -= finger.friction * rate / (rate * rate + finger.friction_rate**2) ** 0.5
        np.divide(torque, finger.inertia, out=slope[RATE])
        np.subtract(gauge, state[SENSED_PRESSURE], out=slope[SENSED_PRESSURE])
        slope[SENSED_PRESSURE] /= sensors.pressure_lag
        np.subtract(angle, state[SENSED_ANGLE], out=slope[SENSED_ANGLE])
        slope[SENSED_ANGLE] /= sensors.angle_lag
