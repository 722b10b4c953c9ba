"""Tables of text as other programs save them: spreadsheets, testers, loggers.

A file may begin with a byte-order mark, be UTF-8, UTF-16 or latin-1, have commas, semicolons, tabs
or blanks between its cells, points or commas as decimal signs, cells in quotes, comments, lines
before the names, units in the names or in a row below them, and other blocks after the table. What
is read is what there is one way to read; where there are two, the error says what decides.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import path_of
from softgrip.quantities import same_unit
from softgrip.text_cells import (
    BLANKS,
    COMMENT,
    SEPARATORS,
    Row,
    declared_separator,
    heading,
    is_unit_cell,
    lines_of,
    rows_of,
    text_of,
    trimmed,
    uncommented,
    unit_of_cell,
)
from softgrip.text_numbers import TwoReadingsError, decimal_sign, is_missing, is_number, number

LARGEST = 1e30
"""Of numbers: no quantity is above it in any unit, and squares of sums of what is stay finite."""
ALIKE = 0.5
"""Share of the rows of a file's longest table above which another one may as well be meant."""


@dataclass(frozen=True)
class TextTable:
    """A table of text.

    Attributes:
        path: Of the file.
        names: Of the columns, without their units.
        units: Of the columns as they stand there; empty where none does.
        rows: Cells of each row, as many as names.
        lines: Line of each row, from 1.
        names_line: Line of the names.
        head: Lines before the names, comments among them, the first of the file first.
        decimal: Sign of the decimals.
        ended: Whether the last row's line has an end; a cell without may be cut.
        notes: What of the file is not in the table, one sentence each.
    """

    path: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    names_line: int
    head: tuple[str, ...]
    decimal: str
    ended: bool
    notes: tuple[str, ...]

    @property
    def headings(self) -> tuple[str, ...]:
        """Names with their units, such as ``pressure [Pa]``."""
        pairs = zip(self.names, self.units, strict=True)
        return tuple(f"{name} [{unit}]" if unit else name for name, unit in pairs)

    def refusal(self, expected: str, got: str, line: int | None = None) -> DataFileError:
        """Return the error of this file; without a line, of that of the names."""
        line = self.names_line if line is None else line
        return DataFileError(self.path, expected=expected, got=got, line=line)

    def column(self, name: str | int) -> int:
        """Return the number of a column, from 0, by its name or its heading.

        The unit of a heading may be written in any way, and the case of letters counts only where
        two names differ in nothing else. A number is returned as it is.

        Raises:
            DataFileError: If there is none, or more than one.
        """
        if isinstance(name, int):
            return name
        own, unit = heading(" ".join(name.split()))
        wanted = f"{own} [{unit}]" if unit else own
        for labels in (self.headings, self.names):
            for key in (str, str.casefold):
                found = [k for k, label in enumerate(labels) if key(label) == key(wanted)]
                if len(found) > 1:
                    raise self.refusal(f"one column {name!r}", f"{len(found)} of {self.headings}")
                if found:
                    return found[0]
        raise self.refusal(f"a column {name!r}", ", ".join(map(repr, self.headings)))

    def cells(self, name: str | int) -> tuple[str, ...]:
        """Return the words of a column, one a row; `name` as of `column`."""
        at = self.column(name)
        return tuple(row[at] for row in self.rows)

    def numbers(self, name: str | int, *, missing: bool = False) -> Floats:
        """Return the numbers of a column, shape (rows,), in its unit.

        Args:
            name: As of `column`.
            missing: Whether cells that are empty, or say that nothing was measured, are NaN; else
                they are refused.

        Raises:
            DataFileError: If a cell is no finite number; it names line and column.
        """
        at = self.column(name)
        cells = self.cells(at)
        found = np.array([number(cell, self.decimal) for cell in cells])
        for k in np.flatnonzero(~(np.abs(found) <= LARGEST)).tolist():
            if not (missing and is_missing(cells[k])):
                got = repr(cells[k])
                raise self.refusal(f"a finite number under {self.names[at]}", got, self.lines[k])
        return found


