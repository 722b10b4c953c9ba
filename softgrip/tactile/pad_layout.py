"""Where the eight elements of the pad lie (Section 2.2)."""

from dataclasses import dataclass, field

import numpy as np

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError
from softgrip.units import MM

PAD_SIZE = (40 * MM, 38 * MM)
"""Length and width of the pad, m (Section 2.2)."""
ELEMENT_SIDE = 6 * MM
"""Side of the square base of an element, m (Section 2.2)."""


@dataclass(frozen=True)
class PadLayout:
    """Places of the elements, from the middle of the pad.

    Attributes:
        places: Middles of the elements, m, shape (n, 2): along the length, along the width.

    Raises:
        InvalidInputError: If these are not two or more distinct finite places that leave room
            between the elements.
    """

    places: Floats = field(repr=False)

    def __post_init__(self) -> None:
        places = read_only(self.places)
        if places.ndim != 2 or places.shape[1] != 2 or len(places) < 2:
            raise InvalidInputError("places", expected="shape (n >= 2, 2)", got=places.shape)
        apart = np.abs(places[:, None] - places[None]).max(axis=-1)
        np.fill_diagonal(apart, np.inf)
        if not (np.isfinite(places).all() and (apart > ELEMENT_SIDE).all()):
            raise InvalidInputError(
                "places",
                expected=f"finite numbers, elements of {ELEMENT_SIDE / MM:g} mm that do not touch",
                got=places.tolist(),
            )
        object.__setattr__(self, "places", places)

    @property
    def elements(self) -> int:
        """Number of elements."""
        return len(self.places)


def rows(counts: tuple[int, ...], pitch: float, row_pitch: float) -> PadLayout:
    """Return a layout of rows, each about the middle, that of the largest width first.

    Args:
        counts: Elements of each row.
        pitch, row_pitch: Between neighbours in a row, and between rows, m.

    >>> (rows((2, 1), 0.010, 0.008).places / MM).tolist()
    [[-5.0, 4.0], [5.0, 4.0], [0.0, -4.0]]
    """
    middle = (len(counts) - 1) / 2
    return PadLayout(
        np.array(
            [
                ((k - (count - 1) / 2) * pitch, (middle - row) * row_pitch)
                for row, count in enumerate(counts)
                for k in range(count)
            ]
        )
    )


THREE_TWO_THREE = rows((3, 2, 3), 11 * MM, 10 * MM)
"""The layout that is used here. The dissertation prints no places: three rows that fill the pad
are assumed, the middle one set off, so that no line passes between all elements."""
