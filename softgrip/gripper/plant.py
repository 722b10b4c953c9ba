"""The gripper's plant: several fingers on one pump, Eq. (6.4)-(6.16), (6.26) and (6.27)."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, final

import numpy as np
import scipy

from softgrip.arrays import Floats, Number, check_positive
from softgrip.control.lqr import integrating_finger
from softgrip.errors import InvalidInputError

if TYPE_CHECKING:
    import control


@final
@dataclass(frozen=True)
class FingerDynamics:
    """One element of P(s), Eq. (6.16): ``gain / (s**3 + damping s**2 + stiffness s)``.

    Attributes:
        damping: ``C_n / M_eq``, 1/s, > 0.
        stiffness: ``K_n / M_eq``, 1/s^2, > 0.
        gain: ``c p A_s l / (2 pi C_i M_eq)``, rad/s^3 per unit of the input, > 0.

    Raises:
        InvalidInputError: If a number is not finite and above zero.

    >>> round(FingerDynamics(2.66, 3.61, 7.831).natural_frequency, 2)
    1.9
    """

    damping: float
    stiffness: float
    gain: float

    def __post_init__(self) -> None:
        check_positive(damping=self.damping, stiffness=self.stiffness, gain=self.gain)

    @classmethod
    def from_physics(
        cls,
        *,
        mass: float,
        damping: float,
        stiffness: float,
        torque_per_pressure: float,
        pump_gain: float,
    ) -> FingerDynamics:
        """Return the element from the parameters of finger, Eq. (6.9), and pump, Eq. (6.14).

        Args:
            mass, damping, stiffness: M_eq, C_n and K_n, in one system of units (kg, N s/rad, N/rad,
                or as moments).
            torque_per_pressure: c, in the same system, per Pa.
            pump_gain: ``A_s l / (2 pi C_i)``, Pa/s per unit of the input (rad/s of the motor).
        """
        check_positive(mass=mass)
        return cls(damping / mass, stiffness / mass, torque_per_pressure * pump_gain / mass)

    @property
    def natural_frequency(self) -> Number:
        """Root of the stiffness, rad/s."""
        return self.stiffness**0.5

    @property
    def velocity_gain(self) -> float:
        """Angular rate at rest per unit of a constant input, ``gain / stiffness``, rad/s."""
        return self.gain / self.stiffness


@final
@dataclass(frozen=True)
class Gripper:
    """Two or more fingers on one pump: P(s) is a column, Eq. (6.6).

    Raises:
        InvalidInputError: If there are fewer than two fingers.

    >>> PRINTED.velocity_gains.round(3).tolist()
    [2.169, 2.559]
    """

    fingers: tuple[FingerDynamics, ...]

    def __post_init__(self) -> None:
        if len(self.fingers) < 2:
            raise InvalidInputError("fingers", expected="two or more", got=len(self.fingers))

    @property
    def velocity_gains(self) -> Floats:
        """``gain / stiffness`` of each finger, shape (fingers,): the direction of P at DC."""
        return np.array([finger.velocity_gain for finger in self.fingers])

    @property
    def mean(self) -> FingerDynamics:
        """The finger whose parameters are the means of all."""
        return FingerDynamics(*np.mean([astuple(f) for f in self.fingers], axis=0).tolist())


PRINTED = Gripper((FingerDynamics(2.66, 3.61, 7.831), FingerDynamics(2.45, 3.06, 7.831)))
"""Eq. (6.26) and (6.27), SPA 1 and SPA 2."""
LEFT, RIGHT = PRINTED.fingers[1], PRINTED.fingers[0]
"""By their angles. The text contradicts itself on which finger is which: Eq. (6.26) gives SPA 1 the
larger stiffness, so that it bends less (0.303 pi against 0.357 pi of one command), and Eq. (6.27)
has 0.227 pi, 40.86 deg, for it. But Section 6.4 calls SPA 1 the left finger, which bends more (50
deg against 39.5 deg in open loop, 48.24 deg against 40.86 deg desired). With the softer row for the
left finger the angles, the rows and "responds faster" (a softer finger of the same mass is ahead at
all times) agree, and the equivalent masses differ by a few percent only, as they should."""


def finger_state_space(finger: FingerDynamics) -> control.StateSpace:
    """Return a finger with a pump, Eq. (6.15), in controllable form, from input to angle [rad]."""
    return integrating_finger(finger.damping, finger.stiffness, finger.gain)


def stacked_state_space(gripper: Gripper) -> control.StateSpace:
    """Return the fingers stacked, Eq. (6.11): three states and one output a finger, one input.

    Each finger has an integrator of its own here, though there is one pump: only the sum of the
    states that they share is driven, so with two fingers or more this realization is not
    controllable. `state_space` has the pump once.
    """
    import control

    parts = [finger_state_space(finger) for finger in gripper.fingers]
    size, count = 3 * len(parts), len(parts)
    A, B, C = np.zeros((size, size)), np.zeros((size, 1)), np.zeros((count, size))
    for k, part in enumerate(parts):
        rows = slice(3 * k, 3 * k + 3)
        A[rows, rows], B[rows], C[k, rows] = part.A, part.B, part.C[0]
    return control.ss(A, B, C, 0)


def state_space(gripper: Gripper) -> control.StateSpace:
    """Return a realization, Eq. (6.4), of P(s), Eq. (6.5): pump, then the fingers, Eq. (6.10) each.

    It has 1 + 2 fingers states, and is minimal if the fingers are unequal, since the pump's
    integrator is in it once. The states are the integral of the input, then angle over gain and
    rate over gain of each finger. Outputs are the angles, rad.
    """
    import control

    count = len(gripper.fingers)
    size = 1 + 2 * count
    A, B, C = np.zeros((size, size)), np.zeros((size, 1)), np.zeros((count, size))
    B[0] = 1
    for k, finger in enumerate(gripper.fingers):
        angle, rate = 1 + 2 * k, 2 + 2 * k
        A[angle, rate] = 1
        A[rate, 0], A[rate, angle], A[rate, rate] = 1, -finger.stiffness, -finger.damping
        C[k, angle] = finger.gain
    return control.ss(A, B, C, 0)


def sampled(
    system: control.StateSpace, period: float, method: str = "zoh"
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return A, B, C and D of a system that is sampled each period, s.

    `method` is that of `scipy.signal.cont2discrete`, by default exact for a held input.
    """
    A, B, C, D, _ = scipy.signal.cont2discrete(
        (system.A, system.B, system.C, system.D), period, method
    )
    return A, B, C, D


