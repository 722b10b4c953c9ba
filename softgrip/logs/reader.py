"""Reading a log of any back end: what is safely mended is mended and said, the rest is refused."""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import cast

import numpy as np

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.gaps import check_period, gaps_of, late_start, places
from softgrip.logs.schema import EVENT, KNOWN_UNITS, SCHEMA, Log, LogHeader, SetUp
from softgrip.provenance import Provenance, data_file

_NAME = re.compile(r"^(?P<name>[^\[\]]+) \[(?P<unit>[^\[\]]+)\]$")


def _header(path: Path, lines: list[str]) -> tuple[LogHeader, int]:
    """Return the header and the number of its lines."""
    keys: dict[str, str] = {}
    for line in lines:
        if not line.startswith("#"):
            break
        key, colon, value = line[1:].partition(":")
        if not colon or key.strip() in keys:
            raise DataFileError(
                path, expected="'# key: value', each key once", got=repr(line), line=len(keys) + 1
            )
        keys[key.strip()] = value.strip()
    count = len(keys)
    if keys.get("schema") != SCHEMA:
        raise DataFileError(
            path, expected=f"schema {SCHEMA!r} in the header", got=repr(keys.get("schema"))
        )
    del keys["schema"]
    try:
        own = ("source", "back_end", "board", "firmware", "calibration", "seed")
        words = {name: keys.pop(name) for name in own}
        provenance, period = Provenance(keys.pop("provenance")), float(keys.pop("period"))
        set_up = cast(SetUp, keys.pop("set_up", "gripper"))  # LogHeader refuses another one
        header = LogHeader(provenance, period=period, set_up=set_up, **words, notes=keys)
        return header, count
    except KeyError as error:
        raise DataFileError(
            path, expected=f"{error.args[0]!r} in the header", got="none", line=count
        ) from None
    except (InvalidInputError, ValueError) as error:
        raise DataFileError(path, expected="a valid header", got=str(error), line=count) from None


def _columns(
    path: Path, text: str, line: int, columns: Mapping[str, str]
) -> tuple[list[str], list[float], list[str]]:
    """Return the names of the columns, factors into their units, and what was converted.

    Args:
        path, text, line: The line of names, and where it stands.
        columns: Those that must be there, with their units.
    """
    cells = text.split(",")
    if cells[-1] != EVENT:
        raise DataFileError(path, expected=f"the last column {EVENT!r}", got=cells[-1], line=line)
    names, factors, repairs = [], [], []
    for cell in cells[:-1]:
        found = _NAME.match(cell)
        if found is None:
            raise DataFileError(path, expected="'name [unit]'", got=repr(cell), line=line)
        name, unit = found["name"], found["unit"]
        wanted = columns.get(name, unit)
        factor = 1.0 if unit == wanted else KNOWN_UNITS.get((unit, wanted))
        if factor is None:
            raise DataFileError(path, expected=f"{name} in {wanted}", got=unit, line=line)
        if unit != wanted:
            repairs.append(f"{name} was converted from {unit} to {wanted}")
        names.append(name)
        factors.append(factor)
    missing = [name for name in columns if name not in names]
    if missing or len(set(names)) < len(names):
        raise DataFileError(
            path,
            expected=f"the columns {', '.join(columns)}, once each",
            got=f"no {', '.join(missing)}" if missing else "one twice",
            line=line,
        )
    return names, factors, repairs


def read_log(path: Path | str) -> Log:
    """Read a log.

    Mended, and said in `Log.repairs`: a cut last line is left out, as is a last row with a value
    that is not a number; a row written twice counts once; a known other unit is converted. Missing
    rows are not put back, but said there too, with their place; so is a start later than a run's.

    Args:
        path: Of the log.

    Raises:
        DataFileError: If a column is missing, a unit unknown, a row of another width, a value
            elsewhere not a finite number, if time stands or runs back, or if the rows are another
            time apart than the header says. It names the file and, where known, the line.
    """
    file = Path(path)
    try:
        text = file.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        raise DataFileError(file, expected="UTF-8 text", got=str(error)) from None
    # A file that was on a Windows machine has two characters at the end of each line.
    lines = text.replace("\r\n", "\n").split("\n")
    cut = lines.pop()
    header, line = _header(file, lines)
    if line >= len(lines):
        raise DataFileError(file, expected="a line of column names", got="the end", line=line + 1)
    names, factors, repairs = _columns(file, lines[line], line + 1, header.columns)
    if cut:
        repairs.append(f"the cut last line, {len(lines) + 1}, was left out")
    rows: list[list[float]] = []
    events: list[tuple[float, str]] = []
    clock = names.index("time")
    before = ""
    for number, row in enumerate(lines[line + 1 :], start=line + 2):
        if row == before:
            repairs.append(f"line {number}, the same as the one before, was left out")
            continue
        before = row
        cells = row.split(",")
        if len(cells) != len(names) + 1:
            raise DataFileError(
                file, expected=f"{len(names) + 1} cells", got=str(len(cells)), line=number
            )
        try:
            values = [float(c) * f for c, f in zip(cells, factors, strict=False)]
        except ValueError as error:
            raise DataFileError(file, expected="numbers", got=str(error), line=number) from None
        if not np.isfinite(values).all():
            if number == len(lines):
                repairs.append(f"the last line, {number}, was left out: not all of it is finite")
                continue
            raise DataFileError(file, expected="finite numbers", got=repr(row), line=number)
        if rows and not values[clock] > rows[-1][clock]:
            raise DataFileError(
                file,
                expected=f"a time above {rows[-1][clock]!r} s",
                got=repr(values[clock]),
                line=number,
            )
        rows.append(values)
        if cells[-1]:
            events.append((values[clock], cells[-1]))
    table = np.array(rows, dtype=np.float64).reshape(-1, len(names))
    check_period(file, header, table[:, clock])
    log = Log(
        header, {name: table[:, k] for k, name in enumerate(names)}, tuple(events), tuple(repairs)
    )
    missing = filter(None, (late_start(log), places(gaps_of(log))))
    return replace(log, repairs=(*repairs, *missing))


def kept_log(name: str) -> Path:
    """Return the path of a simulated log that the book brings, such as ``push-a``."""
    return data_file(f"simulated/{name}.csv").path
