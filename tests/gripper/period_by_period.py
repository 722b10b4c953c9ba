"""An oracle for sampled loops around fingers: python-control called for each period."""

import control
import numpy as np

from softgrip.gripper.gripper_batch import GripperBatch, Trial
from softgrip.gripper.internal_model import InternalModelController
from softgrip.gripper.plant import FingerDynamics, Gripper, state_space


def gripper_of(batch: GripperBatch, number: int) -> Gripper:
    """Return one gripper of a batch."""
    numbers = (batch.damping[number], batch.stiffness[number], batch.gain[number])
    return Gripper(tuple(FingerDynamics(*map(float, each)) for each in zip(*numbers, strict=True)))


def forced(
    gripper: Gripper,
    trial: Trial,
    controller: InternalModelController,
    noise: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Return angles and commands from `forced_response`; the noise has one row a period."""
    plant, late = state_space(gripper), [0.0] * trial.delay_samples
    state, time = np.zeros(plant.nstates), np.linspace(0, trial.period, trial.points_a_period + 1)
    angles, commands = [np.zeros((len(gripper.fingers), 1))], []
    for k in range(trial.periods):
        told = angles[-1][:, -1] if noise is None else angles[-1][:, -1] + noise[k]
        late.append(min(max(float(controller.update(told)), -trial.limit), trial.limit))
        commands.append(late.pop(0))
        found = control.forced_response(
            plant, time, np.full(time.size, commands[-1]), state, squeeze=False
        )
        state = found.states[:, -1]
        angles.append(found.outputs[:, 1:])
    return np.concatenate(angles, axis=1), np.array(commands)
