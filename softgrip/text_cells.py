"""The cells of a text file, whatever its encoding and whatever parts them."""

import csv
import re
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

from softgrip.errors import DataFileError
from softgrip.files import existing
from softgrip.quantities import is_unit

SEPARATORS = {"\t": "tab", ";": "semicolon", ",": "comma"}
BLANKS = " "
"""Separator of a file whose cells are parted by any number of blanks."""
COMMENT = "#"

Row = tuple[int, tuple[str, ...]]
"""Number of a line, from 1, and its cells."""

_WORDS = re.compile(r'"[^"]*"|[^\s"\[(]+(?:[ \t]*[\[(][^\])]*[\])])?|[\[(][^\])]*[\])]')
"""Cells between blanks: a unit in brackets is one with the name before it."""


def text_of(path: Path) -> str:
    """Return the text of a file in UTF-8, UTF-16 or latin-1, without its byte-order mark.

    Raises:
        DataFileError: If there is no such file, or it is no text.
    """
    raw = existing(path).read_bytes()
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    else:
        # A file of numbers and names begins with a letter that has one byte.
        encoding = {b"\0": "utf-16-be"}.get(raw[:1]) or (
            "utf-16-le" if raw[1:2] == b"\0" else "utf-8-sig"
        )
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    if found := re.search(r"[\x00-\x08\x0e-\x1f\x7f]", text):
        hint = "; save the sheet as CSV" if raw.startswith(b"PK") else ""
        line = text.count("\n", 0, found.start()) + 1
        raise DataFileError(path, expected="text", got=f"{found[0]!r}{hint}", line=line)
    return text


def lines_of(text: str) -> list[str]:
    """Return the lines of a text, whichever system ended them."""
    return [line.rstrip("\r\n") for line in StringIO(text, newline="")]


def declared_separator(text: str) -> str | None:
    """Return the separator that a first line ``sep=;`` declares, as spreadsheets read it."""
    found = re.match(r'"?sep=(.)"?[\r\n]', text, flags=re.IGNORECASE)
    return found[1] if found else None


def rows_of(text: str, separator: str) -> list[Row]:
    """Return the lines that are neither empty nor comments, as cells without blanks about them.

    Raises:
        csv.Error: If the quotes of a line make no cells.
    """
    found = _by_blanks(text) if separator == BLANKS else _by_sign(text, separator)
    rows = ((line, tuple(" ".join(cell.split()) for cell in cells)) for line, cells in found)
    return [(line, row) for line, row in rows if any(row) and not _is_comment(row[0])]


def _is_comment(cell: str) -> bool:
    # A spreadsheet's errors begin as comments do.
    return cell.startswith(COMMENT) and not re.match(r"#(N/A|NUM|DIV|VALUE|REF|NAME|NULL)", cell)


def _by_blanks(text: str) -> Iterator[tuple[int, list[str]]]:
    for number, line in enumerate(lines_of(text), start=1):
        yield number, [cell.strip('"') for cell in _WORDS.findall(line)]


def _by_sign(text: str, separator: str) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(
        StringIO(text, newline=""),
        delimiter=separator,
        skipinitialspace=separator != "\t",
        strict=True,
    )
    before = 0
    for cells in reader:
        yield before + 1, cells
        before = reader.line_num


def trimmed(row: tuple[str, ...], width: int = 1) -> tuple[str, ...]:
    """Return a row without the empty cells at its end that are beyond a width."""
    while len(row) > width and not row[-1]:
        row = row[:-1]
    return row


def uncommented(line: str) -> str:
    """Return a comment as it was before a spreadsheet saved it; another line as it is.

    >>> uncommented('"# shows: a push, slowly",,,')
    '# shows: a push, slowly'
    """
    if not line.startswith((COMMENT, f'"{COMMENT}')):
        return line
    whole = next(csv.reader([line], delimiter=line.rstrip()[-1]), [""])[0] if line[0] == '"' else ""
    return (whole or line).rstrip(",;\t ")


def is_unit_cell(cell: str) -> bool:
    """Tell whether a cell below a name says its unit."""
    return is_unit(cell) or bool(re.fullmatch(r"\[[^\[\]]*\]|\([^()]*\)", cell))


def unit_of_cell(cell: str) -> str:
    """Return the unit that a cell below a name says, ``1`` for a dash."""
    unit = cell.strip("[]() ")
    return "1" if unit in ("-", "\u2014") else unit


def heading(cell: str) -> tuple[str, str]:
    """Return the name and the unit of a column; the unit is empty where there is none.

    What stands in brackets is a unit. What stands in parentheses, or after a comma or a stroke, is
    one only if it is known: else it is part of the name.

    >>> [heading(x) for x in ("pressure [psi]", "P (bar)", "Angle/deg", "Flow, mL/min", "a (b)")]
    [('pressure', 'psi'), ('P', 'bar'), ('Angle', 'deg'), ('Flow', 'mL/min'), ('a (b)', '')]
    """
    if found := re.fullmatch(r"(.*?)[ /,]*\[([^\[\]]*)\]", cell):
        return found[1].strip(), unit_of_cell(found[2])
    if (found := re.fullmatch(r"(.*?)[ /,]*\(([^()]*)\)", cell)) and is_unit(found[2]):
        return found[1].strip(), unit_of_cell(found[2])
    for sign in re.finditer(r"[/,]", cell):
        name, unit = cell[: sign.start()].strip(), cell[sign.end() :].strip()
        if name and unit and is_unit(unit):
            return name, unit_of_cell(unit)
    return cell, ""
