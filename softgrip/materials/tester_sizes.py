"""The specimen's gauge length and cross-section: given, or from the lines before a table."""

import re
from collections.abc import Mapping
from math import pi
from types import MappingProxyType

from softgrip.arrays import check_positive
from softgrip.errors import InvalidInputError
from softgrip.quantities import convert, in_si
from softgrip.text_table import TextTable

SIZES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "gauge_length": (
            # A bare length may be that of the whole specimen; a dimension is what is stretched.
            r"gau?ge\s*length|initial\s*length|dimension\W+length|grip\s*separation|"
            r"(?:anfangs)?messl(?:ä|ae)nge|einspannl(?:ä|ae)nge|(?-i:L0|lo)",
            "m",
        ),
        "area": (
            r"(?:initial\s*)?(?:cross[\s-]*section(?:al)?(?:\s*area)?|area)|"
            r"(?:proben)?querschnitt(?:sfl(?:ä|ae)che)?|(?-i:A0|S0)",
            "m^2",
        ),
        "width": (r"(?:specimen\s*)?width|(?:proben)?breite|(?-i:b0)", "m"),
        "thickness": (r"(?:specimen\s*)?thickness|(?:proben)?dicke|(?-i:a0)", "m"),
        "diameter": (r"(?:specimen\s*)?diameter|durchmesser|(?-i:d0)", "m"),
    }
)
"""What testers call the sizes, and their SI units."""
_BEFORE = r"^\W*(?:(?:dimension|specimen(?:\s*\d+)?|probe)\W+)?"
_VALUE = (
    r"\s*(?:[\[(](?P<before>[^\])]*)[\])])?[\s:;,=\"]+(?P<value>\d+(?:[.,]\d+)?)"
    r"(?:[\s;,\"\[(]+(?P<after>[a-zµ]+\^?[2²]?)|\s*(?P<close>[a-zµ]+\^?[2²]?))?\W*$"
)


def size(table: TextTable, what: str, given: float | str | None) -> tuple[float | None, str]:
    """Return a size in SI and where the file says it, in words; None where nothing does.

    Args:
        table: Of the tester.
        what: One of `SIZES`.
        given: By the caller: in SI, or words such as ``"30 mm"``.

    Raises:
        DataFileError: If the file says two sizes, or one without a unit.
        InvalidInputError: If a size is not above zero.
    """
    names, si = SIZES[what]
    pattern = re.compile(f"{_BEFORE}(?:{names}){_VALUE}", re.IGNORECASE)
    lines = {line: one for line in table.head if (one := pattern.match(line))}
    if given is not None:
        value = in_si(what, given, si)
        check_positive(**{what: value})
        return value, "".join(f", not as {line!r} says" for line in lines)
    found = {line: _value(table, line, one, si) for line, one in lines.items()}
    if len(set(found.values())) > 1:
        raise table.refusal(f"one {_words(what)}, or which: {what}=", "; ".join(found))
    line = next(iter(found), "")
    return found.get(line), f", by {line!r}" if line else ""


def area(table: TextTable, given: float | str | None) -> tuple[float | None, str]:
    """Return the cross-section as `size` does, if need be of width and thickness or diameter."""
    whole = size(table, "area", given)
    if whole[0] is not None:
        return whole
    (width, one), (thickness, two) = (size(table, side, None) for side in ("width", "thickness"))
    if width and thickness:
        return width * thickness, one + two
    diameter, note = size(table, "diameter", None)
    return (pi / 4 * diameter**2, note) if diameter else (None, "")


def _words(what: str) -> str:
    return what.replace("_", " ")


def _value(table: TextTable, line: str, found: re.Match[str], si: str) -> float:
    unit = found["before"] or found["after"] or found["close"]
    if not unit:
        raise table.refusal(f"a unit of the size in {line!r}", "none")
    try:
        value = float(convert(float(found["value"].replace(",", ".")), unit, si, name=line))
        check_positive(**{line: value})
    except InvalidInputError as error:
        raise table.refusal("a size", str(error)) from None
    return value
