"""The loop of Figure 6.3 with the delay in its model: a Smith predictor around stable inversion.

``u = H P-dagger (Y_d - (y - P exp(-s d) u))``: internal model control with the delayed plant. The
inverse is that of the fingers without delay, since no causal filter undoes ``exp(-s d)``; what is
fed back is only what the delayed model does not expect, so that for a perfect model the delay is
outside the loop and the fingers do what they would without it, late by d. With another, slower
filter in the feedback it is the *filtered* Smith predictor: the target is followed as fast as
before, and what a wrong delay feeds back is damped.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy

from softgrip.arrays import read_only
from softgrip.gripper.delayed_plant import DelayedGripper, delayed_model
from softgrip.gripper.internal_model import PERIOD, ControllerMatrices, Method
from softgrip.gripper.inversion import LeftInverse, filtered_inverse
from softgrip.gripper.plant import sampled

if TYPE_CHECKING:
    import control


def smith_matrices(
    plant: DelayedGripper,
    inverse: LeftInverse,
    low_pass: control.StateSpace,
    *,
    period: float = PERIOD,
    feedback_filter: control.StateSpace | None = None,
    method: Method = "bilinear",
    commands: int = 1,
) -> ControllerMatrices:
    """Return Figure 6.3 in discrete time with any delay of each finger in its model.

    For delays of whole periods that are the same it is `internal_model.controller_matrices` with so
    many `delay_samples`.

    Args:
        plant: The model inside.
        inverse: P-dagger of the fingers without delay.
        low_pass: H(s), continuous, falling off as ``s^-3`` or faster.
        period: Time between updates, s, > 0.
        feedback_filter: Another H(s) for what is fed back; the same if None.
        method: How ``H P-dagger`` is made discrete; the model is exact for a held command.
        commands: As of `delayed_model`.
    """
    model = delayed_model(plant, period, commands=commands)
    ahead = sampled(filtered_inverse(inverse, low_pass), period, method)
    back = ahead
    if feedback_filter is not None:
        back = sampled(filtered_inverse(inverse, feedback_filter), period, method)
    if feedback_filter is None:
        A_f, C_f, B_d, B_f = ahead[0], ahead[2][0], ahead[1], ahead[1]
    else:
        A_f = scipy.linalg.block_diag(ahead[0], back[0])
        C_f = np.hstack([ahead[2], back[2]])[0]
        B_d = np.vstack([ahead[1], np.zeros_like(back[1])])
        B_f = np.vstack([np.zeros_like(ahead[1]), back[1]])
    n_f, n_p = len(A_f), len(model.A)
    A = scipy.linalg.block_diag(A_f, model.A)
    A[:n_f, n_f:] = B_f @ model.C
    none = np.zeros((n_p, model.fingers))
    return ControllerMatrices(
        A=read_only(A),
        B_measured=read_only(np.vstack([-B_f, none])),
        B_target=read_only(np.vstack([B_d, none])),
        B_sent=read_only(np.concatenate([np.zeros(n_f), model.B])),
        C=read_only(np.concatenate([C_f, (back[3] @ model.C)[0]])),
        D_measured=read_only(-back[3][0]),
        D_target=read_only(ahead[3][0]),
        period=period,
    )
