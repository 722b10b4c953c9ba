"""A stepper motor: the torque it has left at a speed."""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Value
from softgrip.checks import check_above_zero
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Motor:
    """A stepper motor with its driver: torque falling in a straight line with speed.

    Attributes
    ----------
    name
        For people.
    holding_torque
        At standstill, N m, > 0.
    no_torque_speed
        Where the line reaches zero, rad/s, > 0.
    speed_limit
        Highest speed that the rig allows, rad/s, > 0; infinity for none.
    """

    name: str
    holding_torque: float
    no_torque_speed: float
    speed_limit: float = float("inf")

    def __post_init__(self) -> None:
        check_above_zero(holding_torque=self.holding_torque, no_torque_speed=self.no_torque_speed)
        if not self.speed_limit > 0:
            raise InvalidInputError("speed_limit", expected="a number > 0", got=self.speed_limit)

    def torque(self, speed: Value) -> Value:
        """Return the torque at a speed in rad/s of either sign, N m; zero from its end on."""
        result: Value = self.holding_torque * np.maximum(
            0.0, 1 - np.abs(speed) / self.no_torque_speed
        )
        return result

    def speed(self, torque: float) -> float:
        """Return the highest speed that leaves a torque, rad/s, within the limit; 0 if none does.

        Examples
        --------
        >>> Motor("", holding_torque=0.4, no_torque_speed=60.0).speed(0.1)
        45.0
        """
        free = self.no_torque_speed * (1 - torque / self.holding_torque)
        return min(max(0.0, free), self.speed_limit)


def winding_limited_speed(
    voltage: float, inductance: float, current: float, *, rotor_teeth: int = 50
) -> float:
    """Estimate the speed where a stepper has lost its torque: ``U / (N L I)``.

    There the reactance of the winding, N omega L, takes the whole supply to pass the rated
    current. Beyond it torque falls about as 1/speed, so it errs to the safe side.

    Parameters
    ----------
    voltage
        Supply of the driver, V, > 0.
    inductance
        Of a phase, H, > 0.
    current
        Rated, of a phase, A, > 0.
    rotor_teeth
        N, 50 for a step of 1.8 degrees.

    Returns
    -------
    float
        rad/s.

    Examples
    --------
    >>> round(winding_limited_speed(24.0, 3.0e-3, 2.0))  # 12.7 rev/s
    80
    """
    check_above_zero(
        voltage=voltage, inductance=inductance, current=current, rotor_teeth=rotor_teeth
    )
    return voltage / (rotor_teeth * inductance * current)
