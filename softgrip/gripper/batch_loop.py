"""The sampled loop of many grippers at once: their states as each period starts."""

from collections import deque
from dataclasses import replace

import numpy as np
from scipy.special import ndtri

from softgrip.arrays import Floats
from softgrip.gripper.gripper_batch import GripperBatch, uniforms
from softgrip.gripper.internal_model import ControllerMatrices
from softgrip.gripper.sampled_plant import held_motion
from softgrip.gripper.trial import Trial


def unaware(controller: ControllerMatrices) -> ControllerMatrices:
    """Return a controller whose model takes its whole command as sent, whatever the motor does.

    So Figure 6.3 draws it: the model P is fed by u_c. What a limit cuts off then shows as an error
    of the fingers, and is made up for; a model that knows the limit finds the fingers where it
    expects them, short of the target, and stays there.
    """
    whole, fingers = controller.linear(), controller.D_measured.size
    return replace(
        controller,
        A=whole.A,
        B_measured=whole.B[:, :fingers],
        B_target=whole.B[:, fingers:],
        B_sent=np.zeros_like(controller.B_sent),
    )


def loop_states(
    grippers: GripperBatch, controller: ControllerMatrices | None, trial: Trial
) -> Floats:
    """Run the loop from rest; parameters as of `monte_carlo.in_parts`.

    Returns
    -------
    ndarray
        Angle, rate, pump and command, the state of `sampled_plant.held_motion`, as each period
        starts and at the end, which has no command; shape (count, fingers, periods + 1, 4).
    """
    count, fingers = grippers.count, grippers.fingers
    motion = held_motion(grippers.damping, grippers.stiffness, grippers.gain, trial.period, 1)
    step = np.stack([motion.angle[..., 0], motion.rate], axis=-2)
    states = np.zeros((count, fingers, trial.periods + 1, 4))
    noise = sensor_noise(grippers, trial)
    own = np.zeros((count, 0 if controller is None else len(controller.A)))
    late = deque([np.zeros(count)] * trial.delay_samples)
    for k in range(trial.periods):
        now = states[:, :, k]
        measured = now[..., 0] + noise[:, k]
        command = np.full(count, trial.feedforward[k] if trial.feedforward else 0.0)
        if controller is not None:
            command += own @ controller.C + measured @ controller.D_measured
            command += controller.D_target @ trial.target
        sent = np.clip(command, -trial.limit, trial.limit)
        if controller is not None:
            own = own @ controller.A.T + measured @ controller.B_measured.T
            own += controller.B_target @ trial.target + np.outer(sent, controller.B_sent)
        late.append(sent)
        now[..., 3] = late.popleft()[:, None]
        states[:, :, k + 1, :2] = np.einsum("pfij,pfj->pfi", step, now)
        states[:, :, k + 1, 2] = now[..., 2] + trial.period * now[..., 3]
    return states


def sensor_noise(grippers: GripperBatch, trial: Trial) -> Floats:
    """Return the noise of the measured angles, rad, shape (count, periods, fingers)."""
    shape = (grippers.count, trial.periods, grippers.fingers)
    if not trial.noise:
        return np.broadcast_to(0.0, shape)
    return trial.noise * np.asarray(ndtri(uniforms(trial.seed, 1, grippers.first, shape)))
