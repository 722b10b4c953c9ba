"""Where the pad is touched, and at what angle: centroid and principal axis of its responses.

Section 2.3 says that both are estimated, not how, nor how well.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats
from softgrip.tactile.contacts import Contacts, check_responses
from softgrip.tactile.pad_layout import PadLayout

FELT = 0.05
"""Responses up to here count as none: some ten steps of a converter of 10 bits, so that an hour
of drift is not taken for a touch."""


class Moments(NamedTuple):
    """Moments of the responses that are felt.

    Attributes:
        elements: How many are felt, shape (...).
        middle: Centroid, m, shape (..., 2); NaN if none is felt.
        spread: Second moments about it, m^2, shape (..., 2, 2).
    """

    elements: NDArray[np.intp]
    middle: Floats
    spread: Floats


def moments(responses: ArrayLike, layout: PadLayout) -> Moments:
    """Return the moments of responses; arguments as for `place`."""
    found = check_responses(responses, layout.elements)
    weight = np.where(found > FELT, found, 0.0)
    total = weight.sum(axis=-1, keepdims=True)
    share = np.divide(weight, total, out=np.full_like(weight, np.nan), where=total > 0)
    middle = share @ layout.places
    away = layout.places - middle[..., None, :]
    spread = np.einsum("...k,...ki,...kj->...ij", share, away, away)
    return Moments((weight > 0).sum(axis=-1), middle, spread)


def place(responses: ArrayLike, layout: PadLayout) -> Floats:
    """Return where the pad is touched, m from its middle.

    Args:
        responses: Normalised, 0 to 1, shape (..., elements); those up to `FELT` count as none.
        layout: Of the pad.

    Returns:
        Floats: Shape (..., 2), within the hull of the elements; NaN where nothing is felt.

    Raises:
        InvalidInputError: If the number of channels is not the layout's, or a response is not
            between 0 and 1.

    Twice as strong on the right one of two elements that are 11 mm apart:

    >>> from softgrip.tactile.pad_layout import THREE_TWO_THREE
    >>> place([0, 0, 0, 0.2, 0.4, 0, 0, 0], THREE_TWO_THREE).round(5).tolist()
    [0.00183, 0.0]
    """
    return moments(responses, layout).middle


ROUND = 1e-9
"""Part of their sum below which the difference of both principal moments says no direction."""


def line_angle(responses: ArrayLike, layout: PadLayout) -> Floats:
    """Return the angle of a line against the pad's length, rad, -pi/2 to pi/2.

    With two elements it is that of their connection, whatever their responses: a line that is felt
    by two has one of few angles.

    Args:
        responses: Normalised, 0 to 1, shape (..., elements); those up to `FELT` count as none.
        layout: Of the pad.

    Returns:
        Floats: Shape (...); NaN where less than two elements are felt, or no direction is longer.

    Raises:
        InvalidInputError: If the number of channels is not the layout's, or a response is not
            between 0 and 1.

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

    >>> from math import pi
    >>> round(float(angle_between(0.45 * pi, -0.45 * pi)) / pi, 9)
    0.1
    """
    turned = np.abs(np.asarray(one) - np.asarray(other)) % np.pi
    found: Floats = np.minimum(turned, np.pi - turned)
    return found


@dataclass(frozen=True, eq=False)
class PlaceErrors:
    """Errors of contacts against their truth.

    Attributes:
        elements: How many are felt, shape (N,).
        place: Between estimate and truth, m, shape (N,): to the middle of a point or a surface,
            square to a line, as no end of it is seen. NaN if nothing is felt.
        angle: Between a line and its estimate, rad, shape (N,); NaN unless a line is felt by two or
            more.
    """

    elements: NDArray[np.intp]
    place: Floats
    angle: Floats


def place_errors(contacts: Contacts, layout: PadLayout) -> PlaceErrors:
    """Return the errors of place and angle."""
    away = place(contacts.responses, layout) - contacts.places
    # For what is no line the angle is NaN, and this not used.
    square = np.cos(contacts.angles) * away[:, 1] - np.sin(contacts.angles) * away[:, 0]
    line = contacts.kinds == "line"
    return PlaceErrors(
        moments(contacts.responses, layout).elements,
        np.where(line, np.abs(square), np.hypot(*away.T)),
        angle_between(line_angle(contacts.responses, layout), contacts.angles),
    )
