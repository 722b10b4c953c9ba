"""The PD controller of Figure 2.12: from the error of the contact force to a gripper's position.

The text does not say whether the command C is the position itself or a change of it, nor does it
print gains. Both readings are here. As a position, a PD controller needs an error to keep the
fingers closed: on a contact of stiffness k it leaves the share 1 / (1 + kp k) of the force, and
kp k cannot be large (`largest_loop_gain`). As a change, the position sums up the errors and rests
only where there is none.
"""

from math import exp
from typing import Literal, final, get_args

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.errors import InvalidInputError

Command = Literal["change", "position"]
FILTER = 0.1
"""Filter of the derivative, as a share of the derivative time: the usual tenth."""


def tuned_gains(stiffness: float, lag: float, delay: float) -> Gains:
    """Return the gains for the command as a change of position, by Skogestad's rule (2003).

    A contact that is closed at a speed is an integrator of slope k. For it, with a delay and a lag,
    the rule asks for ``kp = 1 / (2 k delay)`` and a derivative that cancels the lag: a closed loop
    as slow as the delay, his choice for tight yet robust control. His integral, against loads that
    come and go, is left out.

    Args:
        stiffness: k, N/m, > 0: of the stiffest contact that is to be met.
        lag: Of the gripper, s, > 0.
        delay: s, > 0, with half a period for the hold.

    Returns:
        Gains: kp in m/s per N, kd in m per N.

    Raises:
        InvalidInputError: If an argument is not above zero.

    >>> tuned_gains(200.0, 0.03, 0.05).kp
    0.05
    """
    check_positive(stiffness=stiffness, lag=lag, delay=delay)
    kp = 1 / (2 * stiffness * delay)
    return Gains(kp=kp, kd=kp * lag, derivative_filter=FILTER * lag)


def largest_loop_gain(lag: float, period: float = PERIOD) -> float:
    """Return the loop gain kp k below which the command as a position is stable.

    The gripper follows with a first-order lag; the command comes one period late. With
    a = exp(-period / lag) the characteristic polynomial for kp and a backward difference with
    d = kd / period is ``z^3 - a z^2 + (1 - a) k (kp + d) z - (1 - a) k d``. By Jury's criterion it
    is stable for ``G < 1 - (1 - a) D - D^2``, G and D being (1 - a) k times kp and d: no
    derivative that is not negative allows more than G < 1.

    Raises:
        InvalidInputError: If an argument is not above zero.
    """
    check_positive(lag=lag, period=period)
    return 1 / (1 - exp(-period / lag))


@final
class ForceController:
    """A PD controller on the force error whose output closes a gripper.

    Args:
        gains: For a change: m/s per N, m per N. For a position: m per N, m s per N. Without
            integral.
        command: What the output of the PD controller is taken for.
        speed: Largest speed that a change asks for, m/s, > 0.
        period: s, > 0.

    Raises:
        InvalidInputError: If the gains have an integral, or another argument is outside its range.
    """

    def __init__(
        self,
        gains: Gains,
        command: Command = "change",
        *,
        speed: float = np.inf,
        period: float = PERIOD,
    ) -> None:
        if command not in get_args(Command):
            raise InvalidInputError("command", expected=f"one of {get_args(Command)}", got=command)
        if np.any(gains.ki):
            raise InvalidInputError("gains", expected="ki = 0: a PD controller", got=gains)
        limit = speed if command == "change" else np.inf
        self._pd = PID(gains, limits=(-limit, limit), period=period)
        self._sums, self._period = command == "change", period
        self._position: Floats = np.zeros(())

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> Floats:
        """Return the position to go to, m, closing > 0, from desired and measured force, N.

        Floats or shape (runs,); zero is where the gripper was at first.
        """
        output = self._pd.update(reference, measurement)
        self._position = self._position + self._period * output if self._sums else output
        return self._position
