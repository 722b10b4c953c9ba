"""The linear quadratic regulator of Section 3.4: finger and pump, weights, gain, closed loop.

The state of Eq. (3.26) is said to be ``[theta, theta', theta'']``, but Eq. (3.28) has the gain of
the plant in C and a 1 in B: its states are then the angle and its derivatives *divided by that
gain*. The matrices are taken at their word. Were the gain in B, the weights would act as others
with p times its square do, and R the same; what holds for every p holds for that reading too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, final

import numpy as np

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError

if TYPE_CHECKING:
    import control


FINGER = SecondOrder(2.86, 0.7)
"""Design 1: natural frequency of Table 3.3, damping ratio of Section 3.4, without its gain."""


@final
@dataclass(frozen=True)
class Weights:
    """The weights ``Q = p diag(q)``, Eq. (3.29), and R; by default those printed.

    Attributes:
        p: Common factor, > 0.
        q: Weights of the three states: the first > 0, the others >= 0.
        R: Weight of the command, > 0. The gain depends on ``p / R`` alone.

    Raises:
        InvalidInputError: If a value is outside its range.
    """

    p: float = 100.0
    q: tuple[float, float, float] = (1.0, 0.3, 0.0)
    R: float = 1.0

    def __post_init__(self) -> None:
        check_positive(p=self.p, R=self.R, q1=self.q[0])
        if len(self.q) != 3 or not all(np.isfinite(w) and w >= 0 for w in self.q):
            raise InvalidInputError("q", expected="three finite numbers >= 0", got=self.q)

    @property
    def Q(self) -> Floats:
        """Weight of the states, shape (3, 3)."""
        return self.p * np.diag(self.q)


def input_gain(finger: SecondOrder, pump_gain: float, set_speed: float) -> float:
    """Return the numerator of the plant, Eq. (3.25), ``l A_s omega_m c / (2 pi C_s M)``, rad/s^3.

    It holds the set motor speed omega_m, so the input u of Eq. (3.26) is a share of that speed. In
    the terms of Eq. (4.14), ``c / M`` is the finger's static gain times omega_n squared.

    Args:
        finger: With its static gain, rad/Pa.
        pump_gain: ``l A_s / (2 pi C_s)``, Pa/s per rad/s, > 0.
        set_speed: omega_m, rad/s, > 0.
    """
    check_positive(pump_gain=pump_gain, set_speed=set_speed)
    return finger.gain * finger.natural_frequency**2 * pump_gain * set_speed


def canonical_form(finger: SecondOrder, gain: float = 1.0) -> control.StateSpace:
    """Return the states, Eq. (3.26), and the output, Eq. (3.27), with the matrices, Eq. (3.28).

    The input is the share u of the set motor speed, the output the angle [rad].

    Args:
        finger: Its natural frequency and damping ratio; its static gain is in `gain`.
        gain: The element of C, rad/s^3: see `input_gain`.
    """
    w, z = finger.natural_frequency, finger.damping_ratio
    return integrating_finger(2 * z * w, w**2, gain)


def integrating_finger(damping: float, stiffness: float, gain: float) -> control.StateSpace:
    """Return ``gain / (s (s**2 + damping s + stiffness))``, an integrator before a finger.

    The plant of Chapters 3 and 6: its states are angle, rate and acceleration over the gain.
    """
    import control

    return control.ss(
        [[0, 1, 0], [0, 0, 1], [0, -stiffness, -damping]], [[0], [0], [1]], [[gain, 0, 0]], 0
    )


def derivatives_from_full_state(finger: SecondOrder) -> Floats:
    """Return the matrix from the states of `full_state_space` to angle, rate and acceleration.

    Those are pressure, angle and rate; the acceleration follows from them by Eq. (4.13). Divided by
    `input_gain` the result is the state of `canonical_form`.

    Returns:
        ndarray: Shape (3, 3), read-only.
    """
    w, z = finger.natural_frequency, finger.damping_ratio
    rows = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [finger.gain * w**2, -(w**2), -2 * z * w]]
    return read_only(rows)


def lqr_gain(finger: SecondOrder, weights: Weights) -> Floats:
    """Return K of ``u = -K x``, Eq. (3.30): ``R^-1 B' Y``, Y by the Riccati equation, shape (3,).

    >>> lqr_gain(FINGER, Weights()).round(3).tolist()
    [10.0, 6.07, 1.304]
    """
    import control

    plant = canonical_form(finger)
    gain, _, _ = control.lqr(plant.A, plant.B, weights.Q, weights.R)
    return np.asarray(gain[0], dtype=np.float64)


def closed_loop(finger: SecondOrder, weights: Weights) -> control.StateSpace:
    """Return the regulator about a reference, from reference to angle [both rad].

    The plant integrates, so ``u = -K (x - x_reference)`` leaves no error. The gain in C cancels.
    """
    import control

    plant, gain = canonical_form(finger), lqr_gain(finger, weights)[None, :]
    return control.ss(
        plant.A - plant.B @ gain, plant.B * gain[0, 0], plant.C, 0, inputs=1, outputs=1
    )


def step_response(
    finger: SecondOrder, weights: Weights, *, points: int = 2001
) -> tuple[Floats, Floats]:
    """Return time [s] and response of the closed loop to a unit step, over 12 time constants.

    The slowest pole sets the length: what is left at its end is some 1e-5.
    """
    import control

    loop = closed_loop(finger, weights)
    time = np.linspace(0, 12 / float(-loop.poles().real.max()), points)
    found = control.forced_response(loop, time, np.ones((1, points)), squeeze=False)
    return time, np.asarray(found.outputs[0], dtype=np.float64)


def linear_settling_time(finger: SecondOrder, weights: Weights, band: float) -> float:
    """Return the settling time of the closed loop without limit, noise or sampling, s.

    Args:
        finger, weights: Plant and design.
        band: Share of the step, 0 to 1.

    >>> round(linear_settling_time(FINGER, Weights(), 0.02), 2)  # printed: 0.8
    4.28
    """
    return float(settling_time(*step_response(finger, weights), final=1.0, band=band))