@dataclass(frozen=True)
class Structure:
    """What Assumption 2 asks of a realization.

    Attributes:
        order: Number of states.
        controllable, observable: Ranks of the two matrices of Section 6.4; the order where the
            property holds.
        poles: 1/s, shape (order,).
        zeros: Transmission zeros: where P(s) loses rank, 1/s.
    """

    order: int
    controllable: int
    observable: int
    poles: Floats
    zeros: Floats

    @property
    def minimal(self) -> bool:
        """Whether the realization is controllable and observable, Assumption 2 (a)."""
        return self.controllable == self.observable == self.order


def structure(system: control.StateSpace) -> Structure:
    """Judge a realization with one input by the ranks of the matrices of Section 6.4.

    Time is counted in units of the fastest pole, without which the powers of A differ by so much
    that the rank is that of rounding errors.

    Args:
        system: One input, n outputs, a pole other than zero.
    """
    import control

    poles = np.linalg.eigvals(system.A)
    A = system.A / np.abs(poles).max()
    controllable = np.linalg.matrix_rank(control.ctrb(A, system.B))
    observable = np.linalg.matrix_rank(control.obsv(A, system.C))
    # With one input P(s) is a column: it loses rank only where all its elements vanish at once.
    first, *others = (
        np.asarray(control.ss(system.A, system.B, row[None], 0).zeros()) for row in system.C
    )
    common = [z for z in first if all(np.any(np.abs(z - other) < 1e-6) for other in others)]
    return Structure(len(poles), int(controllable), int(observable), poles, np.array(common))
