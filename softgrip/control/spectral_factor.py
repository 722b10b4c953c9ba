"""The gain of `lqr.lqr_gain` without a Riccati equation: for symbols too, where `lqr_gain` is not.

With one input the regulator is a spectral factor: the polynomial d of its closed loop is the stable
one with ``d(s) d(-s) = a(s) a(-s) + (p / R) (q_1 - q_2 s^2 + q_3 s^4)``, where a is that of the
plant. (Kalman 1964, "When is a linear control system optimal?".)
"""

import numpy as np

from softgrip.arrays import Number

ITERATIONS = 12
"""Newton steps, which are enough for a p from 1 to 10^6: beyond them the last bits change."""


def spectral_gain(
    damping: Number, stiffness: Number, p: Number, q: tuple[Number, Number, Number]
) -> list[Number]:
    """Return K of ``u = -K x``, as `lqr.lqr_gain`, for a pump with a finger.

    The plant is ``1 / (s (s**2 + damping s + stiffness))``. All may be symbols, or
    arrays that broadcast.

    Args:
        damping, stiffness: 1/s, >= 0, and 1/s^2, > 0.
        p: Common factor of the weights over R, > 0.
        q: Weights of the three states: the first > 0, the others >= 0.

    >>> [round(float(k), 3) for k in spectral_gain(2 * 0.7 * 2.86, 2.86**2, 100.0, (1.0, 0.3, 0.0))]
    [10.0, 6.07, 1.304]
    """
    # d = s^3 + d_2 s^2 + d_1 s + d_0. By powers of s: d_0^2 = p q_1, d_2^2 = c + 2 d_1 and
    # d_1^2 = e + 2 d_0 d_2, in which d_2 is put: one equation for d_1, convex right of its root.
    d_0 = np.sqrt(p * q[0])
    c, e = damping**2 - 2 * stiffness + p * q[2], stiffness**2 + p * q[1]
    # Beyond the root, whatever the weights; from there Newton's steps come down to it.
    d_1 = np.sqrt(e) + 2 * d_0 ** (2 / 3) + np.maximum(c, 0.0)
    for _ in range(ITERATIONS):
        d_2 = np.sqrt(c + 2 * d_1)
        d_1 = d_1 - (d_1**2 - e - 2 * d_0 * d_2) / (2 * d_1 - 2 * d_0 / d_2)
    return [d_0, d_1 - stiffness, np.sqrt(c + 2 * d_1) - damping]
