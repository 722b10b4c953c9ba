"""Why no p of Eq. (3.29) gives the printed settling time: a proof, and the best that p can do.

With the open-loop polynomial ``a(s) = s (s^2 + 2 zeta omega_n s + omega_n^2)`` and q_3 = 0 the
regulator's polynomial phi obeys ``phi(s) phi(-s) = a(s) a(-s) + (p / R) (q_1 - q_2 s^2)``, a cubic
in ``z = s^2``. At z = 0 it is ``p q_1 / R > 0``. At z = q_1 / q_2 the last term vanishes for every
p, and ``a(s) a(-s) < 0`` where ``zeta < 1``. So between the two it has a root: a real pole of the
closed loop lies between ``-sqrt(q_1 / q_2)`` and 0, for every p and R.
"""

from dataclasses import dataclass
from math import exp, log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from softgrip.control.lqr import Weights
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Certificate:
    """Signs that prove where a real closed-loop pole lies.

    Attributes:
        pole_bound: ``-sqrt(q_1 / q_2)``, rad/s.
        at_origin: phi(s) phi(-s) at s = 0.
        at_bound: phi(s) phi(-s) at the bound: it holds no p.
    """

    pole_bound: float
    at_origin: float
    at_bound: float

    @property
    def proves(self) -> bool:
        """Whether the signs differ, so that a real pole lies between the bound and 0."""
        return self.at_origin > 0 > self.at_bound


def certificate(finger: SecondOrder, weights: Weights) -> Certificate:
    """Return the signs of the proof; `Certificate.proves` tells whether they carry it.

    They do for every finger with a damping ratio below 1.

    Raises:
        InvalidInputError: If q_3 is not 0 or q_2 is: there is no such bound then.

    >>> found = certificate(SecondOrder(2.86, 0.7), Weights())
    >>> round(found.pole_bound, 3), found.proves
    (-1.826, True)
    """
    q1, q2 = _weights_of_the_proof(weights)
    c3, c2, _, c0 = _cubic(finger, weights)
    z = q1 / q2
    # The two terms with p cancel exactly at this z: left out, not subtracted.
    open_loop = ((c3 * z + c2) * z + finger.natural_frequency**4) * z
    return Certificate(-sqrt(z), -c0, -open_loop)


def closed_loop_poles(finger: SecondOrder, weights: Weights) -> NDArray[np.complex128]:
    """Return the closed-loop poles by spectral factorisation, without a Riccati equation, (3,).

    The real one, or the slowest of three, comes first.
    """
    left = -np.sqrt(np.roots(_cubic(finger, weights)).astype(np.complex128))
    return left[np.lexsort((left.imag, -left.real, np.abs(left.imag) > 1e-9))]


def settling_floor(finger: SecondOrder, weights: Weights, band: float) -> float:
    """Return a time before which the loop settles for no p, s: proved, and so below the best.

    The response is that of the complex pair, held back by the real pole: ``y' = a (v - y)``. If the
    pair's damping ratio is at least 1/2, v overshoots by at most ``exp(-pi / sqrt(3))``, 16.3 %, so
    ``y <= 1.163 (1 - exp(-a t))``, and a is below the bound of the certificate. With
    ``c = 2 - 4 zeta^2`` the ratio is at least 1/2 for every p if ``c q_1 / q_2 <= (1 - c^2)
    omega_n^2`` and ``c >= -1``: compare the coefficients of phi(s) phi(-s) with those of its
    factors.

    Args:
        finger, weights: Plant and design; p and R have no influence.
        band: Share of the step, 0 to 1.

    Raises:
        InvalidInputError: If these conditions, or those of `certificate`, do not hold.

    >>> [round(settling_floor(SecondOrder(2.86, 0.7), Weights(), b), 2) for b in (0.02, 0.1)]
    [1.01, 0.81]
    """
    q1, q2 = _weights_of_the_proof(weights)
    c = 2 - 4 * finger.damping_ratio**2
    # For c <= 0 the condition on the ratio is met by every p, as long as 1 >= c^2.
    if abs(c) > 1 or max(c, 0) * q1 / q2 > (1 - c * c) * finger.natural_frequency**2:
        raise InvalidInputError(
            "finger", expected="one for which the damping of the pair is proved", got=finger
        )
    peak = 1 + exp(-pi / sqrt(3))
    return -log(1 - (1 - band) / peak) / sqrt(q1 / q2)


def settling_at_the_bound(weights: Weights, band: float) -> float:
    """Return the settling time for p to infinity, where the pole at its bound alone is left, s.

    >>> round(settling_at_the_bound(Weights(), 0.02), 2)
    2.14
    """
    q1, q2 = _weights_of_the_proof(weights)
    return log(1 / band) / sqrt(q1 / q2)


def _cubic(finger: SecondOrder, weights: Weights) -> tuple[float, float, float, float]:
    """Return the coefficients of ``-phi(s) phi(-s)`` in z = s^2, highest first."""
    w, ratio = finger.natural_frequency, weights.p / weights.R
    q1, q2, q3 = weights.q
    middle = (2 - 4 * finger.damping_ratio**2) * w**2
    return 1.0, middle - ratio * q3, w**4 + ratio * q2, -ratio * q1


def _weights_of_the_proof(weights: Weights) -> tuple[float, float]:
    q1, q2, q3 = weights.q
    if q3 or not q2 > 0:
        raise InvalidInputError("weights", expected="q_2 > 0 and q_3 = 0", got=weights)
    return q1, q2
