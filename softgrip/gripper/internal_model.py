"""The loop of Figure 6.3, sampled: stable inversion ahead, an internal model for the feedback.

With ``u_c = u_ff - u_fb``, ``u_ff = H P-dagger Y_d``, ``y_delta = y - P u_c`` and
``u_fb = H P-dagger y_delta`` the command is ``u = H P-dagger (Y_d - (y - P u))``: internal model
control.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, final

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.checks import samples
from softgrip.errors import InvalidInputError
from softgrip.gripper.inversion import LeftInverse, filtered_inverse
from softgrip.gripper.plant import Gripper, sampled, state_space

if TYPE_CHECKING:
    import control


PERIOD = 0.1
"""Sampling time of Section 6.4, s."""

Method = Literal["bilinear", "zoh", "foh"]
"""How ``H P-dagger`` is made discrete: names of `scipy.signal.cont2discrete`."""


@final
@dataclass(frozen=True)
class ControllerMatrices:
    """A sampled controller with measured angles y, target Y_d, command u and what is sent of it.

    ``x' = A x + B_measured y + B_target Y_d + B_sent sent`` and
    ``u = C x + D_measured y + D_target Y_d``.

    `sent` is the command as the plant gets it: u, or u within a limit that the controller knows.

    Attributes:
        A: Shape (n, n): filters first, then the model's plant, then the commands on their way.
        B_measured, B_target: Shape (n, fingers).
        B_sent: Shape (n,).
        C: Shape (n,).
        D_measured, D_target: Shape (fingers,).
        period: s.
    """

    A: Floats
    B_measured: Floats
    B_target: Floats
    B_sent: Floats
    C: Floats
    D_measured: Floats
    D_target: Floats
    period: float

    def linear(self) -> control.StateSpace:
        """Return the controller when nothing limits it: from [y, Y_d] to u."""
        import control

        D = np.concatenate([self.D_measured, self.D_target])[None]
        B = np.hstack([self.B_measured, self.B_target]) + self.B_sent[:, None] * D
        return control.ss(self.A + np.outer(self.B_sent, self.C), B, self.C[None], D, self.period)


def controller_matrices(
    gripper: Gripper,
    inverse: LeftInverse,
    low_pass: control.StateSpace,
    *,
    period: float = PERIOD,
    feedback_filter: control.StateSpace | None = None,
    delay_samples: int = 0,
    method: Method = "bilinear",
) -> ControllerMatrices:
    """Return Figure 6.3 in discrete time, with the feedback of Eq. (6.23).

    Args:
        gripper: The model inside: the nominal plant.
        inverse: P-dagger.
        low_pass: H(s), continuous, falling off as ``s^-3`` or faster.
        period: Time between updates, s, > 0.
        feedback_filter: Another H(s) for ``u_fb``; the same if None.
        delay_samples: Updates by which the model inside takes the command to come late, >= 0.
        method: How ``H P-dagger`` is made discrete. The plant's model is exact for a held command.

    Raises:
        InvalidInputError: If a number is outside its range.
    """
    check_positive(period=period)
    if delay_samples < 0:
        raise InvalidInputError("delay_samples", expected=">= 0", got=delay_samples)
    count = len(gripper.fingers)
    A_p, B_p, C_p, _ = sampled(state_space(gripper), period)
    ahead = sampled(filtered_inverse(inverse, low_pass), period, method)
    if feedback_filter is None:
        # One filter sees Y_d - y_delta as a whole.
        A_f, B_f, C_f, D_f = ahead
        B_d, D_d = B_f, D_f
    else:
        back = sampled(filtered_inverse(inverse, feedback_filter), period, method)
        A_f, C_f = scipy.linalg.block_diag(ahead[0], back[0]), np.hstack([ahead[2], back[2]])
        B_d = np.vstack([ahead[1], np.zeros_like(back[1])])
        B_f = np.vstack([np.zeros_like(ahead[1]), back[1]])
        D_d, D_f = ahead[3], back[3]
    n_f, n_p = len(A_f), len(A_p)
    size = n_f + n_p + delay_samples
    model = slice(n_f, n_f + n_p)
    A, B_y, B_t = np.zeros((size, size)), np.zeros((size, count)), np.zeros((size, count))
    A[:n_f, :n_f], A[:n_f, model], A[model, model] = A_f, B_f @ C_p, A_p
    B_y[:n_f], B_t[:n_f] = -B_f, B_d
    B_u = np.zeros(size)
    if delay_samples:
        A[model, n_f + n_p] = B_p[:, 0]
        A[n_f + n_p :, n_f + n_p :] = np.eye(delay_samples, k=1)
        B_u[-1] = 1
    else:
        B_u[model] = B_p[:, 0]
    C = np.zeros(size)
    C[:n_f], C[model] = C_f[0], (D_f @ C_p)[0]
    return ControllerMatrices(
        A=read_only(A),
        B_measured=read_only(B_y),
        B_target=read_only(B_t),
        B_sent=read_only(B_u),
        C=read_only(C),
        D_measured=read_only(-D_f[0]),
        D_target=read_only(D_d[0]),
        period=period,
    )


@final
class InternalModelController:
    """The sampled controller of Figure 6.3, for one run or a batch of runs.

    Args:
        matrices: The controller, of `controller_matrices`.
        target: Angles to go to, rad, shape (fingers,), from the first update on; in the image of P
            at rest, or what can be reached of it is reached.
        limit: The command is cut to +-limit, and the model inside is given what is left. To leave
            the model ignorant of a limit, cut the command outside.
        digits: Decimals to which the command is given, so that the last bits of linear algebra,
            which differ from machine to machine, do not make runs differ; None for all.

    Raises:
        InvalidInputError: If shapes do not fit or a number is outside its range.

    >>> from softgrip.gripper.inversion import mean_inverse
    >>> from softgrip.gripper.plant import PRINTED
    >>> from softgrip.gripper.shaping_filter import low_pass
    >>> matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass(3.0))
    >>> loop = InternalModelController(matrices, [0.95, 1.12])
    >>> loop.update([0.0, 0.0]).round(2).item()
    3.01
    """

    def __init__(
        self,
        matrices: ControllerMatrices,
        target: ArrayLike,
        *,
        limit: float = np.inf,
        digits: int | None = None,
    ) -> None:
        check_positive(limit=1.0 if np.isinf(limit) else limit)
        self.matrices, self.limit, self.digits = matrices, limit, digits
        self.target = read_only(target)
        if self.target.shape != matrices.D_target.shape:
            raise InvalidInputError(
                "target", expected=f"shape {matrices.D_target.shape}", got=self.target.shape
            )
        self.reset()

    def reset(self) -> None:
        """Forget the past: filters and model at rest."""
        self._state: Floats = np.zeros(len(self.matrices.A))

    def update(self, measured: ArrayLike) -> Floats:
        """Return the command for the next period.

        Args:
            measured: Angles, rad, shape (fingers,) or (fingers, runs).

        Returns:
            ndarray: Command within the limit, shape () or (runs,).

        Raises:
            NotFiniteError: If an angle is NaN or infinite; filters and model are as before.
            InvalidInputError: If there are more or fewer fingers.
        """
        (y,) = samples(measured=measured)
        if y.ndim not in (1, 2) or len(y) != len(self.target):
            raise InvalidInputError(
                "measured", expected=f"shape ({len(self.target)},) or (fingers, runs)", got=y.shape
            )
        m, goal = self.matrices, self.target
        x = self._state
        drive = m.B_target @ goal
        if y.ndim == 2:
            x = np.broadcast_to(x[:, None] if x.ndim == 1 else x, (len(x), y.shape[1]))
            drive = drive[:, None]
        command = m.C @ x + m.D_measured @ y + m.D_target @ goal
        sent = np.minimum(np.maximum(command, -self.limit), self.limit)
        self._state = m.A @ x + m.B_measured @ y + drive + np.multiply.outer(m.B_sent, sent)
        return np.asarray(sent if self.digits is None else np.round(sent, self.digits))
