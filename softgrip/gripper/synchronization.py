"""How far fingers are apart on their ways."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError


def synchronization_error(angles: ArrayLike, target: ArrayLike) -> Floats:
    """Return by how much the fingers are apart on their ways, rad, shape (..., N).

    Unequal fingers have unequal targets, so each angle counts as a share of its own: the largest
    share less the least, scaled by the mean target.

    Args:
        angles: rad, shape (..., fingers, N).
        target: rad, shape (fingers,), none 0.

    Raises:
        InvalidInputError: If the target has another shape, or holds a 0.

    >>> synchronization_error([[0.0, 0.4], [0.0, 0.6]], [0.8, 1.0]).round(3).tolist()
    [0.0, 0.09]
    """
    goal, moved = np.asarray(target, np.float64), np.asarray(angles, np.float64)
    if moved.ndim < 2 or goal.shape != moved.shape[-2:-1] or not goal.all():
        raise InvalidInputError(
            "target", expected=f"one angle other than 0 for each finger of {moved.shape}", got=goal
        )
    return np.asarray(np.ptp(moved / goal[:, None], axis=-2) * abs(goal.mean()))
