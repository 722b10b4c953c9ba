"""The plane of two fingers' angles: what one pump reaches in it, at each frequency.

One command that swings at a frequency gives angles that are multiples of one column, q of length
one, by complex numbers: their sizes and phases are the command's. With ``q = u + j v``, and a
target that both fingers shall follow in step, ``d cos(wt)``, the nearest such angles are
``Re(q q* d exp(jwt))``, which is ``in_step d cos(wt) - quarter_late d sin(wt)``:

* ``in_step = u u' + v v'``, symmetric, with eigenvalues l >= 1/2 and 1 - l. It takes the target at
  its largest to the angles of that moment. At rest l is 1, and it drops a perpendicular onto the
  line along q.
* ``quarter_late = v u' - u v'``, what both fingers do when the target passes through zero.

So the angles go round an ellipse. Its long axis is what is left of the line; it turns with the
frequency, by half the angle of ``(2 in_step_12, in_step_11 - in_step_22)``.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Number
from softgrip.gripper.plant import Gripper


@dataclass(frozen=True)
class InPlane:
    """Where one pump takes two fingers at a frequency.

    Attributes:
        first, second, mixed: Entries 11, 22 and 12 of ``in_step``.
        late: Entry 12 of ``quarter_late``, which has its negative at 21 and else zeros.
    """

    first: Number
    second: Number
    mixed: Number
    late: Number

    @property
    def turned(self) -> Number:
        """Angle of the line from the axis of the first finger, rad."""
        return np.arctan2(2 * self.mixed, self.first - self.second) / 2

    def foot(self, target: tuple[Number, Number]) -> tuple[Number, Number]:
        """Return the nearest angles at the moment at which the target is largest."""
        a, b = target
        return self.first * a + self.mixed * b, self.mixed * a + self.second * b

    def path(self, target: tuple[Number, Number], phase: Number) -> tuple[Number, Number]:
        """Return the nearest angles at phases of the target, rad: an ellipse through the foot."""
        (x, y), (a, b) = self.foot(target), target
        cos, sin = np.cos(phase), np.sin(phase)
        return x * cos - self.late * b * sin, y * cos + self.late * a * sin

    def missed(self, target: tuple[Number, Number]) -> Number:
        """Return the share of the target's length that no command gives, 0 to 1."""
        (x, y), (a, b) = self.foot(target), target
        # Rounding can leave a negative number of nothing.
        return np.sqrt(np.maximum(0, 1 - (a * x + b * y) / (a**2 + b**2)))


def in_plane(gripper: Gripper, frequency: Number) -> InPlane:
    """Return what one pump reaches with two fingers at a frequency, rad/s.

    The integrator of the pump turns and scales both angles alike, and is left out.

    >>> from softgrip.gripper.plant import PRINTED
    >>> round(float(np.degrees(in_plane(PRINTED, 0.0).turned)), 1)
    49.7
    """
    u, v = [], []
    for finger in gripper.fingers:
        real, imaginary = finger.stiffness - frequency**2, finger.damping * frequency
        size = real**2 + imaginary**2
        u.append(finger.gain * real / size)
        v.append(-finger.gain * imaginary / size)
    (u1, u2), (v1, v2) = u, v
    first, second = u1**2 + v1**2, u2**2 + v2**2
    whole = first + second
    return InPlane(
        first / whole, second / whole, (u1 * u2 + v1 * v2) / whole, (v1 * u2 - u1 * v2) / whole
    )
