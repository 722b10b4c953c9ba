"""What a figure or a table is: its function, and what stands beside it wherever it is shown."""

import re
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial, update_wrapper
from importlib import import_module
from inspect import signature
from pathlib import Path
from typing import Literal, TypeVar

from book.companion.prose import word
from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.provenance import Provenance

Kind = Literal["figure", "table"]
Make = TypeVar("Make", bound=Callable[..., object])


BOOK = Path(__file__).parent.parent
PLACE = re.compile(r"\{\{ (\S+) \}\}")
"""Where a caption has a number: see `book.companion.prose`."""


@lru_cache
def _captions(chapter: str) -> dict[str, dict[str, str]]:
    with (BOOK / f"chapter_{chapter}" / "captions.toml").open("rb") as file:
        return tomllib.load(file)


@dataclass(frozen=True)
class Exhibit:
    """A numbered figure or table of the book; its words stand in its chapter's captions.toml."""

    kind: Kind
    number: str
    """The dissertation's number, such as ``5.1``; letters (``5.A``) for those of our own."""
    make: Callable[..., object]
    provenance: Provenance
    """Class of what is shown; the data files that it is made from have their own."""
    sources: str = ""
    """Data that are not files of the project, in words."""
    drawing: bool = False
    """Whether it is a drawing, such as a block diagram, with no numbers to give as CSV."""
    repairs: tuple[str, ...] = ()
    """What was mended or is missing in the reader's own logs, one sentence each."""
    logs: tuple[Path, ...] = ()
    """What a reader put in the place of the book's logs."""

    @property
    def caption(self) -> str:
        """What is shown, as MyST Markdown."""
        return self._words("caption")

    @property
    def alt(self) -> str:
        """The picture in words, for those who do not see it; none for a table."""
        return self._words("alt")

    def _words(self, what: str) -> str:
        chapter = self.number.partition(".")[0]
        known = _captions(chapter)
        if self.title not in known:
            raise UnknownNameError("caption", self.title, list(known))
        text = " ".join(known[self.title].get(what, "").split())
        return PLACE.sub(lambda place: word(chapter, place[1]), text)

    @property
    def name(self) -> str:
        """File name without ending."""
        return f"{self.kind}-{self.number.replace('.', '-').lower()}"

    @property
    def label(self) -> str:
        """Label for cross-references in the book."""
        return f"{self.kind[:3]}-{self.number.replace('.', '-').lower()}"

    @property
    def title(self) -> str:
        """Such as ``Figure 5.1``."""
        return f"{self.kind.capitalize()} {self.number}"

    @property
    def in_dissertation(self) -> bool:
        """Whether the dissertation has it, or it is ours."""
        return self.number.split(".")[1].isdigit()

    @property
    def page(self) -> str:
        """The page that shows it, by the name of its file; a chapter may have several."""
        cell = f'\nshow("{self.title}"'
        return next(
            page.stem for page in sorted(BOOK.glob("*.md")) if cell in page.read_text("utf-8")
        )

    @property
    def command(self) -> str:
        """The command that makes this exhibit alone."""
        return f"make {self.name}"


EXHIBITS: dict[tuple[Kind, str], Exhibit] = {}


def chapters() -> list[str]:
    """Return the numbers of the chapters that have a folder."""
    return sorted(folder.name.removeprefix("chapter_") for folder in BOOK.glob("chapter_*"))


def _register(
    kind: Kind, number: str, provenance: Provenance, sources: str, drawing: bool = False
) -> Callable[[Make], Make]:
    def keep(make: Make) -> Make:
        EXHIBITS[kind, number] = Exhibit(kind, number, make, provenance, sources, drawing)
        return make

    return keep


def figure(
    number: str,
    provenance: Provenance,
    *,
    sources: str = "",
    drawing: bool = False,
) -> Callable[[Make], Make]:
    """Register a function that returns a matplotlib Figure.

    Args:
        number: The dissertation's number, or chapter and a letter.
        provenance: Class of what is drawn.
        sources: Data that are not files below ``data/``, in words; those are found out when it is
            made.
        drawing: Whether no numbers stand behind it.
    """
    return _register("figure", number, provenance, sources, drawing)


def table(number: str, provenance: Provenance, *, sources: str = "") -> Callable[[Make], Make]:
    """Register a function that returns a pandas DataFrame; parameters as for `figure`."""
    return _register("table", number, provenance, sources)


def _register_chapter(chapter: str) -> None:
    """Import the files of a chapter that hold figures and tables: their names say so."""
    for pattern in ("diagram*.py", "figures*.py", "tables*.py"):
        for file in sorted((BOOK / f"chapter_{chapter}").glob(pattern)):
            import_module(f"book.chapter_{chapter}.{file.stem}")


def exhibit(title: str) -> Exhibit:
    """Find a figure or table by its title, importing its chapter's files only.

    Args:
        title: Such as ``Figure 5.1``.

    Raises:
        UnknownNameError: If there is none; the message lists those of the chapter, or all.
    """
    kind, _, number = title.lower().partition(" ")
    chapter = number.partition(".")[0]
    if chapter in chapters():
        _register_chapter(chapter)
    known = list(EXHIBITS.values()) if chapter in chapters() else exhibits()
    for found in known:
        if (found.kind, found.number.lower()) == (kind, number):
            return found
    raise UnknownNameError("figure or table", title, [found.title for found in known])


def with_logs(item: Exhibit, logs: Sequence[Path | str] | Path | str) -> Exhibit:
    """Return an exhibit made from another log or logs, of which it then has the provenance.

    It says what the reader of logs mended in them, and where rows are missing.

    Raises:
        InvalidInputError: If the exhibit is not made from logs, or no log is given.
        DataFileError: If a log cannot be read.
    """
    if isinstance(logs, str | Path):
        logs = [logs]
    if "logs" not in signature(item.make).parameters or not logs:
        raise InvalidInputError("logs", expected=f"none for {item.title}", got=[*map(str, logs)])
    paths = tuple(Path(log) for log in logs)
    made = update_wrapper(partial(item.make, logs=paths), item.make)
    read = [read_log(path) for path in paths]
    repairs = [
        f"{path.name}: {words}"
        for path, log in zip(paths, read, strict=True)
        for words in log.repairs
    ]
    return replace(
        item,
        make=made,
        logs=paths,
        provenance=read[0].header.provenance,
        repairs=tuple(repairs),
    )


def exhibits() -> list[Exhibit]:
    """Return every figure and table of every chapter."""
    for chapter in chapters():
        _register_chapter(chapter)
    return list(EXHIBITS.values())
