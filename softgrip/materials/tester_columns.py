"""Which column of a tester's table is what: names in English and German, told apart by units."""

import re
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.quantities import convert, si_unit
from softgrip.text_cells import heading
from softgrip.text_table import TextTable

UNITS: Mapping[str, str] = MappingProxyType(
    {"strain": "1", "extension": "m", "stress": "Pa", "force": "N",
     "true strain": "1", "true stress": "Pa"}
)  # fmt: skip
"""What a column can be, and its SI unit."""

_LENGTHENING = (
    r"extension|displacement|disp\.?|stroke|cross-?head|position|travel|elongation|"
    r"deformation|grip (?:separation|displacement)|(?:standard|traversen)?weg|traverse|"
    r"verformung|verlängerung|verlaengerung"
)
_NOUNS = {
    "strain": r"strain|(?:nenn)?dehnung",
    "extension": _LENGTHENING,
    "stress": r"stress|(?:zug|nenn)?spannung",
    "force": r"force|load|(?:standard|prüf|pruef|zug)?kraft|last",
}
_TRUE = re.compile(r"(?:true|cauchy|hencky|log(?:arithmic)?\.?|wahre) ")
_PLAIN = re.compile(
    # What may stand before the noun without making it another quantity.
    r"(?:(?:tensile|axial|eng(?:ineering)?\.?|nominal|standard|test|machine|cross-?head|stroke|"
    r"primary|percentage|technische|absolute|absoluter?) )*"
)
_OF = {"strain": ("strain", "extension"), "stress": ("stress", "force")}
"""Names that a column may have: those of a share and of a length are used for one another."""

CERTAIN = 5.0
"""Of a strain without a unit: up to here it is a share, as who pulls a rubber to 5 % tests none.
Beyond it, it may as well be per cent."""
SAME = 1e-3
"""Share of its range by which one column may differ from another that says the same."""


def column(table: TextTable, columns: Mapping[str, str], what: str) -> tuple[str, Floats] | None:
    """Return the heading of a column and its values in SI, shape (rows,); None if there is none.

    Args:
        table: Of the tester.
        columns: Headings by what they are, keys of `UNITS`, where they cannot be found or the
            wrong ones are; a unit in one counts where the table has none.
        what: One of `UNITS`.

    Raises:
        DataFileError: If two columns may be meant and are not the same, or a value or a unit is
            missing.
        UnknownNameError: If `columns` has other keys.
    """
    for key in columns:
        if key not in UNITS:
            raise UnknownNameError("column of a test", key, list(UNITS))
    if what in columns:
        name, unit = _given(table, columns[what])
        return name, _values(table, name, unit, what)
    found = [
        (name, _values(table, name, unit, what))
        for name, unit, pure in zip(table.headings, table.units, table.names, strict=True)
        if _may_be(pure, unit, what)
    ]
    for name, values in found[1:]:
        first = found[0][1]
        apart = np.max(np.abs(values - values[0] - first + first[0]))
        if apart > SAME * np.ptp(first):
            raise table.refusal(
                f"one column of {what}, or which: columns={{{what!r}: {name!r}}}",
                ", ".join(repr(one) for one, _ in found),
            )
    return found[0] if found else None


def _given(table: TextTable, wanted: str) -> tuple[str, str]:
    """Return the heading and the unit of a column that is named, the unit perhaps added."""
    name, unit = heading(" ".join(wanted.split()))
    added = [k for k, other in enumerate(table.names) if other == name and not table.units[k]]
    if unit and len(added) == 1:
        return table.headings[added[0]], unit
    at = table.column(wanted)
    return table.headings[at], table.units[at]


def _may_be(name: str, unit: str, what: str) -> bool:
    # What a strain was taken from stands in parentheses: "Tensile strain (Displacement)".
    plain = " ".join(re.sub(r"\(.*?\)", "", name).replace("_", " ").split()).casefold()
    true = _TRUE.match(plain)
    if bool(true) != what.startswith("true "):
        return False
    plain = plain[true.end() :] if true else plain
    kind = "strain" if UNITS[what] in "1m" else "stress"
    nouns = _OF[kind] if unit else (what.removeprefix("true "),)
    if not any(re.fullmatch(f"{_PLAIN.pattern}(?:{_NOUNS[noun]})", plain) for noun in nouns):
        return False
    return not unit or _si(unit) == UNITS[what]


def misfit(table: TextTable, what: str) -> str:
    """Return the heading of a column that has the name but not the unit; empty if none has."""
    pairs = zip(table.headings, table.names, table.units, strict=True)
    return next((heading for heading, name, unit in pairs if unit and _may_be(name, "", what)), "")


def _si(unit: str) -> str:
    try:
        return si_unit(unit)
    except InvalidInputError:
        return ""


def _values(table: TextTable, name: str, unit: str, what: str) -> Floats:
    values = table.numbers(name)
    if not unit and UNITS[what] == "1":
        largest = float(np.max(np.abs(values)))
        if largest > CERTAIN:
            raise table.refusal(
                f"a unit of {name!r}, in its name or below it: % or 1; or columns={{{what!r}: "
                f"'{name} [%]'}}",
                f"numbers up to {largest:g}, which may be {100 * largest:g} % or {largest:g} %",
            )
        return values
    if not unit:
        raise table.refusal(
            f"a unit of {name!r}, in its name, below it, or as columns={{{what!r}: "
            f"'{name} [{UNITS[what]}]'}}",
            "none",
        )
    try:
        return convert(values, unit, UNITS[what], name=name)
    except InvalidInputError as error:
        raise table.refusal("a unit that is one", str(error)) from None
