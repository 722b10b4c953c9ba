"""What drives a rig, simulated or real: from the angles of its fingers to one motor speed.

The laws of `pid`, `state_feedback` and `observer_feedback` are told a reference with each angle, as
`loop.run_loop` does on a linear model. A controller of a rig holds what it follows from the start,
as the scheme of Figure 6.3 does, whose target is part of its design: so whoever drives a rig need
not know what, if anything, is followed. `Tracking` makes the one of the other.
"""

from typing import Protocol, final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import read_only
from softgrip.checks import samples
from softgrip.control.loop import Controller


class RigController(Protocol):
    """The controller of Figure 6.3, one of these, or another."""

    def update(self, measured: ArrayLike) -> ArrayLike:
        """Return the motor speed for the next period, rad/s, shape () or (runs,).

        `measured` holds the angles, rad, shape (fingers, runs).
        """
        ...


@final
class CommandSequence:
    """A controller that looks at nothing: a sequence of commands, then rest.

    Args:
        commands: rad/s, shape (N,).
    """

    def __init__(self, commands: ArrayLike) -> None:
        self.commands = read_only(commands)
        self._left = self.commands.tolist()

    def update(self, measured: ArrayLike) -> float:  # noqa: ARG002
        """Return the next command."""
        return self._left.pop(0) if self._left else 0.0


@final
class Tracking:
    """A law of one angle on a rig: it is given the mean of the fingers', and follows a reference.

    Args:
        controller: Of one angle.
        reference: rad, a number, or shape (N,), one a period; after them the last is held.

    >>> from softgrip.control.pid import PID, Gains
    >>> rising = Tracking(PID(Gains(kp=2.0)), [0.0, 0.5])
    >>> [rising.update([[0.0], [0.2]]).tolist() for _ in range(3)]
    [[-0.2], [0.8], [0.8]]
    """

    def __init__(self, controller: Controller, reference: ArrayLike) -> None:
        self.controller = controller
        self.reference = read_only(np.ravel(reference))
        self._sample = 0

    def update(self, measured: ArrayLike) -> ArrayLike:
        """Return the command, rad/s, shape (runs,); angles in rad, shape (fingers, runs)."""
        mean = samples(measured=measured)[0].mean(axis=0)
        now = self.reference[min(self._sample, self.reference.size - 1)]
        command = self.controller.update(np.full(mean.shape, now), mean)
        self._sample += 1
        return command
