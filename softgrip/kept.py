"""Tables that take long to make and are kept below ``data/``: written and read in one way.

A row is a frozen dataclass; one within it gives its own columns. Below the header that
`softgrip.provenance` asks for stand the columns' names and the rows.
"""

import csv
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from io import StringIO
from pathlib import Path
from typing import Any, Generic, TypeVar, get_type_hints

from softgrip.errors import DataFileError
from softgrip.provenance import Provenance, cells, data_file, data_folder

Row = TypeVar("Row")


def write_data(
    path: Path,
    text: str,
    *,
    source: str,
    notes: str = "",
    provenance: Provenance = Provenance.SIMULATED,
) -> Path:
    """Write a file with its header (notes are lines of their own), and return its path.

    One that says the same already is left alone: who has read it need not look again.
    """
    about = (f"provenance: {provenance}", f"source: {source}", *notes.splitlines())
    content = ("".join(f"# {line}\n" for line in about) + text).encode()
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return path


@cache
def _kinds(row: Any) -> dict[str, Any]:
    hints = get_type_hints(row)
    return {field.name: hints[field.name] for field in fields(row)}


def _names(row: Any) -> Iterator[str]:
    for name, kind in _kinds(row).items():
        yield from _names(kind) if is_dataclass(kind) else (name,)


def _values(row: Any) -> Iterator[object]:
    for name in _kinds(row.__class__):
        value = getattr(row, name)
        yield from _values(value) if is_dataclass(value) else (value,)


def _read(kind: Any, texts: Iterator[str]) -> Any:
    if is_dataclass(kind):
        return kind(*[_read(inner, texts) for inner in _kinds(kind).values()])  # type: ignore[operator, arg-type]
    text = next(texts)
    return kind(text) if kind in (int, float) else text


@dataclass(frozen=True)
class Kept(Generic[Row]):
    """A kept table.

    Attributes:
        file: Path below ``data/``.
        row: Dataclass of a row, of numbers, strings and such dataclasses.
        make: Makes the rows anew.
        source: What does it, such as the command; see `main`.
        notes: Further lines of the header, or what makes them.
        columns: Their names, with units; those of the row's fields without it.
        number: Format of its floats.
        exact: Columns of floats that are written in full: what was asked, not what was found.
        provenance: Class of what is kept.
    """

    file: str
    row: type[Row]
    make: Callable[[], Iterable[Row]]
    source: str
    notes: str | Callable[[], str] = ""
    columns: tuple[str, ...] = ()
    number: str = ".6g"
    exact: tuple[str, ...] = ()
    provenance: Provenance = Provenance.SIMULATED

    def read(self, path: Path | None = None) -> tuple[Row, ...]:
        """Read the table, or another file of its form.

        Raises:
            DataFileError: If its columns are others.
        """
        source = path or data_file(self.file).path
        names, *rows = cells(source)
        if names != self._names():
            raise DataFileError(source, expected=f"the columns {self._names()}", got=f"{names}")
        return tuple(_read(self.row, iter(row)) for row in rows)

    def write(
        self, path: Path | None = None, *, tell: Callable[[Row], object] = lambda _: None
    ) -> Path:
        """Make the table anew, below ``data/`` or elsewhere, and return its path.

        Each row is told when it is made; the file is written when all of them are.
        """
        text = StringIO()
        table = csv.writer(text, lineterminator="\n")
        table.writerow(names := self._names())
        for row in self.make():
            tell(row)
            table.writerow(map(self._text, names, _values(row)))
        return write_data(
            path or data_folder() / self.file,
            text.getvalue(),
            source=self.source,
            notes=self.notes if isinstance(self.notes, str) else self.notes(),
            provenance=self.provenance,
        )

    def main(self) -> None:
        """Make the table anew, as a module's command: rows appear as they are made."""
        print(self.write(tell=lambda row: print(row, flush=True)))

    def _names(self) -> list[str]:
        return [*(self.columns or _names(self.row))]

    def _text(self, name: str, value: object) -> str:
        number = isinstance(value, float) and name not in self.exact
        return format(value, self.number) if number else str(value)
