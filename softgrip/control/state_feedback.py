"""The sampled regulator: a measured angle, its derivatives, and Eq. (3.30) as a motor speed."""

from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.control.differentiator import Differentiator
from softgrip.control.loop import SPEED_LIMIT
from softgrip.errors import InvalidInputError

SPEED_DIGITS = 6
"""Decimals of a commanded speed in rad/s: finer than any motor, and coarser than the last bits of
linear algebra, which differ from machine to machine and would make logs differ."""


@final
class StateFeedback:
    """Feed angle, rate and acceleration back, for one run or a batch of runs.

    How Eq. (3.30) is read: the state is that of Eq. (3.28), angle and derivatives divided by the
    gain in C, less the same of the reference; u is a share of the set motor speed omega_m, which
    that gain contains. So the motor is sent ``omega_m u``, and the loop cuts it at the motor's
    limit. Nothing integrates here, so nothing winds up.

    Parameters
    ----------
    gain
        K, shape (3,), or (3, runs) for a map of gains.
    input_gain
        The gain in C, rad/s^3, > 0: see `lqr.input_gain`.
    differentiator
        Gives the derivatives; its period is the loop's.
    set_speed
        omega_m, rad/s, > 0, as in `input_gain`.

    Examples
    --------
    >>> from softgrip.control.differentiator import PolynomialDifferentiator
    >>> regulator = StateFeedback([2.0, 0.0, 0.0], 4.0, PolynomialDifferentiator(3), set_speed=10.0)
    >>> float(regulator.update(1.0, 0.0))
    5.0
    """

    def __init__(
        self,
        gain: ArrayLike,
        input_gain: float,
        differentiator: Differentiator,
        *,
        set_speed: float = SPEED_LIMIT,
    ) -> None:
        check_positive(input_gain=input_gain, set_speed=set_speed)
        K = np.asarray(gain, dtype=np.float64)
        if K.ndim not in (1, 2) or K.shape[0] != 3 or not np.isfinite(K).all():
            raise InvalidInputError("gain", expected="finite, shape (3,) or (3, runs)", got=K.shape)
        self.speed_gain, self.differentiator = set_speed / input_gain * K, differentiator

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the motor speed for one period, rad/s, shape () or (runs,).

        Parameters
        ----------
        reference, measurement
            rad, floats or shape (runs,).
        """
        angle, rate, acceleration = self.differentiator.update(measurement)
        K = self.speed_gain
        error = np.asarray(reference, dtype=np.float64) - angle
        free = K[0] * error - K[1] * rate - K[2] * acceleration
        return np.asarray(np.round(free, SPEED_DIGITS))
