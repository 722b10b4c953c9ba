"""The gripper with a delay of each finger: what one pump then reaches, and its sampled model.

A finger answers late by what passes from the command to the pump, which is the same for all, and by
what passes until its own chamber has expanded and it bends (Section 7.2):
``Y_i(s) = P_i(s) exp(-s d_i) U(s)``. The column of P has turned, by ``exp(-j w d_i)`` in each
element. What is the same in all turns the column as a whole, and so moves nothing out of its image:
it makes a motion late, and no more. A difference of the delays does move it, and no command undoes
that: to invert the column causally is to be late by the largest delay at least.
"""

from dataclasses import dataclass
from typing import final

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.errors import InvalidInputError
from softgrip.gripper.inversion import Complex
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.reach import direction


@final
@dataclass(frozen=True)
class DelayedGripper:
    """Fingers on one pump that answer late.

    Attributes:
        gripper: The fingers without delay.
        delays: Of each finger, from the command to its bending, s, finite and >= 0.

    Raises:
        InvalidInputError: If there are not as many delays as fingers, or one is negative.

    >>> from softgrip.gripper.plant import PRINTED
    >>> DelayedGripper(PRINTED, (0.1, 0.15)).transport
    0.1
    """

    gripper: Gripper
    delays: tuple[float, ...]

    def __post_init__(self) -> None:
        given = np.asarray(self.delays, dtype=np.float64)
        wanted = len(self.gripper.fingers)
        if given.shape != (wanted,) or not (np.isfinite(given) & (given >= 0)).all():
            raise InvalidInputError(
                "delays", expected=f"{wanted} numbers >= 0, one a finger", got=self.delays
            )

    @property
    def transport(self) -> float:
        """What is common to all fingers, s: only that is made good by sending a command earlier."""
        return float(min(self.delays))

    def scaled(self, factor: float) -> "DelayedGripper":
        """Return it with each delay so many times as long: a controller's wrong belief."""
        return DelayedGripper(self.gripper, tuple(factor * one for one in self.delays))


def delayed_direction(plant: DelayedGripper, frequency: ArrayLike) -> Complex:
    """Return q of length one, `reach.direction` with the delays, shape (..., fingers).

    Args:
        plant: The fingers.
        frequency: rad/s, >= 0, any shape.
    """
    q, w = direction(plant.gripper, frequency), np.asarray(frequency, dtype=np.float64)
    return np.asarray(q * np.exp(-1j * w[..., None] * np.array(plant.delays)))


def delayed_outside_share(plant: DelayedGripper, target: ArrayLike, frequency: ArrayLike) -> Floats:
    """Return which share of a target that swings in step no command reaches, as `outside_share`.

    Args:
        plant: The fingers.
        target: rad, shape (fingers,), not all 0.
        frequency: rad/s, >= 0, shape (N,) or ().

    >>> from softgrip.gripper.plant import PRINTED
    >>> late, apart = (DelayedGripper(PRINTED, d) for d in ((0.3, 0.3), (0.2, 0.3)))
    >>> [delayed_outside_share(one, [0.8, 1.0], 2.0).round(3).item() for one in (late, apart)]
    [0.096, 0.174]
    """
    wanted, w = np.asarray(target, dtype=np.float64), np.asarray(frequency, dtype=np.float64)
    if wanted.shape != (len(plant.delays),) or not wanted.any():
        raise InvalidInputError("target", expected="an angle of each finger", got=target)
    q = delayed_direction(plant, w)
    along = np.sum(q.conj() * wanted, axis=-1, keepdims=True) * q
    return np.asarray(np.linalg.norm(wanted - along, axis=-1) / np.linalg.norm(wanted))


@final
@dataclass(frozen=True)
class DelayedModel:
    """A sampled model of a `DelayedGripper`: ``x' = A x + B u`` and ``y = C x``, exact.

    The states are the pump (the integral of all commands sent), then angle and rate over gain of
    each finger, then the commands that are still on their way, the last one first.

    Attributes:
        A, B, C: Shapes (n, n), (n,) and (fingers, n).
        fingers: Number of fingers.
        commands: Number of commands kept, >= 1.
        period: s.
    """

    A: Floats
    B: Floats
    C: Floats
    fingers: int
    commands: int
    period: float

    @property
    def last_command(self) -> int:
        """Index of the state that is the last command sent."""
        return 1 + 2 * self.fingers


def delayed_model(plant: DelayedGripper, period: float, *, commands: int = 1) -> DelayedModel:
    """Return the exact sampled model for held commands, whatever part of a period a delay is.

    Args:
        plant: The fingers.
        period: Time between commands, s, > 0.
        commands: Least number of past commands that are kept, >= 1.
    """
    check_positive(period=period, commands=commands)
    count = len(plant.delays)
    whole = [_whole_periods(delay, period) for delay in plant.delays]
    kept = max(commands, *(m + (part > 0) for m, part in whole))
    last = 1 + 2 * count
    size = last + kept
    A, B, C = np.zeros((size, size)), np.zeros(size), np.zeros((count, size))
    A[0, 0], B[0] = 1.0, period
    A[last + 1 :, last:-1] = np.eye(kept - 1)
    B[last] = 1.0

    def command(back: int) -> int:
        """Index of the command `back` periods ago, which 0 is the one now: -1."""
        return last + back - 1 if back else -1

    for k, (finger, (m, part)) in enumerate(zip(plant.gripper.fingers, whole, strict=True)):
        own = slice(1 + 2 * k, 3 + 2 * k)
        first, second = held_finger(finger, part), held_finger(finger, period - part)
        # Of angle and rate, by angle, rate, its own pump, the older command and the newer.
        move = np.zeros((2, 5))
        move[:, :4] = second[:2, :3] @ first[:3]
        move[:, 4] = second[:2, 3]
        A[own, own] = move[:, :2]
        # Its own pump is behind by the commands on their way.
        A[own, 0] += move[:, 2]
        for back in range(1, m + 1):
            A[own, command(back)] -= period * move[:, 2]
        if part:
            A[own, command(m + 1)] += move[:, 3] - part * move[:, 2]
        if m:
            A[own, command(m)] += move[:, 4]
        else:
            B[own] += move[:, 4]
        C[k, 1 + 2 * k] = finger.gain
    return DelayedModel(read_only(A), read_only(B), read_only(C), count, kept, period)


def _whole_periods(delay: float, period: float) -> tuple[int, float]:
    """Return whole periods in a delay, and what is left of it, s."""
    whole = int(np.floor(delay / period + 1e-9))
    part = delay - whole * period
    return whole, part if part > 1e-9 * period else 0.0


def held_finger(finger: FingerDynamics, time: float) -> Floats:
    """Return how angle, rate (over gain), pump and a held command go on over a time, (4, 4)."""
    slope = np.zeros((4, 4))
    slope[0, 1] = slope[1, 2] = slope[2, 3] = 1.0
    slope[1, :2] = -finger.stiffness, -finger.damping
    return np.asarray(scipy.linalg.expm(slope * time))