def read_table(
    path: Path | str,
    *,
    separator: str | None = None,
    decimal: str | None = None,
    table: int | None = None,
) -> TextTable:
    r"""Read the table of a text file: names, perhaps units, and rows with a number or more.

    Args:
        path: Of the file.
        separator: ``,``, ``;``, ``\t`` or a blank, which stands for any number of blanks; found if
            not given.
        decimal: Sign of the decimals, ``.`` or ``,``; found if not given.
        table: Which table of several, from 1; the longest if not given.

    Raises:
        DataFileError: If the file is no text or holds no table, a row has more or fewer cells than
            there are names, or there are two ways to read it: separators, decimal signs, or tables
            of like length. It says what decides.
        InvalidInputError: If separator or decimal is none.
    """
    if decimal not in (None, ".", ","):
        raise InvalidInputError("decimal", expected="'.' or ','", got=decimal)
    if separator is not None and (
        len(separator) != 1 or separator.isalnum() or separator in "\"'."
    ):
        raise InvalidInputError("separator", expected="one sign, such as ';'", got=separator)
    file = path_of(path)
    text = text_of(file)
    separator = separator or declared_separator(text)
    found = _by_separator(file, text, separator)
    one = _chosen(file, found, table)
    rows, notes, ended = list(one.rows), _left_out(one, found), True
    between = [
        number
        for number, line in enumerate(lines_of(text), start=1)
        if one.line < number < rows[-1][0] and line.lstrip(' "').startswith(COMMENT)
    ]
    between = [number for number in between if number not in {line for line, _ in rows}]
    if between:
        several = f" and {len(between) - 1} more" if len(between) > 1 else ""
        notes.append(f"line {between[0]}{several}, a comment, was left out")
    if not text.endswith(("\n", "\r")) and rows[-1][0] == len(lines_of(text)):
        ended = len(rows[-1][1]) != len(one.names)
        if ended:
            notes.append(f"the cut last line, {rows.pop()[0]}, was left out")
    for line, row in rows:
        if len(row) != len(one.names):
            raise DataFileError(
                file, expected=f"{len(one.names)} cells", got=str(len(row)), line=line
            )
    named = [heading(cell) for cell in one.names]
    below = [unit_of_cell(cell) for cell in one.units] or [""] * len(named)
    for (name, unit), other in zip(named, below, strict=True):
        if unit and other not in ("", "1") and not same_unit(unit, other):
            raise DataFileError(
                file, expected=f"one unit of {name!r}", got=f"{unit} and, below, {other}",
                line=one.line,
            )  # fmt: skip
    return TextTable(
        path=file,
        names=tuple(name for name, _ in named),
        units=tuple(unit or other for (_, unit), other in zip(named, below, strict=True)),
        rows=tuple(row for _, row in rows),
        lines=tuple(line for line, _ in rows),
        names_line=one.line,
        head=tuple(uncommented(line) for line in lines_of(text)[: one.line - 1]),
        decimal=decimal or _decimal_of(file, rows, points=one.separator in ";\t"),
        ended=ended,
        notes=tuple(notes),
    )


@dataclass(frozen=True)
class _Block:
    """One table of a file, parted by one separator.

    Attributes:
        separator: That parts it.
        line, names: Where its names are, and their cells.
        units: Cells of the row of units below them; empty without.
        rows: That belong to it.
        rest: First and last line of other things between it and the next table; none if 0.
    """

    separator: str
    line: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: tuple[Row, ...]
    rest: tuple[int, int]

    @property
    def share(self) -> float:
        """Share of the cells that are numbers."""
        cells = [is_number(cell) for _, row in self.rows for cell in row]
        return sum(cells) / len(cells)


def _by_separator(path: Path, text: str, given: str | None) -> list[_Block]:
    """Return the tables of a file, by the separator with which most cells are numbers."""
    found: dict[str, list[_Block]] = {}
    got: list[str] = []
    for one in [given] if given else [*SEPARATORS, BLANKS]:
        # Blanks part cells only where nothing else does: they stand in names, too.
        if (one == BLANKS and found) or (one not in text and one != BLANKS):
            continue
        way = SEPARATORS.get(one, "blanks")
        try:
            rows = rows_of(text, one)
        except csv.Error as error:
            got.append(f"by {way} {error}")
            continue
        blocks = [block for block in _blocks(rows, one) if given or _parted(block)]
        found |= {one: blocks} if blocks else {}
        got += _why_none(rows, way) if one in text else []
    best = [*found]
    if len(found) > 1:
        shares = {one: max(blocks, key=_length).share for one, blocks in found.items()}
        best = [one for one, share in shares.items() if share == max(shares.values())]
    if len(best) > 1:
        ways = " or by ".join(SEPARATORS[one] for one in best)
        raise DataFileError(path, expected="one way to part cells: give the separator", got=ways)
    if not best:
        raise DataFileError(
            path,
            expected="column names, then rows with as many cells and a number in each",
            got="; ".join(got) or "no line with a number",
        )
    return found[best[0]]


def _parted(block: _Block) -> bool:
    """Tell whether a separator parts the names, or a single name needs none."""
    if block.separator == BLANKS:
        return not any(sign in name for sign in SEPARATORS for name in block.names)
    return len(block.names) > 1


def _length(block: _Block) -> int:
    return len(block.rows)


def _why_none(rows: Sequence[Row], way: str) -> list[str]:
    """Say why rows are no table."""
    first = next((k for k, (_, row) in enumerate(rows) if _numeric(row)), None)
    if first is None:
        return []
    line, row = rows[first]
    if first == 0:
        return [f"by {way} a number in line {line}, before any name"]
    above, names = rows[first - 1]
    return [
        f"by {way} {len(trimmed(names))} names in line {above}, {len(row)} cells in line {line}"
    ]


