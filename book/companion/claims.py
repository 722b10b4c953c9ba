"""Claims: the numbers that the dissertation prints, one file a chapter in ``data/claims/``.

A claim says where a number stands, what it is, the string that is printed, and on what basis it
can be judged. Where one statement holds for many cells of a table, ``printed`` is a table from
keys to strings, and ``{key}`` in the other fields stands for the key. A range that is printed is
two claims, one for each end.

Among a claim's arguments a string that is a number is printed, so it is rounded (`Printed`); a
number is exact. ``@`` and an id stand for what another claim prints; as a claim's own print, they
hold the claim against that of another in the same file, so that no number is typed twice. The
file holds the assumptions too that its claims name, and ``sources.toml`` what the author
published elsewhere.
"""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace
from enum import StrEnum
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, TypeVar, get_args

from book.companion.printed import NUMBER, Printed
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError
from softgrip.provenance import data_file, data_folder, describe
from softgrip.reads import remembered


class Basis(StrEnum):
    """What a recomputed number stands on."""

    MODEL = "model"
    """Stated inputs, through a law."""
    PRINT = "print"
    """Other printed numbers: a sum, a ratio, a count, a repeat."""
    AUTHOR = "author"
    """An input that the author published elsewhere."""
    DATA = "data"
    """Public measurements."""
    ASSUMPTION = "assumption"
    """An input that is nowhere printed, or read in another way than it is: written out."""
    RIG = "rig"
    """The simulated rig."""
    NONE = ""
    """Nothing: it can only be taken as it is given."""


Nature = Literal["result", "setting", "part", "measurement", "citation"]
Relation = Literal["=", "~", "<", ">"]


@dataclass(frozen=True)
class Band:
    """A sweep of inputs that the dissertation leaves open."""

    what: str
    """The inputs and their declared ranges in words."""
    argument: str = ""
    values: tuple[Any, ...] = ()
    cases: tuple[dict[str, Any], ...] = ()
    """Instead of values of one argument: those of several, case by case."""
    continuous: dict[str, str] = field(default_factory=dict)
    """Why the number is continuous in an argument, by its name: it then takes all values between
    two neighbouring cases that differ in such arguments alone."""

    @property
    def inputs(self) -> tuple[dict[str, Any], ...]:
        """The arguments of each case."""
        return self.cases or tuple({self.argument: value} for value in self.values)

    @property
    def joined(self) -> tuple[bool, ...]:
        """Whether the number is continuous from each case to the next, one fewer than cases."""
        return tuple(
            all(name in self.continuous for name in {*a, *b} if a.get(name) != b.get(name))
            for a, b in pairwise(self.inputs)
        )


@dataclass(frozen=True)
class Assumption:
    """An input that is nowhere printed, or is read in another way than it is printed."""

    name: str
    text: str
    fitted_to: tuple[str, ...] = ()
    """Ids of the claims whose prints it was chosen by: it cannot judge those."""
    tries: int = 1
    """Readings that were tried before it was chosen."""


@dataclass(frozen=True)
class Source:
    """A file that the author published elsewhere."""

    name: str
    repository: str
    commit: str
    file: str
    sha256: str
    """First 16 hexadecimal digits."""


@dataclass(frozen=True)
class Claim:
    """One printed number."""

    id: str
    chapter: int
    where: str
    what: str
    unit: str
    printed: str
    basis: Basis = Basis.NONE
    nature: Nature = "result"
    """A setting, a part, a measurement or a citation is given if nothing holds against it."""
    relation: Relation = "="
    """How the recomputed value should stand to the printed one; ``~`` if that is printed with
    about, around, approximately or almost."""
    exact: bool = False
    """Whether it is a count or a setting, which nobody has rounded."""
    function: str = ""
    """In ``book.chapter_N.numbers`` or ``book.companion.relations``: what recomputes it."""
    arguments: dict[str, Any] = field(default_factory=dict)
    assumption: str = ""
    """Name of the assumption that ``assume`` puts in words."""
    assume: dict[str, Any] = field(default_factory=dict)
    """Arguments that take an unprinted or misprinted input's place. On any other basis than the
    assumption they are tried beside the stated ones, and judge nothing."""
    author: str = ""
    """Name of the source of an input on the basis ``author``."""
    band: Band | None = None
    regardless: str = ""
    """Why no unprinted input can bring the number out; without it such a number stays open."""
    needs: str = ""
    """Of a given number: what would have to be known to check it."""
    tolerance: float = 1e-6
    """Relative, of the frozen value: what another machine or library may change."""
    note: str = ""
    print_of: str = ""
    """Id of the claim whose print this one is held against, if it has none of its own."""

    @property
    def stands_on(self) -> set[str]:
        """Ids of the other claims whose prints this one is computed from or held against."""
        lender = {self.print_of} if self.print_of else set()
        return (references(self.arguments) | lender) - {self.id}


