"""What a finger weighs and how much room it takes: rubber, air and the box around both.

The chambers of Figure 3.1 lie in a row between two caps, with grooves between them, as
`finger_mesh.FingerShape` has them; a duct joins them, and leads out through the first cap. The
functions run on floats, on arrays of one shape and on CasADi symbols.

What grows with what is the ground of `limits_certificate`, for sections that hold the duct:

- rubber grows with a, b, w and t: each adds rubber, and what a wall gains the air loses;
- the outer box grows with a, b and w, and does not know t;
- air grows with a and w, falls with t, and does not know b.
"""

from dataclasses import dataclass

from softgrip.actuator.section import Section, chamber_area
from softgrip.arrays import Number, check_positive
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.units import MM

CHAMBERS = 6
"""Of the printed finger (Section 6.3)."""
PITCH = 15.5 * MM
"""From a chamber to the next: six of them make the printed 94 mm, less 1 mm (`length_of`)."""


@dataclass(frozen=True)
class Layout:
    """A finger along its length, m. Only the length and the number are printed, as `FingerShape`.

    Attributes:
        chambers: N, at least 1.
        length: L.
        cap: Of the solid ends, more than nothing (assumed).
        groove: Width of the gap between the walls of two chambers (assumed).
        groove_floor: Height of its bottom above the neutral surface (assumed): above the duct.
        duct: Width and height of the duct, on the neutral surface (assumed).

    Raises:
        InvalidInputError: If a size is out of its range.
    """

    chambers: int = CHAMBERS
    length: Number = 94 * MM
    cap: float = 3 * MM
    groove: float = 2 * MM
    groove_floor: float = 7 * MM
    duct: float = 4 * MM

    def __post_init__(self) -> None:
        if not (isinstance(self.chambers, int) and self.chambers >= 1):
            raise InvalidInputError("chambers", expected="at least 1", got=self.chambers)
        check_positive(length=self.length, cap=self.cap)
        check_not_negative(groove=self.groove, duct=self.duct, groove_floor=self.groove_floor)

    def divider(self, wall: Number) -> Number:
        """Return the distance between two chambers, wall, groove and wall, m."""
        return self.groove + 2 * wall

    def air_length(self, wall: Number) -> Number:
        """Return the length of all chambers together, m."""
        return self.length - 2 * self.cap - (self.chambers - 1) * self.divider(wall)


def length_of(chambers: int, pitch: float = PITCH) -> float:
    """Return the length of a finger with so many chambers of the printed one's size, m.

    >>> round(length_of(6), 4)
    0.094
    """
    return chambers * pitch + 1 * MM


def layout_of(chambers: int) -> Layout:
    """Return the layout of a finger with so many chambers of the printed one's size."""
    return Layout(chambers, length_of(chambers))


def check_layout(layout: Layout, section: Section) -> None:
    """Raise InvalidInputError unless caps, walls and grooves leave room for chambers and duct."""
    if not layout.air_length(section.wall) > 0:
        raise InvalidInputError(
            "length",
            expected=f"room for {layout.chambers} chambers between their walls",
            got=layout.length,
        )
    inside = min(section.top - section.wall, section.width - 2 * section.wall)
    if not layout.duct <= inside:
        raise InvalidInputError(
            "duct", expected=f"at most the chamber, {inside:g} m", got=layout.duct
        )
    if layout.chambers > 1 and not (layout.duct < layout.groove_floor < section.top - section.wall):
        raise InvalidInputError(
            "groove_floor",
            expected=f"above the duct, {layout.duct:g} m, and below the chamber's roof, "
            f"{section.top - section.wall:g} m",
            got=layout.groove_floor,
        )


def air_volume(section: Section, layout: Layout) -> Number:
    """Return the air in chambers and duct at rest, m^3.

    >>> design_1 = Section(0.020, 0.004, 0.030, 0.0015)
    >>> round(air_volume(design_1, Layout()) * 1e6, 1)  # mL
    31.9
    """
    through = layout.length - layout.cap - layout.air_length(section.wall)
    return chamber_area(section) * layout.air_length(section.wall) + layout.duct**2 * through


def groove_volume(section: Section, layout: Layout) -> Number:
    """Return what is cut out between the chambers, m^3."""
    deep = section.top - layout.groove_floor
    return (layout.chambers - 1) * layout.groove * section.width * deep


def envelope(section: Section, layout: Layout) -> Number:
    """Return the volume of the box around the finger at rest, ``w (a + b) L``, m^3.

    >>> round(envelope(Section(0.020, 0.004, 0.030, 0.0015), Layout()) * 1e6, 2)
    67.68
    """
    return section.width * section.height * layout.length


def rubber_volume(section: Section, layout: Layout) -> Number:
    """Return the rubber, m^3: the box without grooves and air. It is what a mould holds."""
    outside = envelope(section, layout) - groove_volume(section, layout)
    return outside - air_volume(section, layout)


def finger_mass(section: Section, layout: Layout, density: Number) -> Number:
    """Return the mass of the rubber, kg, for its density [kg/m^3].

    More than `frequency.rubber_mass`, which counts the wall alone.

    >>> round(finger_mass(Section(0.020, 0.004, 0.030, 0.0015), Layout(), 1080.0), 4)
    0.0344
    """
    return density * rubber_volume(section, layout)