def _numeric(row: Sequence[str]) -> list[int]:
    return [k for k, cell in enumerate(row) if is_number(cell)]


def _blocks(rows: Sequence[Row], separator: str) -> list[_Block]:
    """Return the tables among rows."""
    starts: list[tuple[int, int]] = []
    for at in range(len(rows)):
        if not starts or at >= starts[-1][1]:
            starts += [(at, first)] if (first := _first_row(rows, at)) else []
    ends = [*(at for at, _ in starts[1:]), len(rows)]
    return [_block(rows, *start, end, separator) for start, end in zip(starts, ends, strict=False)]


def _first_row(rows: Sequence[Row], at: int) -> int:
    """Return which row is the first under names; 0 if these are none."""
    names = trimmed(rows[at][1])
    # An index has no name in some files; another cell without one is a row that is damaged.
    if any(map(is_number, names)) or not all(names[1:]):
        return 0
    for first in range(at + 1, min(at + 3, len(rows))):
        row = trimmed(rows[first][1], len(names))
        if len(row) != len(names):
            return 0
        if _numeric(row):
            return first
        if not all(map(is_unit_cell, row)):
            return 0
    return 0


def _block(rows: Sequence[Row], at: int, first: int, end: int, separator: str) -> _Block:
    names = trimmed(rows[at][1])
    numeric = _numeric(rows[first][1])
    body = [(line, trimmed(row, len(names))) for line, row in rows[first:end]]
    like = [
        len(row) == len(names) and all(is_number(row[k]) or is_missing(row[k]) for k in numeric)
        for _, row in body
    ]
    last = max(k for k, one in enumerate(like) if one)
    # What goes on where the table did, with a number, is no other thing: it is a row that is wrong.
    while last + 1 < len(body) and _goes_on(body[last], body[last + 1], numeric):
        last += 1
    rest = [line for line, _ in body[last + 1 :]]
    return _Block(
        separator,
        rows[at][0],
        names,
        trimmed(rows[at + 1][1], len(names)) if first > at + 1 else (),
        tuple(body[: last + 1]),
        (rest[0], rest[-1]) if rest else (0, 0),
    )


def _goes_on(row: Row, other: Row, numeric: Sequence[int]) -> bool:
    return numeric[0] == 0 and other[0] == row[0] + 1 and is_number(other[1][0])


def _chosen(path: Path, found: Sequence[_Block], table: int | None) -> _Block:
    if table is not None:
        if not 1 <= table <= len(found):
            raise DataFileError(path, expected=f"a table {table}", got=f"{len(found)} tables")
        return found[table - 1]
    if len(found) > 1 and all(map(_follows, found, found[1:])):
        return _appended(found)
    longest = max(found, key=_length)
    alike = [
        f"table {k} under line {one.line}, {len(one.rows)} rows"
        for k, one in enumerate(found, start=1)
        if len(one.rows) > ALIKE * len(longest.rows)
    ]
    if len(alike) > 1:
        raise DataFileError(path, expected="one table, or which: table=1", got="; ".join(alike))
    return longest


def _follows(one: _Block, other: _Block) -> bool:
    """Tell whether a table goes on under its names: a file was appended to. Other lines part."""
    same = (one.names, one.units) == (other.names, other.units)
    return same and not one.rest[0] and other.line == one.rows[-1][0] + 1


def _appended(found: Sequence[_Block]) -> _Block:
    """Return tables of the same names and units as one, as a file has that was appended to."""
    first, *others = found
    rows = [row for one in found for row in one.rows]
    return replace(first, rows=tuple(rows), rest=others[-1].rest if others else first.rest)


def _left_out(chosen: _Block, found: Sequence[_Block]) -> list[str]:
    """Say what follows the names of a table and is not in it."""
    notes = [
        (f"line {first}" if first == last else f"lines {first} to {last}")
        + f", after the table, {'was' if first == last else 'were'} left out"
        for first, last in [one.rest for one in found if one is chosen or chosen not in found]
        if first
    ]
    if chosen not in found:
        again = ", ".join(str(one.line) for one in found[1:])
        return [*notes, f"the names stand again in line {again}: the rows below go on"]
    others = [one for one in found if one is not chosen]
    return notes + [
        f"the table of {len(one.rows)} rows under line {one.line} was left out" for one in others
    ]


def _decimal_of(path: Path, rows: Sequence[Row], *, points: bool) -> str:
    columns = zip(*(row for _, row in rows), strict=True)
    numeric = ((k, [*map(is_number, column)]) for k, column in enumerate(columns))
    mostly = [(k, flags) for k, flags in numeric if 2 * sum(flags) > len(flags)]
    cells = [
        (line, row[k]) for n, (line, row) in enumerate(rows) for k, flags in mostly if flags[n]
    ]
    try:
        return decimal_sign(cells, points_may_be_thousands=points)
    except TwoReadingsError as error:
        raise DataFileError(
            path, expected=error.expected, got=error.got, line=error.place
        ) from None
