"""How well place and pose of a contact are found, against the truth of the simulated pad."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.simulator.pad import Pad, make_pad, press, voltages
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import angle_between, line_angle, moments, place
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.pad_layout import PadLayout


def responses_to(pad: Pad, forces: Floats) -> Floats:
    """Return the normalised responses, without noise, to forces on the elements, N, shape (8,)."""
    n, full = pad.parameters.layout.elements, 1.0  # a newton: beyond the range of any element
    rest, most, now = (voltages(pad, f)[:n] for f in (np.zeros(n), np.full(n, full), forces))
    found: Floats = np.clip((now - rest) / (most - rest), 0, 1)
    return found


def ideal_responses(name: str, pose: Pose, force: float) -> Floats:
    """Return what a pad whose elements are alike says of a smooth object, shape (8,)."""
    pad = make_pad(PadParameters())
    return responses_to(pad, press(pad, pad_object(name), pose, force))


@dataclass(frozen=True, eq=False)
class PlaceErrors:
    """Errors of contacts against their truth.

    Attributes
    ----------
    elements
        How many are felt, shape (N,).
    place
        Between estimate and truth, m, shape (N,): to the middle of a point or a surface, square to
        a line, as no end of it is seen. NaN if nothing is felt.
    angle
        Between a line and its estimate, rad, shape (N,); NaN unless a line is felt by two or more.
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
