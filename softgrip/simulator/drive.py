"""A controller on a batch of runs of the simulated rig, one period at a time."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.rig_controller import RigController
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.simulation import Simulation, Truth, together


@dataclass(frozen=True)
class Driven:
    """What happened in a batch of runs.

    Attributes:
        time: s, shape (N,).
        command: rad/s, shape (N, runs): what was held *until* each time, as in logs.
        measured, truth: With a leading axis of N samples.
    """

    time: Floats
    command: Floats
    measured: Measurement
    truth: Truth


def drive(
    rig: Simulation,
    controller: RigController,
    *,
    duration: float,
    limit: float = SPEED_LIMIT,
    push: Callable[[float], ArrayLike] | None = None,
    every: int = 1,
    delay: int = 0,
) -> Driven:
    """Run a controller on a rig at rest; the first sample is taken before it moves.

    Args:
        rig: Its period is the controller's.
        controller: From angles to motor speed.
        duration: s.
        limit: Of the command, rad/s. A controller may or may not know of it.
        push: From the time [s] at which a period begins to the torque on the fingers over it, N m,
            of a shape that broadcasts to (fingers, runs); None for none.
        every: Periods of the rig in one of the controller's, >= 1; in between the command is held.
        delay: Periods of the controller by which its command comes late, >= 0; until the first
            comes, the motor is sent 0.
    """
    late = deque([np.zeros(rig.runs)] * delay)
    measured, truths = [rig.measure()], [rig.truth]
    commands = [np.zeros(rig.runs)]
    for k in range(round(duration / rig.period)):
        if push is not None:
            rig.push(push(rig.time))
        if k % every == 0:
            wanted = np.clip(controller.update(measured[-1].angle), -limit, limit)
            late.append(np.broadcast_to(wanted, (rig.runs,)))
            command = late.popleft()
        commands.append(command)
        measured.append(rig.advance(command))
        truths.append(rig.truth)
    seen = together(measured)
    return Driven(np.asarray(seen.time), np.array(commands), seen, together(truths))
