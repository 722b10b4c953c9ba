"""A Frictionless description of ``data/``: what each file is, column by column.

``python -m book.build.data_package`` writes ``data/datapackage.json``. Words stand in
``data_package.toml``, by hand; names of columns and types are read from the files, units from the
names or from the words, class and source from the files' heads.
"""

import json
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import softgrip
from softgrip.errors import DataFileError
from softgrip.provenance import Provenance, cells, describe

WORDS = Path(__file__).with_suffix(".toml")
NAME = "datapackage.json"
UNIT = re.compile(r"(.+) \[(.+)\]")
"""A column's name with its unit in brackets."""
NUMBERED = re.compile(r"_(\d+)(?=_|$)")
OURS = {
    "name": "BSD-3-Clause",
    "path": "https://opensource.org/license/bsd-3-clause",
    "title": "BSD 3-Clause License",
}
DISSERTATION = {
    "title": "W.-T. Yang, Development of a Soft Gripper - Sensing, Actuation, and Controls, "
    "PhD dissertation, University of California, Berkeley, 2024"
}
SOURCES = {
    "materials": {
        "title": "Soft Robotics Materials Database (Marechal et al., 2020), Open Database License; "
        "none of its measurements is contained",
        "path": "https://doi.org/10.1089/soro.2019.0115",
    },
    "readings": {
        "title": "Force readings that the dissertation's author published in 2020, without a "
        "licence; none of them is contained"
    },
}


def kind(cells: Iterable[str]) -> str:
    """Return the type that all cells of a column have; empty ones have any.

    >>> kind(["1", ""]), kind(["1", "2.5e-3"]), kind(["1", "x"]), kind([""])
    ('integer', 'number', 'string', 'string')
    """
    found = "string"
    for text in filter(None, cells):
        if found == "string" or (found == "integer" and not re.fullmatch(r"-?\d+", text)):
            found = "integer" if re.fullmatch(r"-?\d+", text) else "number"
        if found == "number":
            try:
                float(text)
            except ValueError:
                return "string"
    return found


def _words(column: str, table: Mapping[str, Any], file: Path) -> str | Sequence[str]:
    """Return the words for a column, or its unit and words."""
    known: Mapping[str, str | Sequence[str]] = table.get("columns", {})
    if column in known:
        return known[column]
    number = NUMBERED.search(column)
    form = column.replace(number[1], "{}", 1) if number else ""
    if words := table.get("numbered", {}).get(form):
        return str(words).replace("{}", number[1] if number else "")
    raise DataFileError(file, expected=f"columns that {WORDS.name} describes", got=column)


def _field(
    name: str, column: Sequence[str], table: Mapping[str, Any], file: Path
) -> dict[str, str]:
    bare, unit = found.groups() if (found := UNIT.fullmatch(name)) else (name, "")
    words = _words(bare, table, file)
    if not isinstance(words, str):
        unit, words = words
    of = table.get("types", {}).get(bare) or kind(column)
    # A quantity that happens to be whole everywhere is none of its kind.
    of = "number" if unit and unit != "count" and of == "integer" else of
    return {"name": name, "type": of, "description": words} | ({"unit": unit} if unit else {})


def _schema(file: Path, table: Mapping[str, Any]) -> dict[str, Any]:
    names, *rows = cells(file)
    columns = list(zip(*rows, strict=True)) if rows else [()] * len(names)
    fields = [_field(*one, table, file) for one in zip(names, columns, strict=True)]
    return {"fields": fields, "missingValues": [""]}


def _head_row(file: Path) -> int:
    """Return the number of the line with the columns' names, from 1: the first of no comment."""
    lines = file.read_text(encoding="utf-8").splitlines()
    return next(k for k, line in enumerate(lines, 1) if not line.startswith("#"))


def _columns_of(file: Path) -> dict[str, Sequence[str]]:
    """Return the units and reasons of parameters, which are the columns of other files."""
    names, *rows = cells(file)
    found = (dict(zip(names, row, strict=True)) for row in rows)
    return {one["name"]: [one["unit"] or "1", one["reason"]] for one in found}


def _title(file: Path, at: int, table: Mapping[str, Any]) -> str:
    if key := table.get("title_from"):
        head = re.search(rf"(?m)^# {key}: (.*)$", file.read_text(encoding="utf-8"))
        return head[1] if head else file.stem
    return str(table["titles"][at] if "titles" in table else table["title"])


def _matching(table: Mapping[str, Any], files: Sequence[str]) -> list[tuple[int, str]]:
    """Return the files of an entry, each with the place of its title."""
    wanted = [table["files"]] if isinstance(table["files"], str) else table["files"]
    found = [
        (k, name) for k, form in enumerate(wanted) for name in files if fnmatchcase(name, form)
    ]
    return [(k, name) for k, (_, name) in enumerate(found)] if len(wanted) == 1 else found


def description(folder: Path, words: Mapping[str, Any]) -> dict[str, Any]:
    """Return the description of a folder.

    Args:
        folder: With CSV and TOML files.
        words: As of ``data_package.toml``.

    Raises:
        DataFileError: If a file is described not once, or a column not at all.
    """
    files = sorted(
        file.relative_to(folder).as_posix()
        for file in folder.rglob("*")
        if file.is_file() and file.name != NAME
    )
    resources: dict[str, dict[str, Any]] = {}
    for table in (*words["table"], *words.get("text", ())):
        if "columns_of" in table:
            table["columns"] = _columns_of(folder / table["columns_of"])
        for at, name in _matching(table, files):
            if name in resources:
                raise DataFileError(folder / name, expected="one description", got="a second")
            file = folder / name
            told, tabular = describe(file), file.suffix == ".csv"
            resources[name] = {
                "name": re.sub(r"[^a-z0-9._-]", "-", name.removesuffix(file.suffix).lower()),
                "path": name,
                "title": _title(file, at, table),
                "description": f"{told.provenance}: {told.source}",
                "format": file.suffix[1:],
                "mediatype": "text/csv" if tabular else "application/toml",
                "encoding": "utf-8",
            }
            if "source" in table or told.provenance is Provenance.PRINTED:
                resources[name]["sources"] = [SOURCES.get(table.get("source"), DISSERTATION)]
            if tabular:
                dialect = {"delimiter": ",", "commentChar": "#", "headerRows": [_head_row(file)]}
                resources[name] |= {
                    "profile": "tabular-data-resource",
                    "dialect": dialect,
                    "schema": _schema(file, table),
                }
    if missing := [name for name in files if name not in resources]:
        raise DataFileError(
            folder, expected=f"files that {WORDS.name} describes", got=", ".join(missing)
        )
    return {
        "profile": "data-package",
        "name": "softgrip-data",
        "title": "Data of softgrip, the executable companion of a dissertation on a soft gripper",
        "description": "Numbers as printed, what was computed from them, and logs of a simulated "
        "rig. The first word of each description says which: printed, public (reduced from what "
        "others measured) or simulated. No file holds a measurement of ours.",
        "version": softgrip.__version__,
        "licenses": [OURS],
        "sources": [DISSERTATION],
        "resources": [resources[name] for name in files],
    }


def text(folder: Path) -> str:
    """Return the description of a folder of data as JSON."""
    words = tomllib.loads(WORDS.read_text(encoding="utf-8"))
    told = json.dumps(description(folder, words), indent=1, ensure_ascii=False)
    # A column each on a line of its own.
    return re.sub(r"\n {6,}|\n {5}(?=\})", " ", told) + "\n"


if __name__ == "__main__":
    from softgrip.provenance import data_folder

    (data_folder() / NAME).write_text(text(data_folder()), encoding="utf-8")
