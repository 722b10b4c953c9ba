"""Reading a log of any back end: what is safely mended is mended and said, the rest is refused."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import cast

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import path_of
from softgrip.logs.gaps import check_period, crowded, gaps_of, late_start, places, uneven
from softgrip.logs.mapping import LogMapping, mapped, mapping_beside
from softgrip.logs.schema import EVENT, SCHEMA, SET_UPS, Log, LogHeader, SetUp, known_unit
from softgrip.provenance import Provenance, data_file
from softgrip.quantities import convert, is_unit, si_unit
from softgrip.text_table import TextTable, read_table

MOST_EMPTY = 0.2
"""Share of the rows that may lack a value of a column: they are left out, as gaps. Where more do,
the column is."""
MOST_MISSING = 1e7
"""Rows that may be missing in one place: more is no pause, and an even clock has no room for it."""
ELSEWHERE = "another program"
"""Back end of a log without our header."""


def read_log(path: Path | str, *, columns: Mapping[str, str] | None = None) -> Log:
    """Read a log: one of ours, or of any other program.

    A log of another program has a column of times, and others with their units in the names, in a
    row below them, or in `columns`. They keep their names or get those that are told: by `columns`,
    or by a TOML of the log's name beside it, see `softgrip.logs.mapping`. What has no unit is left
    out. Each value comes in SI.

    Mended, and said in `Log.repairs`: in a log of another program, a row with an empty cell, or a
    column with many, is left out; a cut last line is left out, as is a last row with a value
    that is not a number; a row written twice counts once; another unit is converted. Missing rows
    are not put back, but said there too, with their place; so are rows that come too early, and a
    start later than a run's.

    Args:
        path: Of the log.
        columns: Heading or name in the file by name of ours: ``{"pressure": "P [psi]"}``.

    Raises:
        DataFileError: If a column is missing, a unit unknown or of another dimension, a row of
            another width, a value elsewhere not a finite number, if time stands or runs back, or if
            the rows are another time apart than the header says. It names the file and, where
            known, the line.
    """
    file = path_of(path)
    told = mapping_beside(file) if columns is None else LogMapping(columns)
    table = read_table(file, **told.text)
    keys = _keys(table)
    chosen = _chosen(table, told, strict=bool(keys))
    raw = {name: table.numbers(at, missing=True) for name, (at, _) in chosen.items()}
    emptied = [] if keys else _without_the_empty(table, told, chosen, raw)
    rows, repairs = _whole_rows(table, chosen, raw, strict=bool(keys))
    repairs += emptied
    if not told.columns:
        taken = {at for at, _ in chosen.values()}
        left = [k for k, name in enumerate(table.names) if k not in taken and name != EVENT]
        repairs += [f"{table.headings[k]!r} was left out: it has no known unit" for k in left]
    time = _in_si(table, "time", chosen["time"][1], "s", raw["time"][rows])
    header = _header(table, keys) if keys else _guessed(file, told, time)
    if missing := [name for name in header.columns if keys and name not in chosen]:
        raise table.refusal(
            f"the columns {', '.join(header.columns)}, once each", f"no {', '.join(missing)}"
        )
    values = {}
    for name, (_, unit) in chosen.items():
        wanted = header.unit_of(name) or _si_unit(table, name, unit)
        values[name] = _in_si(table, name, unit, wanted, raw[name][rows])
        if unit != wanted:
            repairs.append(f"{name} was converted from {unit} to {wanted}")
    _check_time(table, values["time"], [table.lines[k] for k in rows])
    if keys:
        check_period(file, header, values["time"])
    log = Log(header, values, _events(table, told, values["time"], rows), (), file)
    found = filter(None, (late_start(log), places(gaps_of(log)), crowded(log), uneven(log)))
    return replace(log, repairs=(*repairs, *found))


def _without_the_empty(
    table: TextTable,
    told: LogMapping,
    chosen: dict[str, tuple[int, str]],
    raw: dict[str, Floats],
) -> list[str]:
    """Leave out columns that are empty in many rows, and say so: the others have these rows.

    Raises:
        DataFileError: If one of them was told to be read.
    """
    empty = {name: float(np.mean(np.isnan(values))) for name, values in raw.items()}
    said = []
    for name in [name for name, share in empty.items() if share > MOST_EMPTY and name != "time"]:
        if name in told.columns:
            first = int(np.flatnonzero(np.isnan(raw[name]))[0])
            got = repr(table.rows[first][chosen[name][0]])
            raise table.refusal(f"a finite number under {name}", got, table.lines[first])
        del chosen[name], raw[name]
        said.append(f"{name} was left out: {empty[name]:.0%} of its cells are empty")
    return said


def _whole_rows(
    table: TextTable,
    chosen: Mapping[str, tuple[int, str]],
    raw: Mapping[str, Floats],
    *,
    strict: bool,
) -> tuple[list[int], list[str]]:
    """Return the rows that count, and what was left out."""
    rows, repairs = [*range(len(table.rows))], list(table.notes)
    if not table.ended:
        repairs.append(f"the cut last line, {table.lines[rows.pop()]}, was left out")
    if rows and not all(np.isfinite(values[rows[-1]]) for values in raw.values()):
        last = table.lines[rows.pop()]
        repairs.append(f"the last line, {last}, was left out: not all of it is finite")
    doubled = [k for k in rows[1:] if table.rows[k] == table.rows[k - 1]]
    repairs += [f"line {table.lines[k]}, the same as the one before, was left out" for k in doubled]
    rows = sorted({*rows} - {*doubled})
    for name, values in raw.items():
        finite = np.isfinite(values).tolist()
        lacking = [k for k in rows if not finite[k]]
        if lacking and not strict and name != "time":
            more = f" and {len(lacking) - 1} more" if len(lacking) > 1 else ""
            repairs.append(f"line {table.lines[lacking[0]]}{more}, without {name}, was left out")
            rows = [k for k in rows if finite[k]]
        for k in rows:
            if not finite[k]:
                got = repr(table.rows[k][chosen[name][0]])
                raise table.refusal(f"a finite number under {name}", got, table.lines[k])
    if not rows:
        raise table.refusal("rows under the names", "none that is whole")
    return rows, repairs


def _keys(table: TextTable) -> dict[str, str]:
    """Return the keys and values of a header; none if it is not ours."""
    keys: dict[str, str] = {}
    lines = [(n, text) for n, text in enumerate(table.head, start=1) if text.startswith("#")]
    if not any(text.lstrip("# ").startswith("schema:") for _, text in lines):
        return keys
    for number, text in lines:
        key, colon, value = text[1:].partition(":")
        if not colon or key.strip() in keys:
            raise table.refusal("'# key: value', each key once", repr(text), number)
        keys[key.strip()] = value.strip()
    return keys


def _header(table: TextTable, keys: Mapping[str, str]) -> LogHeader:
    """Return the header that a log of ours has, and check that all its columns are there."""
    left, line = dict(keys), len(table.head)
    if (schema := left.pop("schema")) != SCHEMA:
        raise table.refusal(f"schema {SCHEMA!r} in the header", repr(schema), line)
    try:
        own = ("source", "back_end", "board", "firmware", "calibration", "seed")
        words = {name: left.pop(name) for name in own}
        provenance, period = Provenance(left.pop("provenance")), float(left.pop("period"))
        set_up = cast(SetUp, left.pop("set_up", "gripper"))  # LogHeader refuses another one
        header = LogHeader(provenance, period=period, set_up=set_up, **words, notes=left)
    except KeyError as error:
        raise table.refusal(f"{error.args[0]!r} in the header", "none", line) from None
    except (InvalidInputError, ValueError) as error:
        raise table.refusal("a valid header", str(error), line) from None
    return header


def _guessed(path: Path, told: LogMapping, time: Floats) -> LogHeader:
    """Return a header for a log without one: its period is the median one of its rows."""
    if time.size < 2:
        raise DataFileError(path, expected="two rows or more", got=f"{time.size}")
    words = {"source": path.name, "back_end": ELSEWHERE, **told.header}
    own = {field.name for field in fields(LogHeader)} - {"provenance", "period", "notes"}
    given = {name: words.pop(name) for name in own if name in words}
    try:
        provenance = Provenance(words.pop("provenance", "logged"))
        # Times that stand or run back are refused after this, with their line.
        period = abs(round(float(np.median(np.diff(time))), 9)) or 1.0
        return LogHeader(provenance, period=period, notes=words, **given)  # type: ignore[arg-type]
    except (InvalidInputError, ValueError) as error:
        file = path.with_suffix(".toml")
        raise DataFileError(file, expected="a valid header", got=str(error)) from None


def _chosen(table: TextTable, told: LogMapping, *, strict: bool) -> dict[str, tuple[int, str]]:
    """Return the columns that are read: number in the file and unit, by name."""
    given = {name: mapped(table, name, own) for name, own in told.columns.items() if name != EVENT}
    found = dict(given)
    if strict or not given:
        taken = {at for at, _ in given.values()}
        for at, (name, unit) in enumerate(zip(table.names, table.units, strict=True)):
            if at in taken or name in given or name == EVENT:
                continue
            if strict and not unit:
                raise table.refusal("'name [unit]'", repr(table.headings[at]))
            ours, known = (name, True) if strict else _our_name(name, unit)
            if known and ours in found:
                raise table.refusal(f"one column {ours!r}", "two")
            if known:
                found[ours] = at, unit
    if "time" not in found:
        if bare := [name for name in table.names if name.casefold() == "time"]:
            raise table.refusal(
                f"a unit of {bare[0]!r}, in its name, in a row below, or told: "
                f'columns={{"time": "{bare[0]} [s]"}}, or in a TOML beside the log',
                "none",
            )
        told_some = "; where some columns are told, all that count must be" if given else ""
        raise table.refusal(
            "a column 'time' with its unit, or one that is told to be it: "
            'columns={"time": "t [ms]"}, or a TOML beside the log' + told_some,
            ", ".join(map(repr, table.headings)),
        )
    return found


def _our_name(name: str, unit: str) -> tuple[str, bool]:
    """Return the name of a column as a log of ours has it, and whether its unit can be read."""
    own = name.casefold().replace(" ", "_")
    ours = any(known_unit(own, columns) for columns in SET_UPS.values())
    return (own, bool(unit)) if ours else (name, bool(unit) and is_unit(unit))


def _events(
    table: TextTable, told: LogMapping, time: Floats, rows: Sequence[int]
) -> tuple[tuple[float, str], ...]:
    """Return what is said of rows, with their times."""
    if EVENT not in told.columns and EVENT not in table.names:
        return ()
    cells = table.cells(told.columns.get(EVENT, EVENT))
    return tuple((float(t), cells[k]) for t, k in zip(time, rows, strict=True) if cells[k])


def _in_si(table: TextTable, name: str, unit: str, wanted: str, values: Floats) -> Floats:
    try:
        return convert(values, unit, wanted)
    except InvalidInputError as error:
        raise table.refusal(f"{name} as {error.expected}", repr(unit)) from None


def _si_unit(table: TextTable, name: str, unit: str) -> str:
    try:
        return si_unit(unit)
    except InvalidInputError as error:
        raise table.refusal(f"{name} in {error.expected}", repr(unit)) from None


def _check_time(table: TextTable, time: Floats, lines: Sequence[int]) -> None:
    """Refuse times that stand, run back, or jump: rows that were mixed, a clock that was set."""
    steps = np.diff(time)
    most = MOST_MISSING * float(np.median(steps)) if steps.size else 0.0
    for k in np.flatnonzero(steps <= 0).tolist():
        before, after = float(time[k]), float(time[k + 1])
        anew = " (a clock that begins anew is another log)" if after < before else ""
        raise table.refusal(f"a time above {before!r} s{anew}", repr(after), lines[k + 1])
    for k in np.flatnonzero(steps > most).tolist():
        expected = f"a time within {most:.3g} s of {float(time[k])!r} s, {MOST_MISSING:.0e} rows on"
        raise table.refusal(expected, repr(float(time[k + 1])), lines[k + 1])


def kept_log(name: str) -> Path:
    """Return the path of a simulated log that the book brings, such as ``push-a``."""
    return data_file(f"simulated/{name}.csv").path
