"""The sampled regulators: Eq. (3.30) as a motor speed, by a differentiator or by an observer."""

from collections.abc import Sequence
from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, check_positive, floats
from softgrip.checks import samples, takes_numbers
from softgrip.control.differentiator import Differentiator
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import canonical_form
from softgrip.control.pid import PERIOD
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError
from softgrip.units import DEG

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

    Args:
        gain: K, shape (3,), or (3, runs) for a map of gains.
        input_gain: The gain in C, rad/s^3, > 0: see `lqr.input_gain`; a number or shape (runs,).
        differentiator: Gives the derivatives; its period is the loop's.
        set_speed: omega_m, rad/s, > 0, as in `input_gain`.

    >>> from softgrip.control.differentiator import PolynomialDifferentiator
    >>> regulator = StateFeedback([2.0, 0.0, 0.0], 4.0, PolynomialDifferentiator(3), set_speed=10.0)
    >>> float(regulator.update(1.0, 0.0))
    5.0
    """

    @takes_numbers
    def __init__(
        self,
        gain: ArrayLike,
        input_gain: Number,
        differentiator: Differentiator,
        *,
        set_speed: float = SPEED_LIMIT,
    ) -> None:
        check_positive(input_gain=input_gain, set_speed=set_speed)
        (each,), K = floats(input_gain=input_gain), _three(gain)
        if each.ndim and each.shape != K.shape[1:]:
            raise InvalidInputError(
                "input_gain", expected=f"a number or shape {K.shape[1:]}", got=each.shape
            )
        self.speed_gain = set_speed / each * K
        self.differentiator = differentiator

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the motor speed for one period, rad/s, shape () or (runs,).

        Args:
            reference, measurement: rad, floats or shape (runs,).

        Raises:
            NotFiniteError: If one is NaN or infinite; the differentiator is as before.
        """
        wanted, measured = samples(reference=reference, measurement=measurement)
        angle, rate, acceleration = self.differentiator.update(measured)
        free = fed_back(self.speed_gain, wanted - angle, rate, acceleration)
        return np.asarray(np.round(free, SPEED_DIGITS))


def fed_back(
    gain: Floats | Sequence[Number], error: Number, rate: Number, acceleration: Number
) -> Number:
    """Return ``K (x_reference - x)`` for a reference at rest, for symbols too."""
    return gain[0] * error - gain[1] * rate - gain[2] * acceleration


@final
class ObserverFeedback:
    """The regulator on the states of a stationary Kalman filter, for one run or a batch of runs.

    The filter knows the plant of Eq. (3.26), the command that it sent and the noise of the sensor;
    what it does not know enters as a disturbance of the command. The state and u are read as in
    `StateFeedback`. It starts at rest at an angle of 0.

    Args:
        gain: K, shape (3,), or (3, runs) for a map of gains.
        finger, input_gain: Plant of the design: `lqr.canonical_form` and `lqr.input_gain`.
        noise: Root mean square of the measurement's noise, rad, > 0 (Section 6.4: 2 deg).
        disturbance: Root mean square of that of the command, as a share of the set speed, > 0: how
            little the model is trusted. The filter depends on its ratio to the noise alone.
        limit, set_speed: Largest motor speed, and that which a share of 1 means, rad/s, > 0.
        period: s, > 0.

    Attributes:
        correct, step, drive: Of the filter: ``found = predicted + correct (y - C predicted)`` and
            ``predicted = step found + drive u``, shapes (3, 1), (3, 3) and (3, 1).
        limit: As a share of the set speed.
    """

    @takes_numbers
    def __init__(
        self,
        gain: ArrayLike,
        finger: SecondOrder,
        input_gain: float,
        *,
        noise: float = 2 * DEG,
        disturbance: float = 1.0,
        limit: float = SPEED_LIMIT,
        set_speed: float = SPEED_LIMIT,
        period: float = PERIOD,
    ) -> None:
        check_positive(input_gain=input_gain, noise=noise, disturbance=disturbance, limit=limit)
        check_positive(set_speed=set_speed, period=period)
        held = control.sample_system(canonical_form(finger, input_gain), period, "zoh")
        _, spread, _ = control.dlqe(
            held.A, held.B, held.C, [[disturbance**2]], [[noise**2]], method="scipy"
        )
        # Some libraries return the gain of the next prediction; this is that of the estimate now.
        self.correct: Floats = spread @ held.C.T / (held.C @ spread @ held.C.T + noise**2)
        self.step: Floats = held.A
        self.drive: Floats = held.B
        self._predicted: Floats = np.zeros((3, 1))
        self.gain, self.input_gain, self.period = _three(gain), input_gain, period
        self.limit, self.set_speed = limit / set_speed, set_speed

    def linear(self) -> control.StateSpace:
        """Return it from the measurement [rad] to the motor speed [rad/s], without its limit.

        For one gain and a reference of 0; one state a prediction, sampled.
        """
        K = self.gain.reshape(1, 3)
        seen = np.eye(3) - self.correct @ [[self.input_gain, 0.0, 0.0]]
        closed = self.step - self.drive @ K
        return control.ss(
            closed @ seen,
            closed @ self.correct,
            -self.set_speed * K @ seen,
            -self.set_speed * K @ self.correct,
            self.period,
        )

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the motor speed for one period, rad/s, within the limit, shape () or (runs,).

        Args:
            reference, measurement: rad, floats or shape (runs,).

        Raises:
            NotFiniteError: If one is NaN or infinite; the filter is as before.
        """
        y, r = samples(measurement=measurement, reference=reference)
        miss = y - self.input_gain * self._predicted[0]
        found = self._predicted + self.correct * miss
        K = self.gain.reshape(3, -1)
        free = K[0] * r / self.input_gain - np.sum(K * found, axis=0)
        share = np.clip(free, -self.limit, self.limit)
        self._predicted = self.step @ found + self.drive * share
        speed = np.round(self.set_speed * share, SPEED_DIGITS)
        single = y.ndim == r.ndim == 0 and self.gain.ndim == 1
        return np.asarray(speed[0] if single else speed)


def _three(gain: ArrayLike) -> Floats:
    """Return K, checked."""
    (K,) = floats(gain=gain)
    if K.ndim not in (1, 2) or K.shape[0] != 3 or not np.isfinite(K).all():
        raise InvalidInputError("gain", expected="finite, shape (3,) or (3, runs)", got=K.shape)
    return K
