"""Figures that the dissertation has and this book has not, and why."""

from dataclasses import dataclass
from typing import Any

from book.companion.markdown import in_static_book
from book.companion.show import ROLE
from softgrip.errors import UnknownNameError

COUNT = {1: 1, 2: 14, 3: 12, 4: 7, 5: 7, 6: 8}
"""Figures of each chapter of the dissertation that has any."""
NUMBERS = tuple(f"{chapter}.{k + 1}" for chapter, count in COUNT.items() for k in range(count))

ABSENT = {
    "3.7": "it shows the two moulds, the parts that come out of them, and the finished finger. "
    "The text gives none of their shapes beyond what {numref}`fig-3-1` has.",
    "6.2 (a)": "it shows a search in a landscape, whose shape is not printed; {numref}`tab-3-a` "
    "and {numref}`fig-3-b` are that search, done here.",
    "6.2 (b)": "it shows how a finger is cast, in moulds whose shapes are not printed.",
    "6.2 (c)": "it shows how the pump looks; {numref}`fig-4-1` has its parts.",
}
"""Why a figure, or a panel of one, is not drawn: its content is not in the text."""


@dataclass(frozen=True)
class Absent:
    """What stands in the place of a figure that is not there."""

    numbers: tuple[str, ...]

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        said = (f"*Figure {number} is not drawn:* {ABSENT[number]}" for number in self.numbers)
        text = "\n\n".join(said)
        return {"text/markdown": text if in_static_book() else ROLE.sub(r"\1", text)}


def absent(figure: str) -> Absent:
    """Say that a figure, or some panels of it, are not here, and why.

    Args:
        figure: Such as ``Figure 3.7``.

    Raises:
        UnknownNameError: If nothing of it is absent; the message lists what is.

    >>> absent("Figure 6.2").numbers
    ('6.2 (a)', '6.2 (b)', '6.2 (c)')
    """
    number = figure.removeprefix("Figure ")
    found = tuple(name for name in ABSENT if name.split(" ")[0] == number)
    if not found:
        raise UnknownNameError("absent figure", figure, [f"Figure {name}" for name in ABSENT])
    return Absent(found)
