"""Contacts of the pad: what its elements said, and what touched it."""

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, floats, read_only
from softgrip.errors import InvalidInputError

ELEMENTS = 8
"""Elements of the pad (Section 2.2)."""
KINDS = ("point", "line", "surface")
"""Contact features, in the order of Eq. (2.4)."""
Strings = NDArray[np.str_]


def check_responses(responses: ArrayLike, elements: int = ELEMENTS) -> Floats:
    """Return responses of the elements as floats; Eq. (2.3).

    Args:
        responses: Normalised, 0 to 1, shape (..., elements).
        elements: How many there are.

    Raises:
        InvalidInputError: If the number of channels is another, or a value is not between 0 and 1.
    """
    (found,) = floats(responses=responses)
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
    """N contacts, and what is known of them.

    Attributes:
        responses: Of the elements, normalised: 0 at rest, 1 at full range, shape (N, 8); V of Eq.
            (2.3).
        layer: Voltage of the force layer, V, shape (N,).
        times: When they were felt, s, shape (N,).
        kinds: "point", "line" or "surface", shape (N,); empty where it is not known.
        objects: Names of what touched, shape (N,).
        places: Middle of the contact from the middle of the pad, m, shape (N, 2).
        angles: Of a line against the pad's length, rad, -pi/2 to pi/2, shape (N,); NaN unless a
            line.
        forces: Contact force, N, > 0, shape (N,). Places, angles and forces are all NaN for
            contacts of a pad that nobody knows the truth of.

    Raises:
        InvalidInputError: If a shape, kind or number is not as said.
    """

    responses: Floats
    layer: Floats
    times: Floats
    kinds: Strings
    objects: Strings
    places: Floats
    angles: Floats
    forces: Floats

    def __post_init__(self) -> None:
        n = len(check_responses(self.responses))
        width = {"responses": (ELEMENTS,), "places": (2,)}
        for one in fields(self):
            given = getattr(self, one.name)
            words = one.name in ("kinds", "objects")
            value = np.asarray(given, dtype=str) if words else read_only(given)
            shape = (n, *width.get(one.name, ()))
            if value.shape != shape:
                raise InvalidInputError(one.name, expected=f"shape {shape}", got=value.shape)
            object.__setattr__(self, one.name, value)
        kinds, places, angles, forces = self.kinds, self.places, self.angles, self.forces
        if unknown := sorted(set(kinds.tolist()) - {*KINDS, ""}):
            raise InvalidInputError("kinds", expected=f"each one of {KINDS}, or ''", got=unknown)
        if np.isnan(places).all() and np.isnan(angles).all() and np.isnan(forces).all():
            return
        if not np.isfinite(places).all():
            raise InvalidInputError("places", expected="finite numbers", got="NaN or infinity")
        if not ((forces > 0) & np.isfinite(forces)).all():
            raise InvalidInputError("forces", expected="finite numbers > 0", got=forces.min())
        line = kinds == "line"
        if not (np.abs(angles[line]) <= np.pi / 2).all() or not np.isnan(angles[~line]).all():
            raise InvalidInputError(
                "angles", expected="-pi/2 to pi/2 for lines, NaN for others", got=angles.tolist()
            )

    def __len__(self) -> int:
        return len(self.responses)

    def take(self, chosen: ArrayLike) -> Self:
        """Return some of the contacts, chosen as by an index of NumPy (a mask, or numbers)."""
        index = np.asarray(chosen)
        return type(self)(**{one.name: getattr(self, one.name)[index] for one in fields(self)})