class Key(str):
    """A cell's key among the arguments: a name, even where it looks like a printed number."""

    __slots__ = ()


def _slug(pattern: str, key: object) -> str:
    slug = "".join(c if c.isalnum() else "-" for c in str(key).lower())
    return pattern.replace("{key}", slug)


def _fill(value: Any, key: str) -> Any:
    if value == "{key}":
        return Key(key)
    if isinstance(value, str):
        return _slug(value, key) if value.startswith("@") else value.replace("{key}", key)
    if isinstance(value, dict):
        return {name: _fill(item, key) for name, item in value.items()}
    if isinstance(value, list):
        return [_fill(item, key) for item in value]
    return value


def _expand(row: dict[str, Any]) -> list[dict[str, Any]]:
    printed = row["printed"]
    if isinstance(printed, str):
        return [row]
    notes = row.pop("notes", {})
    return [
        {
            **{name: _fill(value, key) for name, value in row.items()},
            "id": _slug(row["id"], key),
            "printed": string,
            "note": notes.get(key, row.get("note", "")),
        }
        for key, string in printed.items()
    ]


Kind = TypeVar("Kind")


def _made(kind: type[Kind], row: dict[str, Any], path: Path) -> Kind:
    known = {f.name for f in fields(kind)}  # type: ignore[arg-type]
    if unknown := set(row) - known:
        raise DataFileError(
            path, expected=f"fields among {sorted(known)}", got=f"{sorted(unknown)} in {row}"
        )
    held = {name: tuple(v) if isinstance(v, list) else v for name, v in row.items()}
    return kind(**held)


def _claim(row: dict[str, Any], path: Path) -> Claim:
    if (basis := row.get("basis", "")) not in [*Basis]:
        raise DataFileError(path, expected=f"basis of {[*Basis]}", got=f"{basis!r}")
    if (nature := row.get("nature", "result")) not in get_args(Nature):
        raise DataFileError(path, expected=f"nature of {get_args(Nature)}", got=f"{nature!r}")
    if band := row.get("band"):
        row = {**row, "band": _made(Band, band, path)}
    return _made(Claim, {**row, "basis": Basis(basis)}, path)


def _lent(claims: dict[str, Claim], path: Path) -> dict[str, Claim]:
    """Give the claims that are held against another's print that print."""

    def lent(claim: Claim) -> Claim:
        if not claim.printed.startswith("@"):
            return claim
        lender = claims.get(claim.printed[1:])
        if lender is None or lender.printed.startswith("@"):
            raise DataFileError(
                path, expected="a claim of this file with a print of its own", got=claim.printed
            )
        return replace(claim, printed=lender.printed, exact=lender.exact, print_of=lender.id)

    return {id: lent(claim) for id, claim in claims.items()}


def _unlike(items: Iterable[Kind], name: str, path: Path) -> dict[str, Kind]:
    found: dict[str, Kind] = {}
    for item in items:
        if (key := getattr(item, name)) in found:
            raise DataFileError(path, expected=f"{name}s that differ", got=f"{key} twice")
        found[key] = item
    return found


@remembered
def _file(path: Path) -> tuple[dict[str, Claim], dict[str, Assumption]]:
    chapter = _chapter(describe(path).path)
    with path.open("rb") as stream:
        read = tomllib.load(stream)
    cells = (cell for row in read["claim"] for cell in _expand(row))
    read_in = (_claim({**cell, "chapter": chapter}, path) for cell in cells)
    claims = _lent(_unlike(read_in, "id", path), path)
    named = (_made(Assumption, row, path) for row in read.get("assumption", []))
    assumptions = _unlike(named, "name", path)
    for claim in claims.values():
        if claim.assumption and claim.assumption not in assumptions:
            raise DataFileError(
                path, expected=f"an assumption among {sorted(assumptions)}", got=claim.assumption
            )
    return claims, assumptions


