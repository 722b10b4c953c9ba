"""How drift may go on in time: a steady rate that is not known, and a wander about it.

The text says of the drift that it is linear, and not how large it is. So each of gain and offset
is here the sum of two: its rate times the age of the calibration, and a wander, a random walk or
one that returns (Ornstein-Uhlenbeck). Both have closed forms over any step of time, so samples may
come irregularly.
"""

from dataclasses import dataclass
from math import exp, expm1, inf, isinf, sqrt

import numpy as np

from softgrip.arrays import Floats, floats, one_number
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError

HOUR = 3600.0
"""s."""


@dataclass(frozen=True)
class DriftSize:
    """How much drift is expected, one deviation each; the filter's knowledge before any reading.

    Attributes:
        gain_rate: 1/h, of the unknown steady rate of the gain, >= 0.
        offset_rate: V/h, the same of the offset, >= 0.
        gain_wander: 1/sqrt(h), of the gain's wander within an hour, >= 0.
        offset_wander: V/sqrt(h), the same of the offset, >= 0.
        return_time: h, after which a wander has returned to 1/e; infinite for a random walk.

    The defaults are assumed: the rates that the simulated layer of Chapter 2 has are twice as large
    as one deviation here, and either sign is as likely. The wanders add in eight hours half as much
    as such a rate does.

    Raises:
        InvalidInputError: If one is out of range.
    """

    gain_rate: float = 0.015
    offset_rate: float = 0.01
    gain_wander: float = 0.015 * sqrt(2.0)
    offset_wander: float = 0.01 * sqrt(2.0)
    return_time: float = inf

    def __post_init__(self) -> None:
        check_not_negative(
            gain_rate=self.gain_rate,
            offset_rate=self.offset_rate,
            gain_wander=self.gain_wander,
            offset_wander=self.offset_wander,
        )
        rates = {name: value for name, value in vars(self).items() if name != "return_time"}
        one_number(**rates)
        (hours,) = floats(return_time=self.return_time)
        if hours.ndim or not hours > 0:
            raise InvalidInputError("return_time", expected="hours > 0", got=self.return_time)

    def scaled(self, times: float) -> "DriftSize":
        """Return the same drift, so many times as large, >= 0."""
        return DriftSize(
            times * self.gain_rate,
            times * self.offset_rate,
            times * self.gain_wander,
            times * self.offset_wander,
            self.return_time,
        )

    def kept(self, hours: float) -> float:
        """Return the share of a wander that is left after some hours, 0 to 1."""
        return exp(-hours / self.return_time)

    def spread(self, hours: float) -> float:
        """Return the variance that a wander of 1/sqrt(h) gains in some hours.

        >>> DriftSize().spread(2.0), round(DriftSize(return_time=1.0).spread(50.0), 12)
        (2.0, 0.5)
        """
        if isinf(self.return_time):
            return hours
        return -expm1(-2 * hours / self.return_time) * self.return_time / 2

    def prior(self, calibration_error: float = 0.0) -> Floats:
        """Return the covariance of the state at the calibration, shape (4, 4).

        The state: the gain's rate (1/h), the offset's (V/h), the gain's wander, the offset's (V).

        Args:
            calibration_error: V, by which the calibration itself may be shifted.
        """
        return np.diag([self.gain_rate**2, self.offset_rate**2, 0.0, calibration_error**2])

    def transition(self, hours: float) -> tuple[Floats, Floats]:
        """Return F and Q of the state over some hours, >= 0, shapes (4, 4)."""
        kept, spread = self.kept(hours), self.spread(hours)
        F, Q = np.eye(4), np.zeros((4, 4))
        F[2, 2] = F[3, 3] = kept
        Q[2, 2], Q[3, 3] = self.gain_wander**2 * spread, self.offset_wander**2 * spread
        return F, Q


def gain_and_offset(state: Floats, age: float | Floats) -> tuple[Floats, Floats]:
    """Return gain (1) and offset (V) of states, shape (..., 4), at ages of the calibration, h."""
    return state[..., 0] * age + state[..., 2], state[..., 1] * age + state[..., 3]
