"""Controllers and commands on the simulated gripper, one period at a time."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT, Controller
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.simulation import Simulation, Truth, together


class GripperController(Protocol):
    """What closes the loop: the controller of Figure 6.3, or another."""

    def update(self, measured: ArrayLike) -> ArrayLike:
        """Return the motor speed for the next period, rad/s, shape () or (runs,).

        `measured` holds the angles, rad, shape (fingers, runs).
        """
        ...


@final
class CommandSequence:
    """A controller that looks at nothing: a sequence of commands, then rest.

    Parameters
    ----------
    commands
        rad/s, shape (N,).
    """

    def __init__(self, commands: ArrayLike) -> None:
        self._left = np.asarray(commands, dtype=np.float64).tolist()

    def update(self, measured: ArrayLike) -> float:  # noqa: ARG002
        """Return the next command."""
        return self._left.pop(0) if self._left else 0.0


@final
class OnTheMean:
    """A controller of one angle, given the mean of the fingers'.

    Parameters
    ----------
    controller
        Of one finger.
    target
        rad, shape (fingers,); its mean is the reference.
    """

    def __init__(self, controller: Controller, target: ArrayLike) -> None:
        self.controller, self.reference = controller, float(np.mean(np.asarray(target)))
        self.fingers = np.size(target)

    def update(self, measured: ArrayLike) -> ArrayLike:
        """Return the command, rad/s, shape (runs,)."""
        mean = np.asarray(measured, dtype=np.float64).mean(axis=0)
        return self.controller.update(np.full(mean.shape, self.reference), mean)


@final
class Held:
    """A controller asked at every so many periods only, its command held in between.

    Parameters
    ----------
    controller
        Which.
    periods
        Of the rig in one of the controller's, >= 1.
    """

    def __init__(self, controller: GripperController, periods: int) -> None:
        self.controller, self.periods, self._count = controller, periods, 0
        self._command: ArrayLike = 0.0

    def update(self, measured: ArrayLike) -> ArrayLike:
        """Return the command, rad/s, shape () or (runs,)."""
        if self._count % self.periods == 0:
            self._command = self.controller.update(measured)
        self._count += 1
        return self._command


@dataclass(frozen=True)
class DrivenGripper:
    """What happened in a batch of runs.

    Attributes
    ----------
    time
        s, shape (N,), from 0.
    command
        rad/s, shape (N, runs): what was held *until* each time, as in logs; 0 at first.
    measured, truth
        With a leading axis of N samples.
    """

    time: Floats
    command: Floats
    measured: Measurement
    truth: Truth


def drive_gripper(
    rig: Simulation,
    controller: GripperController,
    *,
    duration: float,
    limit: float = SPEED_LIMIT,
    push: Callable[[float], ArrayLike] | None = None,
) -> DrivenGripper:
    """Run a controller on a gripper at rest.

    Parameters
    ----------
    rig
        Its period is the controller's.
    controller
        From angles to motor speed.
    duration
        s.
    limit
        Of the command, rad/s. A controller may or may not know of it.
    push
        From the time [s] at which a period begins to the torque on the fingers over it, N m, of a
        shape that broadcasts to (fingers, runs); None for none.
    """
    measured, truths = [rig.measure()], [rig.truth]
    commands = [np.zeros(rig.runs)]
    for _ in range(round(duration / rig.period)):
        if push is not None:
            rig.push(push(rig.time))
        wanted = np.round(np.asarray(controller.update(measured[-1].angle)), SPEED_DIGITS)
        commands.append(np.broadcast_to(np.clip(wanted, -limit, limit), (rig.runs,)))
        measured.append(rig.advance(commands[-1]))
        truths.append(rig.truth)
    seen = together(measured)
    return DrivenGripper(np.asarray(seen.time), np.array(commands), seen, together(truths))