def _chapter(path: Path) -> int:
    return int(path.stem.removeprefix("chapter_"))


def _files() -> dict[int, Path]:
    return _files_in(data_folder() / "claims")


@cache
def _files_in(folder: Path) -> dict[int, Path]:
    return {_chapter(path): path for path in sorted(folder.glob("chapter_*"))}


def read_claims(chapter: int | None = None) -> list[Claim]:
    """Read the claims of a chapter, or of all.

    Raises:
        InvalidInputError: If the chapter has no claims.
        DataFileError: If a file has an unknown field, basis or assumption, or one id twice.
    """
    files = _files()
    if chapter is not None and chapter not in files:
        raise InvalidInputError("chapter", expected=f"one with claims: {[*files]}", got=chapter)
    paths = [path for number, path in files.items() if chapter in (None, number)]
    return [claim for path in paths for claim in _file(path)[0].values()]


def assumptions(chapter: int) -> dict[str, Assumption]:
    """Return the assumptions that the claims of a chapter name, by name."""
    return _file(_files()[chapter])[1]


@remembered
def sources() -> dict[str, Source]:
    """Return the files that the author published elsewhere, by name."""
    path = data_file("claims/sources.toml").path
    with path.open("rb") as stream:
        rows = tomllib.load(stream)["source"]
    return _unlike((_made(Source, row, path) for row in rows), "name", path)


def claim_of(chapter: int, pattern: str, key: object = "") -> Claim:
    """Return a claim by its id, such as ``table-3.2-top-{key}``, and its key if it is a cell's.

    Raises:
        UnknownNameError: If the chapter has no such claim; the message lists those it has.
    """
    known = {claim.id: claim for claim in read_claims(chapter)}
    if (name := _slug(pattern, key)) not in known:
        raise UnknownNameError(f"claim of Chapter {chapter}", name, list(known))
    return known[name]


def claim_by_id(id: str) -> Claim:
    """Return a claim of any chapter.

    Raises:
        UnknownNameError: If there is none of this id.
    """
    # The file of the chapter that the id names comes first: a figure that shows what is printed
    # then has read that file alone.
    for _, path in sorted(_files().items(), key=lambda file: f"{file[0]}." not in id):
        if found := _file(path)[0].get(id):
            return found
    raise UnknownNameError("claim", id, [claim.id for claim in read_claims()])


def approximate(claim: Claim) -> bool:
    """Tell whether a claim's print, or one that it stands on, is printed with a word like about."""
    return "~" in {claim.relation, *(claim_by_id(id).relation for id in claim.stands_on)}


def printed_text(id: str) -> str:
    """Return what a claim of any chapter prints, to the letter.

    Raises:
        UnknownNameError: If there is no such claim.

    >>> printed_text("5.2-materials")
    '10'
    """
    return claim_by_id(id).printed


def printed(id: str) -> Printed:
    """Return what a claim of any chapter prints, as a number; errors as for `printed_text`."""
    claim = claim_by_id(id)
    return Printed(claim.printed, exact=claim.exact)


def resolved(argument: Any) -> Any:
    """Return an argument with its printed numbers as such, those of other claims among them."""
    if isinstance(argument, str):
        if argument.startswith("@"):
            return printed(argument[1:])
        number = NUMBER.fullmatch(argument) and not isinstance(argument, Key)
        return Printed(argument) if number else str(argument)
    if isinstance(argument, dict):
        return {name: resolved(item) for name, item in argument.items()}
    if isinstance(argument, list | tuple):
        return tuple(map(resolved, argument))
    return argument


def references(argument: Any) -> set[str]:
    """Return the ids of the claims that an argument names.

    >>> sorted(references({"part": "@a", "parts": ["@b", "2.5"]}))
    ['a', 'b']
    """
    if isinstance(argument, str):
        return {argument[1:]} if argument.startswith("@") else set()
    inner = argument.values() if isinstance(argument, dict) else argument
    return (
        set().union(*map(references, inner)) if isinstance(argument, dict | list | tuple) else set()
    )
