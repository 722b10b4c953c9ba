"""The stepper motor and the plunger: what a commanded speed makes of them, in closed form."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.parameters import PumpParameters


def speed(start: Floats, command: Floats, elapsed: Floats, pump: PumpParameters) -> Floats:
    """Return the motor speed that ramps from `start` to the commanded one.

    Args:
        start: Speed at the time of the command, rad/s, shape (runs,).
        command: Commanded speed, rad/s, shape (runs,); cut to the speed limit.
        elapsed: Time since the command, s, >= 0; broadcasts with the others.
        pump: Its limits.

    Returns:
        ndarray: rad/s, of the shape to which the inputs broadcast.
    """
    change = np.clip(command, -pump.speed_limit, pump.speed_limit) - start
    ramp = pump.acceleration_limit * elapsed
    return start + np.clip(change, -ramp, ramp)


def travel(start: Floats, command: Floats, elapsed: Floats, pump: PumpParameters) -> Floats:
    """Return how far the plunger travels while the motor does as `speed` says.

    Parameters and shapes as in `speed`.

    Returns:
        ndarray: m, positive into the syringe. The ends of the stroke are not seen here.
    """
    target = np.clip(command, -pump.speed_limit, pump.speed_limit)
    change = target - start
    ramping = np.minimum(elapsed, np.abs(change) / pump.acceleration_limit)
    lost = change * ramping - np.sign(change) * pump.acceleration_limit * ramping**2 / 2
    # While it ramps the motor is behind the target by `change` less what it has gained.
    way: Floats = pump.advance * (target * elapsed - lost)
    return way


def one_speed(command: ArrayLike) -> float:
    """Return a command of any shape with one element as a number, rad/s.

    >>> one_speed([[2]])
    2.0
    """
    values = np.asarray(command, dtype=np.float64)
    if values.size != 1 or not np.isfinite(values).all():
        raise InvalidInputError("command", expected="one finite motor speed, rad/s", got=command)
    return float(values.item())
