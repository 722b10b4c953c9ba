"""The pose of a line contact: the principal axis of the responses."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.tactile.contact_place import moments
from softgrip.tactile.pad_layout import PadLayout

ROUND = 1e-9
"""Part of their sum below which the difference of both principal moments says no direction."""


def line_angle(responses: ArrayLike, layout: PadLayout) -> Floats:
    """Return the angle of a line against the pad's length, rad, -pi/2 to pi/2.

    With two elements it is that of their connection, whatever their responses: a line that is felt
    by two has one of few angles.

    Parameters
    ----------
    responses
        Normalised, 0 to 1, shape (..., elements); those up to `contact_place.FELT` count as none.
    layout
        Of the pad.

    Returns
    -------
    Floats
        Shape (...); NaN where less than two elements are felt, or no direction is longer.

    Raises
    ------
    InvalidInputError
        If the number of channels is not the layout's, or a response is not between 0 and 1.

    Examples
    --------
    >>> from softgrip.tactile.pad_layout import THREE_TWO_THREE
    >>> float(line_angle([0.3, 0.5, 0.2, 0, 0, 0, 0, 0], THREE_TWO_THREE))
    0.0
    >>> float(line_angle([1, 0, 0, 0, 0, 0, 0, 0], THREE_TWO_THREE))
    nan
    """
    elements, _, spread = moments(responses, layout)
    difference, cross = spread[..., 0, 0] - spread[..., 1, 1], 2 * spread[..., 0, 1]
    total = spread[..., 0, 0] + spread[..., 1, 1]
    told = (elements >= 2) & (np.hypot(difference, cross) > ROUND * total)
    found: Floats = np.where(told, np.arctan2(cross, difference) / 2, np.nan)
    return found


def angle_between(one: ArrayLike, other: ArrayLike) -> Floats:
    """Return the angle between lines, rad, 0 to pi/2: a line has no direction.

    Examples
    --------
    >>> from math import pi
    >>> round(float(angle_between(0.45 * pi, -0.45 * pi)) / pi, 9)
    0.1
    """
    turned = np.abs(np.asarray(one) - np.asarray(other)) % np.pi
    found: Floats = np.minimum(turned, np.pi - turned)
    return found
