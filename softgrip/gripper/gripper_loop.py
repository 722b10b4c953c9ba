"""The sampled loop around the linear fingers, looked at between the samples too."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import control
import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.gripper.internal_model import ControllerMatrices, InternalModelController
from softgrip.gripper.plant import Gripper, sampled, state_space


@dataclass(frozen=True)
class GripperRun:
    """A run of the loop.

    Attributes:
        time: s, shape (N,).
        angles: The fingers' true angles, rad, shape (fingers, N).
        commands: What the plant is given from each sample on, shape (samples,).
    """

    time: Floats
    angles: Floats
    commands: Floats


def run_gripper(
    gripper: Gripper,
    controller: InternalModelController,
    *,
    duration: float,
    noise: float = 0.0,
    push: Callable[[float], ArrayLike] | None = None,
    limit: float = np.inf,
    delay_samples: int = 0,
    points: int = 20,
    seed: int = 0,
) -> GripperRun:
    """Run a controller on real fingers, Eq. (6.21), from rest; it is reset first.

    Args:
        gripper: The real fingers, which need not be those of the controller's model.
        controller: With its target and period.
        duration: s, at least a period.
        noise: Standard deviation of each measured angle, rad, >= 0, independent from sample to
            sample.
        push: What pushes the fingers at a time [s]: the angle by which each would be moved in the
            end if the push stayed and the pump stood still, rad, shape (fingers,).
        limit: The command is cut to +-limit on its way to the plant.
        delay_samples: Periods by which the command comes late, >= 0.
        points: Steps within a period at which the angles are recorded, >= 1.
        seed: Of the noise.

    Raises:
        InvalidInputError: If a number is outside its range.
    """
    period = controller.matrices.period
    check_positive(duration=duration, limit=1.0 if np.isinf(limit) else limit, points=points)
    check_not_negative(noise=noise, delay_samples=delay_samples)
    if duration < period:
        raise InvalidInputError("duration", expected="at least a period", got=duration)
    count, step = len(gripper.fingers), period / points
    system = state_space(gripper)
    pushed = np.zeros((system.nstates, count))
    for k, finger in enumerate(gripper.fingers):
        # The states are angle and rate over gain.
        pushed[2 + 2 * k, k] = finger.stiffness / finger.gain
    inputs = np.hstack([system.B, pushed])
    A, B, C, _ = sampled(control.ss(system.A, inputs, system.C, 0), step)
    samples = round(duration / period)
    random = np.random.default_rng(seed)
    errors = noise * random.standard_normal((samples, count))
    late = deque([0.0] * delay_samples)
    state = np.zeros(system.nstates)
    angles, commands = [C @ state], []
    controller.reset()
    for k in range(samples):
        late.append(float(np.clip(controller.update(C @ state + errors[k]), -limit, limit)))
        commands.append(late.popleft())
        for j in range(points):
            outer = np.zeros(count) if push is None else np.asarray(push(k * period + j * step))
            state = A @ state + B @ np.concatenate([[commands[-1]], outer])
            angles.append(C @ state)
    return GripperRun(
        read_only(step * np.arange(samples * points + 1)),
        read_only(np.transpose(angles)),
        read_only(commands),
    )


def noise_gain(gripper: Gripper, matrices: ControllerMatrices) -> Floats:
    """Return RMS of each angle over the RMS of the noise in each measurement, shape (fingers,).

    The root of the sum of the squared impulse responses, at the samples, when the fingers are those
    of the model: the feedback then sees the noise alone.

    Args:
        gripper: The fingers.
        matrices: The controller, with the same fingers in its model.
    """
    A, B, C, _ = sampled(state_space(gripper), matrices.period)
    count = len(gripper.fingers)
    x, plant = np.zeros((len(matrices.A), count)), np.zeros((len(A), count))
    total, measured = np.zeros(count), np.eye(count)
    # Ten seconds are some twelve of the slowest time constants.
    for _ in range(round(10 / matrices.period)):
        command = matrices.C @ x + matrices.D_measured @ measured
        x = matrices.A @ x + matrices.B_measured @ measured + np.outer(matrices.B_sent, command)
        plant = A @ plant + B @ command[None]
        measured = C @ plant
        total += np.sum(measured**2, axis=1)
    return np.asarray(np.sqrt(total))
