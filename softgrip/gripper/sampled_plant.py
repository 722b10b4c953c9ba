"""The exact motion of fingers under a held command, for a batch of them, in closed form."""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats, check_positive


@dataclass(frozen=True)
class HeldMotion:
    """What a hold makes of the state (angle, rate, pump, command) at its start.

    The pump is the integral of the command, as in `plant.state_space`.

    Attributes:
        angle: Rows that give the angle after 1, 2, ... steps, shape (..., 4, points).
        rate: Row that gives the rate at the end, shape (..., 4).
    """

    angle: Floats
    rate: Floats


def held_motion(
    damping: Floats, stiffness: Floats, gain: Floats, step: float, points: int
) -> HeldMotion:
    """Return the zero-order hold of a finger at equally spaced times within the hold.

    With b the impulse response of ``s**2 + damping s + stiffness``, all else follows from b and its
    rate: the integral of b from the differential equation integrated once, that of the integral
    from the one integrated twice.

    Args:
        damping, stiffness, gain: As of `FingerDynamics`, > 0, arrays of one shape.
        step: Time between two points, s, > 0.
        points: How many, >= 1; the hold ends at the last. Twice as many have twice the rounding
            error: 100 are good to about 1e-12 rad per unit of the command.

    >>> one = np.ones(1)
    >>> far = held_motion(one, one, one, step=50.0, points=1)  # at rest the angle follows the pump
    >>> far.angle[0, 2:, 0].round(6).tolist()
    [1.0, 49.0]
    """
    check_positive(step=step, points=points)
    c, k, g = (np.asarray(x)[..., None] for x in (damping, stiffness, gain))
    b, rate = (np.empty((*np.shape(damping), points)) for _ in range(2))
    b[..., :1], rate[..., :1] = _impulse(c, k, step)
    done = 1
    while done < points:  # twice as many each time: each time so far, and the last of them on top
        more = min(done, points - done)
        early, late = slice(more), slice(done, done + more)
        last_b, last_rate = b[..., done - 1, None], rate[..., done - 1, None]
        b[..., late] = (last_rate + c * last_b) * b[..., early] + last_b * rate[..., early]
        rate[..., late] = last_rate * rate[..., early] - k * last_b * b[..., early]
        done += more
    own = rate + c * b  # what is left of an angle of 1
    once = (1 - own) / k
    angle = np.empty((*np.shape(damping), 4, points))
    angle[..., 0, :], angle[..., 1, :], angle[..., 2, :] = own, b, g * once
    angle[..., 3, :] = (step * np.arange(1, points + 1) - b - c * once) * (g / k)
    end = np.stack([row[..., -1] for row in (-k * b, rate, g * b, g * once)], axis=-1)
    return HeldMotion(angle, end)


def _impulse(c: Floats, k: Floats, t: float) -> tuple[Floats, Floats]:
    """Return b and its rate at one time, for any damping."""
    z = t * np.sqrt(c**2 / 4 - k + 0j)
    critical = z == 0
    shrink = np.exp(-c * t / 2)
    sine = np.sinh(z) / np.where(critical, 1, z)
    b = shrink * t * np.where(critical, 1.0, sine.real)
    return b, shrink * np.cosh(z).real - c / 2 * b
