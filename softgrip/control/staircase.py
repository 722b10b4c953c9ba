"""A reference that goes up and down in steps, as that of Figure 4.7."""

import numpy as np

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.control.pid import PERIOD
from softgrip.errors import InvalidInputError
from softgrip.units import DEG

HOLD = 1.2
"""Time for which each level is held, s (Section 4.4)."""


def staircase(
    *,
    increment: float = 10 * DEG,
    top: float = 60 * DEG,
    hold: float = HOLD,
    period: float = PERIOD,
) -> Floats:
    """Return the samples of a staircase from 0 to a top and back; the first and last level are 0.

    The text names the time alone: increments and the top are assumed, and the edges are steps,
    since it speaks of a "desired command change".

    Args:
        increment: rad, > 0.
        top: rad, a multiple of the increment.
        hold, period: s, > 0; each level takes ``round(hold / period)`` samples.

    Raises:
        InvalidInputError: If an argument is outside its range.

    >>> staircase(increment=1.0, top=2.0, hold=2.0, period=1.0).tolist()
    [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 0.0, 0.0]
    """
    check_positive(increment=increment, top=top, hold=hold, period=period)
    steps, samples = round(top / increment), round(hold / period)
    if steps < 1 or samples < 1 or abs(steps * increment - top) > 1e-9 * top:
        raise InvalidInputError(
            "increment, top, hold, period",
            expected="a top that is a multiple of the increment, a hold of a period at least",
            got=(increment, top, hold, period),
        )
    up = np.arange(steps + 1)
    levels = increment * np.concatenate([up, up[-2::-1]])
    return read_only(np.repeat(levels, samples))
