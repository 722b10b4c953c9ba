"""Tensile tests as testers export them: any material, force and extension or stress and strain.

Names and units are found in the header, or given. What is read is the first loading, from where the
specimen takes load: what a loose clamp gave way by and what the specimen was pulled by beforehand
are taken off, cycles after the first peak are left out, and all of it is said in `Export.notes`.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.materials.tensile import FEWEST_ROWS, TensileTest
from softgrip.quantities import convert, in_si
from softgrip.text_table import TextTable, read_table

NAMES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "strain": ("engineering strain", "tensile strain", "nominal strain", "strain", "dehnung",
                   "elongation %"),
        "stress": ("engineering stress", "tensile stress", "nominal stress", "stress", "spannung",
                   "zugspannung"),
        "extension": ("extension", "tensile extension", "tensile displacement", "displacement",
                      "crosshead", "crosshead position", "stroke", "elongation", "position", "weg",
                      "traverse", "standardweg"),
        "force": ("force", "load", "tensile load", "standard force", "kraft", "standardkraft",
                  "last"),
    }
)  # fmt: skip
"""Names that testers give to a column, in any case; the first that a file has is taken."""
HEAD: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "gauge_length": (r"ga(?:u)?ge\s*length|specimen\s*length|grip\s*separation|messl.nge|L0|"
                         r"einspannl.nge", "m"),
        "area": (r"cross[\s-]*section(?:al)?(?:\s*area)?|area|querschnitt|A0|S0", "m^2"),
        "width": (r"(?:specimen\s*)?width|breite|b0", "m"),
        "thickness": (r"(?:specimen\s*)?thickness|dicke|a0", "m"),
    }
)  # fmt: skip
"""What lines before the table call the specimen's sizes, and their SI units."""
DIMENSION = {"strain": "1", "stress": "Pa", "extension": "m", "force": "N"}
NOISE_ROWS = 8
"""Rows at the beginning by which noise and preload are told."""
FALLS = 0.01
"""Share of the largest strain by which it must fall for an unloading: less is noise."""
SLACK = 0.01
"""Share of the largest stress up to which a specimen has not taken load."""
SLACK_ROWS = 3
"""Rows that must stay below it for a clamp to have been loose."""


@dataclass(frozen=True, eq=False)
class Export:
    """A test that was read, and what was done to it.

    Attributes:
        test: First loading; engineering strain and stress, and true ones of a solid that keeps its
            volume.
        preload: Stress that was taken off, Pa.
        slack: Strain that was taken off, dimensionless.
        notes: What was found, taken, and left out, one sentence each.
    """

    test: TensileTest
    preload: float
    slack: float
    notes: tuple[str, ...]


def read_export(
    path: Path | str,
    *,
    columns: Mapping[str, str] = MappingProxyType({}),
    gauge_length: float | str | None = None,
    area: float | str | None = None,
) -> Export:
    """Read a tester's export.

    Args:
        path: Of a text file; see `read_table` for what it may be like.
        columns: Headings by what they are, keys of `NAMES`, such as ``{"force": "F [N]"}``, where
            they are not found or the wrong ones are.
        gauge_length: First length of what is stretched, m, or words such as ``"30 mm"``; not needed
            with a column of strain, or if the file says it.
        area: First cross-section, m^2, or words; likewise.

    Raises:
        DataFileError: If a column, a unit or a size is missing or cannot be used; it says what is
            expected and what there is.
        InvalidInputError: If a size is not above zero.

    >>> found = read_export("rubber.csv", gauge_length="30 mm", area="12 mm^2")  # doctest: +SKIP
    """
    table = read_table(path)
    notes = list(table.notes)
    sizes = {"gauge_length": gauge_length, "area": area}
    strain = _strain(table, columns, sizes, notes)
    stress = _stress(table, columns, sizes, notes)
    strain, stress = _first_loading(table, strain, stress, notes)
    strain, stress, slack = _taken_up(strain, stress, notes)
    stress, preload = _without_preload(strain, stress, notes)
    rising = np.concatenate([[True], np.diff(np.maximum.accumulate(strain)) > 0])
    strain, stress = strain[rising], stress[rising]
    if strain.size < FEWEST_ROWS:
        raise table.refusal(f"{FEWEST_ROWS} rows of a first loading or more", f"{strain.size}")
    test = TensileTest(Path(path).stem, strain, stress, np.log1p(strain), stress * (1 + strain))
    return Export(test, preload, slack, tuple(notes))


