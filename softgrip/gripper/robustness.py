"""How much mismatch the loop of Figure 6.3 withstands, in continuous and in discrete time.

With ``y = (I + Delta W) P u`` the perturbation sees ``W P H P-dagger``, a matrix of rank one. For a
Delta of the fingers' own, each of size 1 at most, its structured singular value is the sum
``sum |W_i P_i H w_i / P_i|``; with the printed inverse that is ``|H|`` times the mean of the
``|W_i|``. The loop is stable for all such plants if it stays below 1 at all frequencies.
"""

from dataclasses import dataclass
from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag

from softgrip.arrays import Floats
from softgrip.gripper.internal_model import ControllerMatrices
from softgrip.gripper.inversion import Complex, LeftInverse, filtered_inverse
from softgrip.gripper.plant import FingerDynamics, Gripper, sampled, state_space
from softgrip.gripper.uncertainty import DAMPING_BOUND, STIFFNESS_BOUND


@final
@dataclass(frozen=True)
class Stability:
    """The poles of a closed loop.

    Attributes:
        poles: 1/s, or of z; without two that rest at the edge in every such loop, those of the pump
            and of its model. The inverse has a zero there, so nothing that is constant is fed back,
            and neither is moved: where the two were put they stay, and so they do not run away.
        margin: Distance of the poles from the edge of stability: least decay rate, 1/s, or 1 less
            the largest modulus. Above 0 if the loop is stable.
    """

    poles: Complex
    margin: float

    @property
    def stable(self) -> bool:
        """Whether all poles are on the stable side."""
        return self.margin > 0


def structured_gain(
    gripper: Gripper,
    inverse: LeftInverse,
    low_pass: control.StateSpace,
    weights: Floats,
    frequency: ArrayLike,
) -> Floats:
    """Return ``sum |W_i P_i H P-dagger_i|``: below 1 the loop withstands all plants of Eq. (6.17).

    Args:
        gripper, inverse, low_pass: Nominal plant, P-dagger and H.
        weights: ``|W_T|`` of each finger, shape (fingers, N) or (fingers, 1).
        frequency: rad/s, > 0, shape (N,).
    """
    s = 1j * np.asarray(frequency, dtype=np.float64)
    column = np.asarray(state_space(gripper)(s)).reshape(len(gripper.fingers), -1)
    parts = np.abs(column * inverse(s).T * np.asarray(low_pass(s)).ravel())
    return np.asarray(np.sum(np.abs(weights) * parts, axis=0))


def tolerated_uncertainty(gripper: Gripper, feedback: control.StateSpace) -> float:
    """Return the largest uniform size of W under which a sampled loop is stable for all Delta.

    For any feedback ``u = F y`` the perturbation of finger i comes back through
    ``F_i P_i / (1 - F P)``, and a Delta of the fingers' own adds up what comes back: the loop
    withstands 1 over the largest sum of these sizes. At rest a loop that holds its fingers has a
    sum of 1 or more, so no such loop tolerates more than 1, which is a finger that does not move.

    Args:
        gripper: Nominal plant, with which the loop is stable.
        feedback: F: from the angles to the command, sampled.

    Returns:
        float: A share of each finger's response, on a grid of 2,000 frequencies up to half the
            sampling frequency.
    """
    A, B, C, _ = sampled(state_space(gripper), feedback.dt)
    z = np.exp(1j * np.geomspace(1e-3, np.pi, 2000))
    column = np.asarray(control.ss(A, B, C, 0, feedback.dt)(z)).reshape(len(C), -1)
    row = np.asarray(feedback(z)).reshape(len(C), -1)
    back = np.abs(row * column).sum(axis=0) / np.abs(1 - np.sum(row * column, axis=0))
    return float(1 / back.max())


def continuous_stability(
    nominal: Gripper, real: Gripper, inverse: LeftInverse, low_pass: control.StateSpace
) -> Stability:
    """Return the poles of the continuous loop with other fingers than the model's, Eq. (6.22)."""
    ahead, model, plant = (
        filtered_inverse(inverse, low_pass),
        state_space(nominal),
        state_space(real),
    )
    # u = C_f x_f + D_f (Y_d - y + y_model), and the plants have no direct term.
    sees = np.hstack([model.C, -plant.C])
    command = np.hstack([ahead.C, ahead.D @ sees])
    drive = np.vstack([model.B, plant.B]) @ command
    A = block_diag(ahead.A, model.A, plant.A)
    n = len(ahead.A)
    A[:n, n:] = ahead.B @ sees
    A[n:] += drive
    poles = _without(np.linalg.eigvals(A), 0.0)
    return Stability(poles, float(-poles.real.max()))


def sampled_stability(
    matrices: ControllerMatrices, real: Gripper, *, delay_samples: int = 0
) -> Stability:
    """Return the poles of the sampled loop, with other fingers or a delay the model ignores.

    Args:
        matrices: The controller.
        real: The real fingers.
        delay_samples: Periods by which the command comes late, >= 0.
    """
    A_p, B_p, C_p, _ = sampled(state_space(real), matrices.period)
    if delay_samples:
        size = len(A_p)
        joined = block_diag(A_p, np.eye(delay_samples, k=1))
        joined[:size, size] = B_p[:, 0]
        A_p, B_p = joined, np.eye(len(joined))[:, -1:]
        C_p = np.hstack([C_p, np.zeros((len(C_p), delay_samples))])
    command = np.concatenate([matrices.C, matrices.D_measured @ C_p])
    A = block_diag(matrices.A, A_p)
    n = len(matrices.A)
    A[:n, n:] = matrices.B_measured @ C_p
    A += np.outer(np.concatenate([matrices.B_sent, B_p[:, 0]]), command)
    poles = _without(np.linalg.eigvals(A), 1.0)
    return Stability(poles, float(1 - np.abs(poles).max()))


def box(
    gripper: Gripper,
    *,
    damping: float = DAMPING_BOUND,
    stiffness: float = STIFFNESS_BOUND,
    points: int = 3,
) -> list[Gripper]:
    """Return two or more fingers over a grid of the box of C_n and K_n, each finger by itself.

    Args:
        gripper: The middle of the box.
        damping, stiffness: Half widths as shares, 0 to 1; by default those of Section 6.4.
        points: Grid points a side, >= 2: 2 are the corners.

    Returns:
        list: ``points ** (2 fingers)`` grippers.
    """
    fingers, side = gripper.fingers, np.linspace(-1, 1, points)
    grid = np.array(np.meshgrid(*[side] * (2 * len(fingers)))).reshape(len(fingers), 2, -1)
    return [
        Gripper(
            tuple(
                FingerDynamics(
                    f.damping * (1 + damping * c), f.stiffness * (1 + stiffness * k), f.gain
                )
                for f, (c, k) in zip(fingers, point, strict=True)
            )
        )
        for point in np.moveaxis(grid, -1, 0)
    ]


def _without(poles: Complex, shared: float) -> Complex:
    return np.delete(poles, np.abs(poles - shared).argsort()[:2])
