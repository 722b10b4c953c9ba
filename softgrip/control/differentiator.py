"""Angle, rate and acceleration from a sampled angle: a robust exact differentiator, and a fit.

Section 3.4 names "robust differentiation methods" and no more. Both differentiators here are causal
and take one sample, or one of each run, at a time.
"""

from typing import Protocol, final

import numpy as np
from numpy.typing import ArrayLike
from scipy.signal import savgol_coeffs

from softgrip.arrays import Floats, Number, check_positive
from softgrip.checks import samples, takes_numbers
from softgrip.control.pid import PERIOD
from softgrip.errors import InvalidInputError

LEVANT = (2.0, 1.5 * 2.0**0.5, 1.1)
"""Levant's gains 2, 1.5 and 1.1 of the second order, in the form that is not recursive."""


class Differentiator(Protocol):
    """What gives a signal and its first two derivatives."""

    def update(self, measurement: ArrayLike) -> Floats:
        """Take the next sample, rad, shape () or (runs,); return (3,) or (3, runs): per s^0,1,2.

        Before the first sample the signal rested at it. NotFiniteError is raised for NaN or
        infinity, and the state is as before.
        """
        ...


def predict(
    angle: Number, rate: Number, acceleration: Number, measured: Number, jerk: Number, h: float
) -> tuple[Number, Number, Number]:
    """Return the states of `RobustDifferentiator` a period h later; it calls NumPy alone."""
    miss = angle - measured
    size, sign = np.abs(miss), np.sign(miss)
    pull_0 = -LEVANT[0] * jerk ** (1 / 3) * size ** (2 / 3) * sign
    pull_1 = -LEVANT[1] * jerk ** (2 / 3) * size ** (1 / 3) * sign
    pull_2 = -LEVANT[2] * jerk * sign
    return (
        angle + h * (pull_0 + rate) + h * h / 2 * acceleration,
        rate + h * (pull_1 + acceleration),
        acceleration + h * pull_2,
    )


@final
class RobustDifferentiator:
    """Levant's robust exact differentiator of second order, in discrete time.

    It is exact for a signal whose third derivative stays within `jerk`, once it has converged. With
    noise of size e its errors are at most of the order of ``e``, ``jerk^(1/3) e^(2/3)`` and
    ``jerk^(2/3) e^(1/3)``; noise that is independent from sample to sample averages out in part,
    which takes 1/6 off each exponent of e. In discrete time it is the explicit scheme with the
    Taylor term that keeps the accuracy of continuous time: Euler's alone loses it in the angle.

    A. Levant, "Higher-order sliding modes, differentiation and output-feedback control",
    International Journal of Control 76 (2003) 924-941; M. Livne and A. Levant, "Proper
    discretization of homogeneous differentiators", Automatica 50 (2014) 2007-2014.

    Args:
        jerk: Bound of the third derivative, rad/s^3, > 0; a number or shape (runs,).
        period: s, > 0.

    >>> line = RobustDifferentiator(5.0)
    >>> for k in range(400):
    ...     found = line.update(0.5 * k * 0.025)
    >>> found.round(2).tolist()[:2]  # at 9.975 s
    [4.99, 0.5]
    """

    @takes_numbers
    def __init__(self, jerk: Number, *, period: float = PERIOD) -> None:
        check_positive(jerk=jerk, period=period)
        self.jerk, self.period = jerk, period
        self._state: Floats | None = None

    def update(self, measurement: ArrayLike) -> Floats:
        """Take the next sample and return angle, rate and acceleration at it."""
        (y,) = samples(measurement=measurement)
        if self._state is None:
            self._state = np.stack([y, np.zeros_like(y), np.zeros_like(y)])
        now = self._state
        # The state is the prediction for the next sample; what is told is the one for this.
        self._state = np.stack(predict(now[0], now[1], now[2], y, self.jerk, self.period))
        return now


@final
class PolynomialDifferentiator:
    """Derivatives of a parabola or cubic through the last samples, by least squares.

    A filter of Savitzky and Golay, taken at the newest sample, which a controller needs.

    Args:
        window: Number of samples, above the order.
        order: Of the polynomial, >= 2.
        period: s, > 0.

    Attributes:
        rows: What the samples weigh, oldest first, in angle, rate and acceleration, (3, window).

    >>> fit = PolynomialDifferentiator(5)
    >>> for k in range(5):
    ...     found = fit.update((0.025 * k) ** 2)
    >>> found.round(6).tolist()
    [0.01, 0.2, 2.0]
    """

    @takes_numbers
    def __init__(self, window: int, *, order: int = 2, period: float = PERIOD) -> None:
        check_positive(period=period)
        if not (2 <= order < window):
            raise InvalidInputError("window, order", expected="2 <= order < window", got=order)
        rows = [
            savgol_coeffs(window, order, deriv=k, delta=period, pos=window - 1, use="dot")
            for k in range(3)
        ]
        self.rows: Floats = np.array(rows)
        self.period = period
        self._last: list[Floats] = []

    def update(self, measurement: ArrayLike) -> Floats:
        """Take the next sample and return angle, rate and acceleration at it."""
        (y,) = samples(measurement=measurement)
        window = self.rows.shape[1]
        self._last = [*self._last[1:], y] if self._last else [y] * window
        return np.asarray(np.tensordot(self.rows, np.stack(self._last), axes=1))