def _found(table: TextTable, columns: Mapping[str, str], what: str) -> str | None:
    """Return the heading of a column, given or found."""
    if what in columns:
        return table.headings[table.column(columns[what])]
    named = {
        _plain(name): heading for name, heading in zip(table.names, table.headings, strict=True)
    }
    return next((named[name] for name in NAMES[what] if name in named), None)


def _plain(name: str) -> str:
    return re.sub(r"[\s_]+", " ", name).strip().casefold()


def _values(table: TextTable, heading: str, what: str) -> Floats:
    """Return a column in SI."""
    unit = table.units[table.column(heading)]
    values = table.numbers(heading)
    if what == "strain" and not unit:
        # A strain of more than this cannot be one: it is in percent, and which is not said.
        if np.max(np.abs(values)) > LARGEST_STRAIN:
            raise table.refusal(f"a unit of {heading!r}: 1 or %", f"values up to {values.max():g}")
        return values
    if not unit:
        raise table.refusal(f"a unit of {heading!r}, in its name or below it", "none")
    try:
        return convert(values, unit, DIMENSION[what], name=heading)
    except InvalidInputError as error:
        raise table.refusal(f"{heading!r} in {error.expected}", str(error.got)) from None


LARGEST_STRAIN = 20.0
"""Of a rubber: 2,000 %."""


def _size(
    table: TextTable, sizes: Mapping[str, float | str | None], what: str, notes: list[str]
) -> float | None:
    """Return a size of the specimen, given or from the lines before the table, SI."""
    _, si = HEAD[what]
    given = sizes.get(what)
    if given is not None:
        value = in_si(what, given, si)
        if not (np.isfinite(value) and value > 0):
            raise InvalidInputError(what, expected=f"above zero, {si}", got=given)
        return value
    pattern = re.compile(
        rf"^\W*(?:{HEAD[what][0]})\s*[\[(]?\s*(?P<before>[a-zA-Z%^0-9²³]*)\s*[\])]?\s*[:;,=\t]+\s*\"?"
        rf"(?P<value>\d+(?:[.,]\d+)?)\s*(?P<after>[a-zA-Z]+\^?[0-9²³]?)?",
        re.IGNORECASE,
    )
    for line in table.head:
        if found := pattern.match(line):
            unit = found["before"] or found["after"]
            if not unit:
                raise table.refusal(f"a unit of the size in {line!r}", "none")
            number = float(found["value"].replace(",", "."))
            try:
                value = float(convert(number, unit, si, name=what))
            except InvalidInputError as error:
                raise table.refusal(f"{line!r} in {error.expected}", str(error.got)) from None
            notes.append(f"{what.replace('_', ' ')} {number:g} {unit}, as the file says")
            return value
    return None


def _strain(
    table: TextTable, columns: Mapping[str, str], sizes: Mapping[str, float | str | None],
    notes: list[str],
) -> Floats:  # fmt: skip
    heading = _found(table, columns, "strain")
    if heading and "extension" not in columns:
        return _values(table, heading, "strain")
    heading = _found(table, columns, "extension")
    if not heading:
        raise table.refusal(
            "a column of strain, or of extension, such as 'Extension [mm]'; "
            'columns={"extension": ...} names another',
            ", ".join(map(repr, table.headings)),
        )
    length = _size(table, sizes, "gauge_length", notes)
    if length is None:
        raise table.refusal(
            f'a gauge length for {heading!r}: gauge_length="30 mm", or a line of the file', "none"
        )
    extension = _values(table, heading, "extension")
    return (extension - extension[0]) / length


