"""Theorem 2 of Section 6.3 as checks of an input ``U = H P-dagger Y_d``."""

from dataclasses import dataclass
from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.gripper.inversion import LeftInverse, filtered_inverse
from softgrip.gripper.plant import Gripper, state_space

TRACKED = 1e-3
"""Relative error at rest that counts as tracked: the printed filters have four digits."""


@final
@dataclass(frozen=True)
class TheoremTwo:
    """The four conditions of Theorem 2 for a step of the target.

    Attributes:
        rational: 1: H is a real-rational function, and H P-dagger is proper.
        bounded: 2: the error stays bounded.
        final_error: Largest error at rest, rad.
        tracks: 3: the error is nearly 0 in the end.
        stable_input: 4: the input has all its poles in the open left half plane.
    """

    rational: bool
    bounded: bool
    final_error: float
    tracks: bool
    stable_input: bool

    @property
    def holds(self) -> bool:
        """Whether all four do."""
        return self.rational and self.bounded and self.tracks and self.stable_input


def check_theorem_2(
    gripper: Gripper, inverse: LeftInverse, low_pass: control.StateSpace, target: ArrayLike
) -> TheoremTwo:
    """Check the conditions for a step to target angles.

    The step's pole at 0 cancels in the input, since the inverse has a zero there: the pump moves
    and stops. So the input is stable if ``H P-dagger`` is, and the angles then are bounded.

    Args:
        gripper: The plant.
        inverse, low_pass: P-dagger and H.
        target: rad, shape (fingers,), not all 0.

    >>> from softgrip.gripper.inversion import mean_inverse
    >>> from softgrip.gripper.plant import PRINTED
    >>> from softgrip.gripper.reach import project
    >>> from softgrip.gripper.shaping_filter import low_pass
    >>> at = PRINTED, mean_inverse(PRINTED), low_pass(4.8)
    >>> check_theorem_2(*at, project(PRINTED, [1.0, 1.0]).reached).holds
    True
    >>> check_theorem_2(*at, [1.0, 1.0]).tracks
    False
    """
    wanted = np.asarray(target, dtype=np.float64)
    try:
        input_filter = filtered_inverse(inverse, low_pass)
    except InvalidInputError:
        return TheoremTwo(False, False, np.inf, False, False)
    stable = bool(np.all(input_filter.poles().real < 0) and final_gain(input_filter) < 1e-6)
    if not stable:
        return TheoremTwo(True, False, np.inf, False, False)
    reached = final_angles(gripper, inverse, low_pass, wanted)
    error = float(np.abs(reached - wanted).max())
    return TheoremTwo(True, True, error, error <= TRACKED * float(np.abs(wanted).max()), stable)


def final_gain(input_filter: control.StateSpace) -> float:
    """Return the largest gain at frequency 0 over that at the largest of its poles."""
    fast = 1j * float(np.abs(input_filter.poles()).max())
    low, high = np.abs(input_filter(0)), np.abs(input_filter(fast))
    return float(low.max() / high.max())


def final_angles(
    gripper: Gripper, inverse: LeftInverse, low_pass: control.StateSpace, target: ArrayLike
) -> Floats:
    """Return where a step of the target leaves the fingers, rad: ``P H P-dagger Y_d`` at s = 0.

    P has a pole at 0 and the inverse a zero, so the limit is taken from just beside it.
    """
    near = 1e-7
    row = inverse(near) * np.ravel(low_pass(near))
    column = np.ravel(state_space(gripper)(near))
    return np.asarray((column * (row @ np.asarray(target, dtype=np.float64))).real)
