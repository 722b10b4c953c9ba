"""Which angles one pump can give unequal fingers: the image of P, Eq. (6.1) and (6.24)-(6.25).

P(s) is a column, so its image is one direction, ``q(s) = P / |P|``. At rest that direction is the
fingers' velocity gains. At other frequencies it is another one, since the fingers' poles differ: a
step along the direction at rest is reached in the end and not on the way.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.gripper.inversion import Complex
from softgrip.gripper.plant import Gripper

TOLERANCE = 0.1
"""Share of a target that may lie outside the image: Section 6.4 accepts 0.082 for equal angles."""


class UnreachableTargetError(SoftgripError, ValueError):
    """A target that one pump cannot give these fingers.

    Attributes:
        share: Length of what cannot be reached over that of the target.
        nearest: Nearest target that can be reached, rad, shape (fingers,).
    """

    def __init__(self, target: Floats, nearest: Floats, share: float, tolerance: float) -> None:
        self.share, self.nearest = share, nearest
        super().__init__(
            f"target: expected angles of which at most {tolerance:.3g} lies outside the image of "
            f"P, got {np.round(target, 4).tolist()} rad with {share:.3g} outside; "
            f"the nearest that one pump reaches is {np.round(nearest, 4).tolist()} rad"
        )


@final
@dataclass(frozen=True)
class Projection:
    """A target split into what is reached and what is left.

    Attributes:
        reached: proj(Y_d), rad, shape (fingers,).
        residual: res(Y_d), rad, shape (fingers,): the error that is left in the end.
        share: Length of the residual over that of the target, 0 to 1.
    """

    reached: Floats
    residual: Floats
    share: float


def direction(gripper: Gripper, frequency: ArrayLike = 0.0) -> Complex:
    """Return q of length one: the column of P, Eq. (6.1), by the fingers alone, Eq. (6.12).

    It spans the image, and is complex, of shape (..., fingers).

    Args:
        gripper: The fingers.
        frequency: rad/s, >= 0, any shape. At 0 it is the limit, which is real.

    >>> from softgrip.gripper.plant import PRINTED
    >>> direction(PRINTED).real.round(4).tolist()
    [0.6466, 0.7628]
    """
    s = 1j * np.asarray(frequency, dtype=np.float64)[..., None]
    if not np.all(s.imag >= 0):
        raise InvalidInputError("frequency", expected="numbers >= 0", got=frequency)
    # The integrator is the same for all fingers: without it the limit at 0 is a plain value.
    gain, damping, stiffness = (
        np.array([getattr(f, name) for f in gripper.fingers])
        for name in ("gain", "damping", "stiffness")
    )
    column = gain / (s**2 + damping * s + stiffness)
    return np.asarray(column / np.linalg.norm(column, axis=-1, keepdims=True))


def project(gripper: Gripper, target: ArrayLike) -> Projection:
    """Split target angles at rest, Eq. (6.24), into what can be reached, Eq. (6.25), and the rest.

    Args:
        gripper: The fingers.
        target: rad, shape (fingers,), not all 0.

    Raises:
        InvalidInputError: If the target has another shape or is not finite, or is all 0.

    >>> from softgrip.gripper.plant import PRINTED
    >>> (project(PRINTED, [np.pi / 3] * 2).reached / np.pi).round(4).tolist()
    [0.3038, 0.3584]
    """
    wanted = _target(gripper, target)
    q = direction(gripper).real
    reached = (wanted @ q) * q
    residual = wanted - reached
    share = float(np.linalg.norm(residual) / np.linalg.norm(wanted))
    return Projection(read_only(reached), read_only(residual), share)


def reachable(gripper: Gripper, target: ArrayLike, *, tolerance: float = TOLERANCE) -> Floats:
    """Return the angles nearest to a target for which Eq. (6.7) holds, if they are near enough.

    Args:
        gripper: The fingers.
        target: rad, shape (fingers,), not all 0.
        tolerance: Largest share of the target that may be given up, 0 to 1.

    Raises:
        UnreachableTargetError: If more than that lies outside, such as for two fingers that are to
            bend opposite ways. Its nearest target has no negative angle: the fingers bend one way.

    >>> from softgrip.gripper.plant import PRINTED
    >>> reachable(PRINTED, [np.pi / 4, -np.pi / 4])
    Traceback (most recent call last):
    ...
    softgrip.gripper.reach.UnreachableTargetError: target: expected angles of which at most 0.1 \
lies outside the image of P, got [0.7854, -0.7854] rad with 1 outside; the nearest that one pump \
reaches is [0.0, 0.0] rad
    """
    check_positive(tolerance=tolerance)
    wanted = _target(gripper, target)
    found = project(gripper, wanted)
    # Along the direction all angles have one sign.
    if found.reached[0] < 0:
        nothing = np.zeros_like(wanted)
        raise UnreachableTargetError(wanted, nothing, 1.0, tolerance)
    if found.share > tolerance:
        raise UnreachableTargetError(wanted, found.reached, found.share, tolerance)
    return found.reached


def outside_share(gripper: Gripper, target: ArrayLike, frequency: ArrayLike) -> Floats:
    """Return which share of a target lies outside the image, Eq. (6.2): 0 where Eq. (6.3) holds.

    It is the share of its length that no input can produce at each frequency,

    ``|(I - q q*) d| / |d|`` for a constant direction d of the target, as a step has it. Along the
    direction at rest it is 0 at frequency 0 only: far above the natural frequencies the fingers
    follow their gains and not their velocity gains.

    Args:
        gripper: The fingers.
        target: rad, shape (fingers,), not all 0.
        frequency: rad/s, >= 0, shape (N,) or ().
    """
    wanted = _target(gripper, target)
    q = direction(gripper, frequency)
    along = np.sum(q.conj() * wanted, axis=-1, keepdims=True) * q
    return np.asarray(np.linalg.norm(wanted - along, axis=-1) / np.linalg.norm(wanted))


def _target(gripper: Gripper, target: ArrayLike) -> Floats:
    wanted = np.asarray(target, dtype=np.float64)
    count = len(gripper.fingers)
    if wanted.shape != (count,) or not np.isfinite(wanted).all() or not wanted.any():
        raise InvalidInputError("target", expected=f"{count} finite angles, not all 0", got=target)
    return wanted