def _stress(
    table: TextTable, columns: Mapping[str, str], sizes: Mapping[str, float | str | None],
    notes: list[str],
) -> Floats:  # fmt: skip
    heading = _found(table, columns, "stress")
    if heading and "force" not in columns:
        return _values(table, heading, "stress")
    heading = _found(table, columns, "force")
    if not heading:
        raise table.refusal(
            "a column of stress, or of force, such as 'Force [N]'; "
            'columns={"force": ...} names another',
            ", ".join(map(repr, table.headings)),
        )
    section = _size(table, sizes, "area", notes)
    if section is None:
        width, thickness = (_size(table, sizes, one, notes) for one in ("width", "thickness"))
        section = width * thickness if width and thickness else None
    if section is None:
        raise table.refusal(
            f'a cross-section for {heading!r}: area="12 mm^2", or lines of the file', "none"
        )
    return _values(table, heading, "force") / section


def _first_loading(
    table: TextTable, strain: Floats, stress: Floats, notes: list[str]
) -> tuple[Floats, Floats]:
    """Return the rows until the strain first falls, or the specimen breaks."""
    largest = np.maximum.accumulate(strain)
    fallen = np.flatnonzero(strain < largest - FALLS * np.ptp(strain))
    end = strain.size
    if fallen.size:
        end = int(np.argmax(strain[: fallen[0]])) + 1
        notes.append(
            f"the first loading ends in line {table.lines[end - 1]}: what unloads after it, and "
            f"{strain.size - end} rows in all, are left out"
        )
    if not np.ptp(strain[:end]) > 0:
        raise table.refusal("a strain that rises", f"{strain[:end].min():g} throughout")
    return strain[:end], stress[:end]


def _taken_up(strain: Floats, stress: Floats, notes: list[str]) -> tuple[Floats, Floats, float]:
    """Return the rows from where the specimen takes load, the strain counted from there."""
    rest = float(np.median(stress[:NOISE_ROWS]))
    scatter = float(np.std(stress[:NOISE_ROWS]))
    low = stress <= rest + max(3 * scatter, SLACK * float(np.ptp(stress)))
    until = int(np.argmin(low)) if not low.all() else 0
    first = stress[:until]
    # A law that begins flat rises within these rows, too: a loose clamp leaves them level.
    level = until > SLACK_ROWS + NOISE_ROWS and np.ptp(first) < SLACK * np.ptp(stress)
    if not level:
        return strain - min(float(strain[0]), 0.0), stress, 0.0
    begun = _knee(strain, stress, until)
    slack = float(strain[begun])
    notes.append(f"the clamps were loose up to a strain of {slack:.3g}: it is taken off")
    return (strain[begun:] - slack) / (1 + slack), stress[begun:], slack


def _knee(strain: Floats, stress: Floats, until: int) -> int:
    """Return the row from which a curve leaves its level, looking back from where it is seen to.

    The last row before which the stress does not rise beyond what the level's own rows scatter by.
    """
    half = stress[: max(2, until // 2)]
    bound = float(half.mean() + 2 * half.std() + 1e-12)
    below = np.flatnonzero(stress[:until] <= bound)
    return int(below[-1]) if below.size else 0


def _without_preload(strain: Floats, stress: Floats, notes: list[str]) -> tuple[Floats, float]:
    """Return the stress counted from that of the first row, and what that was, Pa."""
    start = float(stress[0])
    scatter = float(np.std(np.diff(stress[:NOISE_ROWS], 2))) / 6**0.5
    if abs(start) <= max(3 * scatter, 1e-3 * float(np.ptp(stress))) or strain[0] > 1e-3:
        return stress, 0.0
    notes.append(f"a preload of {start:.4g} Pa at the first row is taken off")
    return stress - start, start
