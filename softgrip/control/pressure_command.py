"""How a controller that asks for a pressure drives a pump that takes a motor speed.

The PID designed on Eq. (4.14) gives a pressure, the pump takes a speed, and the text does not say
what was done with the one to get the other. Two readings are built:

`PressureAsSpeed`, which the book uses
    The loop on the board stays as it is and its gains alone are exchanged, as one does who compares
    two sets of gains: the output goes to the motor. As Eq. (4.14) and (4.15) are printed, the one
    with P and the other with omega_m in the numerator, their inputs are *shares*, of a set pressure
    and of a set speed; so a share of the one becomes the same share of the other. It takes nothing
    of the pump's model, as "based exclusively on the actuator's model" asks.

`PressureByPlunger`
    The plunger is sent to the place that Eq. (4.5) gives for the pressure. That needs the capacity
    C_i, so the pump's model with it; what is left out is only that the motor needs its time.

Which of the two it was, and the set values of the first, decide how well the design does. On the
simulated rig the second settles late or never: it answers the flex sensor's noise at full speed.
"""

from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.control.loop import SPEED_LIMIT, Controller
from softgrip.control.pid import PERIOD
from softgrip.units import MPa

SET_PRESSURE = 0.15 * MPa
"""Pressure up to which Section 4.3 takes the finger as linear, Pa."""


@final
class PressureAsSpeed:
    """Send a share of the set pressure as the same share of the set speed.

    Args:
        controller: Gives a pressure, Pa.
        set_pressure, set_speed: Pa and rad/s, > 0: what a share of 1 stands for.

    >>> from softgrip.control.pid import PID, Gains
    >>> half = PressureAsSpeed(PID(Gains(kp=75e3)), set_speed=10.0)
    >>> float(half.update(1.0, 0.0))
    5.0
    """

    def __init__(
        self,
        controller: Controller,
        *,
        set_pressure: float = SET_PRESSURE,
        set_speed: float = SPEED_LIMIT,
    ) -> None:
        check_positive(set_pressure=set_pressure, set_speed=set_speed)
        self.controller, self.speed_per_pressure = controller, set_speed / set_pressure

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the motor speed, rad/s."""
        return self.speed_per_pressure * np.asarray(self.controller.update(reference, measurement))


@final
class PressureByPlunger:
    """Send the plunger to the place that holds the pressure, by a pump of constant capacity.

    Args:
        controller: Gives a pressure, Pa.
        pump_gain: ``A l / (2 pi C_i)`` of Eq. (4.5), Pa/s per rad/s, > 0.
        speed_limit: rad/s, > 0. Where the motor is too slow the rest of the way is made up for
            later.
        period: s, > 0.

    >>> from softgrip.control.pid import PID, Gains
    >>> pump = PressureByPlunger(PID(Gains(kp=1e3)), 1e3, speed_limit=30.0)
    >>> [float(pump.update(1.0, 0.0)) for _ in range(3)]  # a turn of 1 rad in two periods
    [30.0, 10.0, 0.0]
    """

    def __init__(
        self,
        controller: Controller,
        pump_gain: float,
        *,
        speed_limit: float = SPEED_LIMIT,
        period: float = PERIOD,
    ) -> None:
        check_positive(pump_gain=pump_gain, speed_limit=speed_limit, period=period)
        self.controller, self.pump_gain = controller, pump_gain
        self.speed_limit, self.period = speed_limit, period
        self._turned: Floats = np.zeros(())

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the motor speed, rad/s."""
        pressure = np.asarray(self.controller.update(reference, measurement))
        wanted = (pressure / self.pump_gain - self._turned) / self.period
        speed = np.asarray(np.clip(wanted, -self.speed_limit, self.speed_limit))
        self._turned = self._turned + speed * self.period
        return speed
