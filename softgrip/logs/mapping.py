"""Which columns of a log that was made elsewhere are those of ours, told by a call or a small TOML.

A file ``run.toml`` beside ``run.csv``::

    [columns]
    time = "t [ms]"
    pressure = "P [psi]"
    angle = "flex"         # the file says its unit

    [header]               # what the log does not say, as far as it is known
    area = "3.2 cm^2"
    lead = "2 mm"

    [text]                 # where the file can be read in two ways
    decimal = ","
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from softgrip.errors import DataFileError
from softgrip.files import existing
from softgrip.text_cells import heading
from softgrip.text_table import TextTable

TABLES = ("columns", "header", "text")
TEXT_KEYS = ("separator", "decimal", "table")


@dataclass(frozen=True)
class LogMapping:
    """What is known of a log beside its file.

    Attributes:
        columns: Heading or name in the file by our name, such as ``{"pressure": "P [psi]"}``. The
            unit may be given where the file has none.
        header: Keys and values as of the header of a log.
        text: Arguments of `softgrip.text_table.read_table`.
    """

    columns: Mapping[str, str] = field(default_factory=dict)
    header: Mapping[str, str] = field(default_factory=dict)
    text: Mapping[str, Any] = field(default_factory=dict)


def mapping_beside(path: Path) -> LogMapping:
    """Read the TOML of a log's name beside it, if there is one.

    Raises:
        DataFileError: If it is no TOML, or has other tables, keys or values than the above.
    """
    file = existing(path).with_suffix(".toml")
    if file == path or not file.is_file():
        return LogMapping()
    try:
        found = tomllib.loads(file.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise DataFileError(file, expected="TOML", got=str(error)) from None
    for name, table in found.items():
        if name not in TABLES or not isinstance(table, dict):
            raise DataFileError(file, expected=f"tables of {', '.join(TABLES)}", got=name)
        for key, value in table.items():
            if name == "text" and key not in TEXT_KEYS:
                raise DataFileError(file, expected=f"keys of {', '.join(TEXT_KEYS)}", got=key)
            if not isinstance(value, int if key == "table" and name == "text" else str):
                expected = "a whole number" if key == "table" else 'words, such as "3.2 cm^2"'
                raise DataFileError(file, expected=f"{key} as {expected}", got=repr(value))
    return LogMapping(**found)


def mapped(table: TextTable, name: str, given: str) -> tuple[int, str]:
    """Return the number and the unit of a column of a file that is given for one of ours.

    Raises:
        DataFileError: If the file has no such column, or two, or another unit than is given.
    """
    own, unit = heading(" ".join(given.split()))
    if not unit:
        at = table.column(given)
        return at, table.units[at]
    try:
        at = table.column(given)
    except DataFileError:
        at = table.column(own)
    found = table.units[at]
    if found and found.casefold() != unit.casefold():
        raise table.refusal(f"{name} in {unit}, as is said of it", f"a column {table.headings[at]}")
    return at, unit
