"""The stepper motor and the plunger: what a commanded speed makes of them, in closed form.

The functions of speed, travel and play take numbers and arrays alike, and the kernel compiles them:
hence they call NumPy alone.
"""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Number
from softgrip.errors import InvalidInputError
from softgrip.simulator.parameters import PumpParameters


def speed(start: Number, command: Number, elapsed: Number, pump: PumpParameters) -> Number:
    """Return the motor speed that ramps from `start` to the commanded one.

    Args:
        start: Speed at the time of the command, rad/s, shape (runs,).
        command: Commanded speed, rad/s, shape (runs,); cut to the speed limit.
        elapsed: Time since the command, s, >= 0; broadcasts with the others.
        pump: Its limits.

    Returns:
        ndarray: rad/s, of the shape to which the inputs broadcast.
    """
    change = np.minimum(np.maximum(command, -pump.speed_limit), pump.speed_limit) - start
    ramp = pump.acceleration_limit * elapsed
    return start + np.minimum(np.maximum(change, -ramp), ramp)


def travel(start: Number, command: Number, elapsed: Number, pump: PumpParameters) -> Number:
    """Return how far the screw travels while the motor does as `speed` says.

    Parameters and shapes as in `speed`.

    Returns:
        ndarray: m, positive into the syringe. The ends of the stroke are not seen here.
    """
    target = np.minimum(np.maximum(command, -pump.speed_limit), pump.speed_limit)
    change = target - start
    ramping = np.minimum(elapsed, np.abs(change) / pump.acceleration_limit)
    lost = change * ramping - np.sign(change) * pump.acceleration_limit * ramping**2 / 2
    # While it ramps the motor is behind the target by `change` less what it has gained.
    return pump.advance * (target * elapsed - lost)


def turning_time(start: Number, command: Number, pump: PumpParameters) -> Number:
    """Return when the screw turns round, s after the command; 0 if it does not.

    Parameters and shapes as in `speed`. The speed goes straight to its target, so this is once at
    most.
    """
    return (start * command < 0) * np.abs(start) / pump.acceleration_limit


def follow(plunger: Number, screw: Number, backlash: Number) -> Number:
    """Return where a screw leaves the plunger after moving one way to its place: play.

    The plunger stands between ``screw - backlash`` and ``screw``, and moves if it must.

    Args:
        plunger: Its place before, m, any shape.
        screw: Where the screw is now, m; broadcasts with `plunger`.
        backlash: m, >= 0.

    >>> [float(follow(0.02, screw, 0.01).round(2)) for screw in (0.01, 0.02, 0.03, 0.04)]
    [0.01, 0.02, 0.02, 0.03]
    """
    return np.minimum(np.maximum(plunger, screw - backlash), screw)


def one_speed(command: ArrayLike) -> float:
    """Return a command of any shape with one element as a number, rad/s.

    >>> one_speed([[2]])
    2.0
    """
    values = np.asarray(command, dtype=np.float64)
    if values.size != 1 or not np.isfinite(values).all():
        raise InvalidInputError("command", expected="one finite motor speed, rad/s", got=command)
    return float(values.item())
