"""Contacts of the pad: what its elements said, and what touched it."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError

ELEMENTS = 8
"""Elements of the pad (Section 2.2)."""
KINDS = ("point", "line", "surface")
"""Contact features, in the order of Eq. (2.4)."""
Strings = NDArray[np.str_]


def check_responses(responses: ArrayLike, elements: int = ELEMENTS) -> Floats:
    """Return responses of the elements as floats; Eq. (2.3).

    Parameters
    ----------
    responses
        Normalised, 0 to 1, shape (..., elements).
    elements
        How many there are.

    Raises
    ------
    InvalidInputError
        If the number of channels is another, or a value is not between 0 and 1.
    """
    found = np.asarray(responses, dtype=np.float64)
    if found.ndim < 1 or found.shape[-1] != elements:
        raise InvalidInputError(
            "responses", expected=f"{elements} channels, shape (..., {elements})", got=found.shape
        )
    bad = ~((found >= 0) & (found <= 1))
    if bad.any():
        raise InvalidInputError(
            "responses", expected="numbers between 0 and 1", got=float(found[bad][0])
        )
    return found


@dataclass(frozen=True, eq=False)
class Contacts:
    """N contacts with their truth.

    Attributes
    ----------
    responses
        Of the elements, normalised: 0 at rest, 1 at full range, shape (N, 8); V of Eq. (2.3).
    kinds
        "point", "line" or "surface", shape (N,).
    objects
        Names of what touched, shape (N,).
    places
        Middle of the contact from the middle of the pad, m, shape (N, 2).
    angles
        Of a line against the pad's length, rad, -pi/2 to pi/2, shape (N,); NaN unless a line.
    forces
        Contact force, N, > 0, shape (N,).

    Raises
    ------
    InvalidInputError
        If a shape, kind or number is not as said.
    """

    responses: Floats
    kinds: Strings
    objects: Strings
    places: Floats
    angles: Floats
    forces: Floats

    def __post_init__(self) -> None:
        responses = read_only(check_responses(self.responses))
        n = len(responses)
        kinds, objects = np.asarray(self.kinds, dtype=str), np.asarray(self.objects, dtype=str)
        places, angles, forces = map(read_only, (self.places, self.angles, self.forces))
        shapes = {
            "responses": (responses.shape, (n, ELEMENTS)),
            "kinds": (kinds.shape, (n,)),
            "objects": (objects.shape, (n,)),
            "places": (places.shape, (n, 2)),
            "angles": (angles.shape, (n,)),
            "forces": (forces.shape, (n,)),
        }
        for name, (got, expected) in shapes.items():
            if got != expected:
                raise InvalidInputError(name, expected=f"shape {expected}", got=got)
        if unknown := sorted(set(kinds.tolist()) - set(KINDS)):
            raise InvalidInputError("kinds", expected=f"each one of {KINDS}", got=unknown)
        if not np.isfinite(places).all():
            raise InvalidInputError("places", expected="finite numbers", got="NaN or infinity")
        if not ((forces > 0) & np.isfinite(forces)).all():
            raise InvalidInputError("forces", expected="finite numbers > 0", got=forces.min())
        line = kinds == "line"
        if not (np.abs(angles[line]) <= np.pi / 2).all() or not np.isnan(angles[~line]).all():
            raise InvalidInputError(
                "angles", expected="-pi/2 to pi/2 for lines, NaN for others", got=angles.tolist()
            )
        found = (responses, kinds, objects, places, angles, forces)
        for name, value in zip(shapes, found, strict=True):
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.responses)

    def take(self, chosen: ArrayLike) -> Self:
        """Return some of the contacts, chosen as by an index of NumPy (a mask, or numbers)."""
        index = np.asarray(chosen)
        return type(self)(
            self.responses[index],
            self.kinds[index],
            self.objects[index],
            self.places[index],
            self.angles[index],
            self.forces[index],
        )
