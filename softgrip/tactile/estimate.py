"""What the pad says of contacts: kind, place, angle and force, by the models of Chapter 2."""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_pose import line_angle, moments
from softgrip.tactile.contacts import Contacts, Strings
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_layout import THREE_TWO_THREE, PadLayout
from softgrip.tactile.pad_model import PadModel

NOTHING = "nothing"
"""The kind of a contact that no element feels."""


@dataclass(frozen=True, eq=False)
class Estimate:
    """What is told of N contacts.

    Attributes:
        kinds: Shape (N,); `NOTHING` where no element feels anything.
        places: m from the middle of the pad, shape (N, 2); NaN where nothing is felt.
        angles: rad, shape (N,); NaN unless the kind is "line" and two elements or more feel it.
        forces: N, shape (N,); NaN without a model of the force layer.
    """

    kinds: Strings
    places: Floats
    angles: Floats
    forces: Floats


def kind_readings(contacts: Contacts) -> PadReadings:
    """Return the contacts whose kind is known, for a `PadModel` with `KindSettings`.

    Raises:
        InvalidInputError: If none is.
    """
    known = contacts.take(contacts.kinds != "")
    if not len(known):
        raise InvalidInputError(
            "contacts", expected="some of a known kind, such as 'line: carrot'", got="none"
        )
    channels = tuple(f"element_{k + 1}" for k in range(known.responses.shape[1]))
    return PadReadings(channels, known.responses, known.kinds)


def estimate(
    contacts: Contacts,
    kind: PadModel,
    force: PadModel | None = None,
    *,
    layout: PadLayout = THREE_TWO_THREE,
) -> Estimate:
    """Tell kind, place, angle and force of contacts from responses and force layer alone.

    Args:
        contacts: What is known of them is not looked at.
        kind: Fitted to `kind_readings`, of this pad or of another one.
        force: Fitted to known weights on this pad, `softgrip.logs.contacts.read_weights`; None if
            none were put on it.
        layout: Where the elements lie.

    Raises:
        sklearn.exceptions.NotFittedError: If a model is not fitted.
        InvalidInputError: If a model is of another pad's channels.
    """
    found = moments(contacts.responses, layout)
    kinds = np.where(found.elements > 0, kind.predict(contacts.responses), NOTHING)
    angles = np.where(kinds == "line", line_angle(contacts.responses, layout), np.nan)
    forces: Floats = np.full(len(contacts), np.nan)
    if force is not None:
        forces = np.asarray(force.predict(contacts.layer[:, None]), dtype=np.float64)
    return Estimate(kinds, found.middle, angles, forces)
