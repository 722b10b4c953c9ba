"""Numbers as people and programs write them: decimal signs, thousands, and cells without one."""

import re
from collections.abc import Iterable

import numpy as np

from softgrip.errors import SoftgripError

NOT_THERE = frozenset(("", "-", "--", "nan", "n/a", "#n/a", "na", "null", "none"))
"""Cells of what was not measured, in small letters."""

_BLANKS = " '\u2019\u00a0\u202f"
"""What may part thousands, whatever the decimal sign."""


def _pattern(decimal: str, thousands: str) -> re.Pattern[str]:
    groups = "|".join(rf"[1-9]\d{{0,2}}(?:[{sign}]\d{{3}})+" for sign in (thousands, _BLANKS))
    whole = rf"(?:\d+|{groups})(?:[{decimal}]\d*)?|[{decimal}]\d+"
    return re.compile(rf"[+\-\u2212]?(?:{whole})(?:[eE][+\-]?\d+)?", flags=re.ASCII)


_PLAIN = re.compile(r"[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?", flags=re.ASCII)
"""Most numbers: with a point as the decimal sign, they are what Python reads."""
_NUMBER = {".": _pattern(".", ","), ",": _pattern(",", ".")}
_THOUSANDS = {".": ",", ",": "."}


class TwoReadingsError(SoftgripError, ValueError):
    """Numbers whose decimal sign cannot be told; `expected` and `got` say why."""

    def __init__(self, place: int, *, expected: str, got: str) -> None:
        self.place, self.expected, self.got = place, expected, got
        super().__init__(f"expected {expected}, got {got}")


def is_number(cell: str) -> bool:
    """Tell whether a cell is a number with one of the two decimal signs."""
    return bool(_PLAIN.fullmatch(cell)) or any(p.fullmatch(cell) for p in _NUMBER.values())


def is_missing(cell: str) -> bool:
    """Tell whether a cell says that nothing was measured."""
    return cell.casefold() in NOT_THERE


def number(cell: str, decimal: str) -> float:
    """Return the number of a cell; NaN if it is none.

    >>> number("1.234,5", ","), number("1,234.5", "."), number("1,234.5", ",")
    (1234.5, 1234.5, nan)
    """
    if decimal == "." and _PLAIN.fullmatch(cell):
        return float(cell)
    if not _NUMBER[decimal].fullmatch(cell):
        return np.nan
    plain = re.sub(f"[{_BLANKS}{_THOUSANDS[decimal]}]", "", cell)
    return float(plain.replace(decimal, ".").replace("\u2212", "-"))


def decimal_sign(cells: Iterable[tuple[int, str]], *, points_may_be_thousands: bool) -> str:
    """Return the decimal sign of the numbers of a table.

    Args:
        cells: Numbers, each with its place for the error.
        points_may_be_thousands: Whether 1.234 alone may be a thousand, as where cells are parted
            by semicolons because commas are decimal; else a point is a decimal one unless a comma
            is.

    Raises:
        TwoReadingsError: If both signs are decimal ones, or either might be.

    >>> decimal_sign([(1, "0,5"), (2, "1.234,5")], points_may_be_thousands=False)
    ','
    """
    seen = [one for one in cells if not one[1].isdigit()]
    if not (points_may_be_thousands or any("," in c or c.count(".") > 1 for _, c in seen)):
        return "."
    against = {
        sign: next((one for one in seen if not pattern.fullmatch(one[1])), None)
        for sign, pattern in _NUMBER.items()
    }
    no_point, no_comma = against["."], against[","]
    if no_point and no_comma:
        (place, one), (other, two) = sorted((no_point, no_comma))
        raise TwoReadingsError(
            place, expected="one decimal sign", got=f"{one!r}, but {two!r} in line {other}"
        )
    if no_point or no_comma:
        return "," if no_point else "."
    doubtful = "." if points_may_be_thousands else ""
    for place, cell in seen:
        if any(sign in cell for sign in f",{doubtful}"):
            raise TwoReadingsError(
                place,
                expected="a decimal sign that can be told: give decimal=',' or decimal='.'",
                got=f"{cell!r}, a number with thousands or with decimals",
            )
    return "."
