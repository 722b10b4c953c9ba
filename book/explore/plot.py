"""What an explorer shows of a law: marks in panels, and a line of text above them.

A mark names what it takes from the law's result, or holds numbers of its own. The page draws it by
Observable Plot, so that curves are vectors, and take the colours of either scheme.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from book.companion.style import BLACK, BLUE, GREY

From = str | float | Sequence[float]
"""A name in the law's result, or the numbers themselves."""


@dataclass(frozen=True)
class Line:
    """A curve.

    Attributes:
        x, y: Its points.
        label: In the legend; none without.
        colour, width: Of the stroke.
        dash: Lengths of dashes and gaps, as in SVG.
        step: Whether a value holds until the next.
    """

    x: From
    y: From
    label: str = ""
    colour: str = BLUE
    dash: str = ""
    width: float = 2.0
    step: bool = False
    kind: str = field(default="line", init=False)


@dataclass(frozen=True)
class Band:
    """What lies between two curves, or, with `x` an empty word, two levels across the panel."""

    low: From
    high: From
    x: From = ""
    label: str = ""
    colour: str = BLUE
    kind: str = field(default="band", init=False)


@dataclass(frozen=True)
class Span:
    """What lies between two values of x, from bottom to top."""

    low: From
    high: From
    label: str = ""
    colour: str = BLUE
    kind: str = field(default="span", init=False)


@dataclass(frozen=True)
class Level:
    """A straight line across the panel, at a value of ``x`` or ``y``."""

    at: From
    axis: str = "y"
    label: str = ""
    colour: str = GREY
    dash: str = "2 3"
    width: float = 1.2
    kind: str = field(default="level", init=False)


@dataclass(frozen=True)
class Outline:
    """A closed shape, filled or not.

    Attributes:
        x, y: Its corners.
        mirrored: Whether they are its right half, which is the same on the left of 0.
        fill: How opaque, 0 to 1.
    """

    x: From
    y: From
    label: str = ""
    colour: str = BLUE
    dash: str = ""
    fill: float = 0.15
    mirrored: bool = False
    kind: str = field(default="outline", init=False)


@dataclass(frozen=True)
class Bent:
    """A shape along a finger, bent to an arc with it; it moves if the angle does.

    The finger leaves the origin along the x axis and bends downwards, or hangs down.

    Attributes:
        x, y: Corners on the straight finger: along it from its base, and above its neutral
            surface, mm.
        angle: By which its tip turns, in degrees if multiplied by `times`: one number, or one for
            each of `time`.
        length: Of the finger, mm.
        time: Seconds; the last is shown until the reader has it played.
        hanging: Where it hangs on the x axis, mm, and bends to the left; None for one that lies.
        mirrored: Whether it bends to the other side.
    """

    x: From
    y: From
    angle: From
    length: From
    time: From = ""
    times: From = 1.0
    label: str = ""
    colour: str = BLUE
    hanging: float | None = None
    mirrored: bool = False
    kind: str = field(default="bent", init=False)


@dataclass(frozen=True)
class Dimension:
    """A line with a head at both ends, and a letter in its middle.

    Attributes:
        x, y: Of both ends; one number where they have the same.
        text: The letter.
    """

    x: From
    y: From
    text: str
    label: str = ""
    colour: str = BLACK
    kind: str = field(default="dimension", init=False)


@dataclass(frozen=True)
class Dots:
    """Points; `x` may be numbers and `y` words, in the order of the axis."""

    x: From
    y: From | Sequence[str]
    label: str = ""
    colour: str = BLACK
    radius: float = 3.5
    kind: str = field(default="dots", init=False)


@dataclass(frozen=True)
class Bars:
    """Bars from zero to the right, one a name.

    Attributes:
        x: Their lengths.
        names: Of the bars.
        marked: Which of them have the colour, 0 or 1 each; the others have `other`.
    """

    x: From
    names: Sequence[str]
    marked: From
    colour: str = BLUE
    other: str = GREY
    label: str = ""
    kind: str = field(default="bars", init=False)


Mark = Line | Band | Span | Level | Outline | Bent | Dimension | Dots | Bars
TAKEN = (
    "x", "y", "low", "high", "at", "marked", "angle", "length", "time", "times",
)  # fmt: skip
"""Fields of marks that may name what a law returns."""


@dataclass(frozen=True)
class Panel:
    """Marks on two axes that stay where they are.

    Attributes:
        marks: From the back to the front.
        x, y: Ends of the axes, numbers or names in the law's result; words for an axis of names.
        x_label, y_label: With units.
        height: Pixels at full width.
        share: Of the figure's width, beside other panels.
        equal: Whether a unit is as long on both axes; the height then follows.
        bare: Whether it is a picture, without axes; on a telephone it is as wide as tall.
        left: Room for the labels on the left, pixels.
        title: As `Plot.title`.
    """

    marks: Sequence[Mark]
    x: Sequence[float | str]
    y: Sequence[float | str]
    x_label: str = ""
    y_label: str = ""
    height: int = 300
    share: float = 1.0
    equal: bool = False
    bare: bool = False
    left: int = 48
    title: str = ""


@dataclass(frozen=True)
class Plot:
    """All that is shown.

    Attributes:
        panels: Side by side, where there is room.
        title: Text with numbers of the law, written as for `str.format`: ``{settled:.2f}``.
        cases: Titles with the name of a number before: that of the first which is not 0 is taken,
            `title` if all are.
    """

    panels: Sequence[Panel]
    title: str = ""
    cases: Sequence[tuple[str, str]] = ()

    def names(self) -> set[str]:
        """Return what it takes from the law."""
        taken = {name for name, _ in self.cases}
        for panel in self.panels:
            for mark in panel.marks:
                taken |= {
                    value
                    for key, value in vars(mark).items()
                    if key in TAKEN and isinstance(value, str)
                }
        return taken - {""}

    def data(self) -> dict[str, Any]:
        """Return it as the page's script takes it."""
        return asdict(self)
