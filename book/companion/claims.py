"""Claims: the numbers that the dissertation prints, one file a chapter in ``data/claims/``.

A claim says where a number stands, what it is, the string that is printed, and on what ground it
can be judged. Where one statement holds for many cells of a table, ``printed`` is a table from
keys to strings, and ``{key}`` in the other fields stands for the key.
"""

import tomllib
from dataclasses import dataclass, field, fields
from typing import Any, Literal, get_args

from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError
from softgrip.provenance import data_file, data_folder

Basis = Literal["inputs", "measurement", "citation"]
Relation = Literal["=", "<", ">"]


@dataclass(frozen=True)
class Band:
    """A sweep of an input that the dissertation leaves open."""

    argument: str
    values: tuple[Any, ...]
    what: str
    """The input and its declared range in words."""


@dataclass(frozen=True)
class Claim:
    """One printed number.

    The ground (``basis``) is what the dissertation gives to recompute it from: its own stated
    ``inputs``, or nothing but a physical ``measurement``, or other literature (``citation``).
    """

    id: str
    chapter: int
    where: str
    what: str
    unit: str
    printed: str
    basis: Basis
    relation: Relation = "="
    """How the recomputed value should stand to the printed one."""
    function: str = ""
    """Name of the function in ``book.chapter_N.numbers`` that recomputes it."""
    arguments: dict[str, Any] = field(default_factory=dict)
    """From stated inputs; without them (``stated = false``) only the assumption is tried."""
    stated: bool = True
    assume: dict[str, Any] = field(default_factory=dict)
    """Arguments that put an assumption in the place of an unstated or misprinted input."""
    assumptions: str = ""
    band: Band | None = None
    note: str = ""


def _fill(value: Any, key: str) -> Any:
    if isinstance(value, str):
        return value.replace("{key}", key)
    if isinstance(value, dict):
        return {name: _fill(item, key) for name, item in value.items()}
    return value


def _id(pattern: str, key: object) -> str:
    slug = "".join(c if c.isalnum() else "-" for c in str(key).lower())
    return pattern.replace("{key}", slug)


def _expand(row: dict[str, Any]) -> list[dict[str, Any]]:
    printed = row["printed"]
    if isinstance(printed, str):
        return [row]
    notes = row.pop("notes", {})
    return [
        {
            **{name: _fill(value, key) for name, value in row.items()},
            "id": _id(row["id"], key),
            "printed": string,
            "note": notes.get(key, row.get("note", "")),
        }
        for key, string in printed.items()
    ]


def _claim(row: dict[str, Any], path: object) -> Claim:
    known = {f.name for f in fields(Claim)}
    if unknown := set(row) - known:
        raise DataFileError(
            path, expected=f"fields among {sorted(known)}", got=f"{sorted(unknown)} in {row['id']}"
        )
    if (basis := row.get("basis")) not in get_args(Basis):
        raise DataFileError(path, expected=f"basis of {get_args(Basis)}", got=f"{basis!r}")
    if band := row.get("band"):
        row = {**row, "band": Band(band["argument"], tuple(band["values"]), band["what"])}
    return Claim(**row)


def read_claims(chapter: int | None = None) -> list[Claim]:
    """Read the claims of a chapter, or of all.

    Raises:
        InvalidInputError: If the chapter has no claims.
        DataFileError: If a file has an unknown field, an unknown basis, or two claims of one id.
    """
    files = sorted(path.name for path in (data_folder() / "claims").glob("chapter_*.toml"))
    if chapter is not None:
        name = f"chapter_{chapter}.toml"
        if name not in files:
            raise InvalidInputError("chapter", expected=f"one with claims: {files}", got=chapter)
        files = [name]
    found: dict[str, Claim] = {}
    for name in files:
        path = data_file(f"claims/{name}").path
        with path.open("rb") as stream:
            rows = tomllib.load(stream)["claim"]
        number = int(path.stem.removeprefix("chapter_"))
        for cell in (cell for row in rows for cell in _expand(row)):
            claim = _claim({**cell, "chapter": number}, path)
            if claim.id in found:
                raise DataFileError(path, expected="ids that differ", got=f"{claim.id} twice")
            found[claim.id] = claim
    return list(found.values())


def claim_of(chapter: int, pattern: str, key: object = "") -> Claim:
    """Return a claim by its id, such as ``table-3.2-top-{key}``, and its key if it is a cell's.

    Raises:
        UnknownNameError: If the chapter has no such claim; the message lists those it has.
    """
    known = {claim.id: claim for claim in read_claims(chapter)}
    if (name := _id(pattern, key)) not in known:
        raise UnknownNameError(f"claim of Chapter {chapter}", name, list(known))
    return known[name]
