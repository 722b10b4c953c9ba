"""PID controller with filtered derivative: sampled, with anti-windup, and as a state space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, final, get_args

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, check_positive, chosen, floats
from softgrip.checks import check_finite, samples, takes_numbers
from softgrip.errors import InvalidInputError

if TYPE_CHECKING:
    import control


PERIOD = 0.025
"""Time between two updates on the rig, s."""

DerivativeOn = Literal["error", "measurement"]


@final
@dataclass(frozen=True)
class Gains:
    """Gains of the parallel form ``kp e + ki int e + kd de/dt``.

    Attributes:
        kp, ki, kd: Command unit per rad, per rad s, and times s per rad; finite. Floats, or for a
            map of gains arrays of one shape (runs,), which `PID` takes and `pid_state_space` does
            not.
        derivative_filter: Time constant of the derivative's low pass, s, > 0, so that the
            controller is proper; a float, or an array as the gains.

    Raises:
        InvalidInputError: If a gain is not finite or the filter is not above zero.
    """

    kp: Number
    ki: Number = 0.0
    kd: Number = 0.0
    derivative_filter: Number = 0.025

    def __post_init__(self) -> None:
        check_positive(derivative_filter=self.derivative_filter)
        check_finite(kp=self.kp, ki=self.ki, kd=self.kd)


@final
class PID:
    """The sampled controller, for one run or a batch of runs.

    The derivative's filter and the integral are backward differences. Anti-windup is by clamping:
    while the command is at a limit, an error that would push it further is not integrated. That
    needs no further parameter, as back-calculation would.

    Args:
        gains: The gains.
        limits: Least and largest command, the first below the second.
        period: Time between updates, s, > 0.
        derivative_on: "error", as in `pid_state_space`, or "measurement", which does not kick when
            the reference jumps.
        anti_windup: False to let the integral grow at the limits, for comparison.

    Raises:
        InvalidInputError: If the limits are not in order, or another argument is outside its range.

    >>> pid = PID(Gains(kp=2.0, ki=4.0), limits=(-3, 3))
    >>> [round(float(pid.update(1.0, y)), 6) for y in (0.0, 0.0, 0.5)]
    [2.1, 2.2, 1.25]
    """

    @takes_numbers
    def __init__(
        self,
        gains: Gains,
        *,
        limits: tuple[float, float] = (-np.inf, np.inf),
        period: float = PERIOD,
        derivative_on: DerivativeOn = "error",
        anti_windup: bool = True,
    ) -> None:
        check_positive(period=period)
        (ends,) = floats(limits=limits)
        if ends.shape != (2,) or not ends[0] < ends[1]:
            raise InvalidInputError("limits", expected="(least, largest)", got=limits)
        if derivative_on not in get_args(DerivativeOn):
            raise InvalidInputError(
                "derivative_on", expected=f"one of {get_args(DerivativeOn)}", got=derivative_on
            )
        self.gains, self.limits, self.period = gains, limits, period
        self.derivative_on, self.anti_windup = derivative_on, anti_windup
        self.reset()

    def reset(self) -> None:
        """Forget the past: no integral, and rest before the next update."""
        self._integral: Floats = np.zeros(())
        self._derivative: Floats = np.zeros(())
        self._last: Floats | None = None

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the command for one period.

        Before the first update the error was zero, so that a reference that starts with a step
        acts as one; for a derivative on the measurement, the measurement was what it is.

        Args:
            reference, measurement: rad, floats or shape (runs,); they broadcast.

        Returns:
            ndarray: Command within the limits, shape () or (runs,).

        Raises:
            NotFiniteError: If one is NaN or infinite; integral and derivative are as before.
        """
        wanted, measured = samples(reference=reference, measurement=measurement)
        error = wanted - measured
        if self.derivative_on == "error":
            signal, before = error, np.zeros_like(error)
        else:
            signal, before = -measured, -measured
        change = signal - (before if self._last is None else self._last)
        self._last = signal
        command, self._integral, self._derivative = pid_step(
            self.gains,
            self.limits,
            error,
            change,
            self._integral,
            self._derivative,
            period=self.period,
            anti_windup=self.anti_windup,
        )
        return np.asarray(command)


def pid_step(
    gains: Gains,
    limits: tuple[float, float],
    error: Number,
    change: Number,
    integral: Number,
    derivative: Number,
    *,
    period: float = PERIOD,
    anti_windup: bool = True,
) -> tuple[Number, Number, Number]:
    """Return command, integral and derivative of one update: the law of `PID`, for symbols too.

    Args:
        gains, limits, period, anti_windup: As of `PID`.
        error: rad.
        change: Since the update before, of what is differentiated, rad.
        integral, derivative: Their parts of the command after the update before.
    """
    tau = gains.derivative_filter
    derivative = (tau * derivative + gains.kd * change) / (tau + period)
    step = gains.ki * period * error
    free = gains.kp * error + integral + step + derivative
    command = np.minimum(np.maximum(free, limits[0]), limits[1])
    if anti_windup:
        step = chosen((free - command) * step > 0, 0.0, step)
    return command, integral + step, derivative


def pid_state_space(gains: Gains) -> control.StateSpace:
    """Return the controller in continuous time: from error [rad] to command.

    The states are the integral of the error and the filtered error; each is left out where its
    gain is zero, so that a closed loop has no mode that nothing sees. InvalidInputError is raised
    for arrays of gains.

    >>> pid_state_space(Gains(1.0, 2.0)).nstates, pid_state_space(Gains(1.0, 2.0, 3.0)).nstates
    (1, 2)
    """
    import control

    if any(np.ndim(gain) for gain in (gains.kp, gains.ki, gains.kd)):
        raise InvalidInputError("gains", expected="one number each", got=gains)
    tau = gains.derivative_filter
    poles = ([0.0] if gains.ki else []) + ([-1 / tau] if gains.kd else [])
    inputs = ([1.0] if gains.ki else []) + ([1 / tau] if gains.kd else [])
    outputs = ([gains.ki] if gains.ki else []) + ([-gains.kd / tau] if gains.kd else [])
    D = gains.kp + (gains.kd / tau if gains.kd else 0.0)
    n = len(poles)
    return control.ss(
        np.diag(poles) if n else np.empty((0, 0)),
        np.array(inputs).reshape(n, 1),
        np.array(outputs).reshape(1, n),
        D,
        inputs=["error"],
        outputs=["command"],
    )
