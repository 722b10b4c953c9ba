"""Exhibits as a page shows them: numbered, captioned, with their provenance and verdicts.

In the book's build (``SOFTGRIP_BOOK=static``) what is shown is MyST Markdown with a numbered,
referable figure or table; in a notebook it is HTML with the same content.
"""

import html
import re
from base64 import b64encode
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from book.companion.chips import chip, styles
from book.companion.exhibit import Exhibit, exhibit, with_logs
from book.companion.ledger_address import address, in_book
from book.companion.markdown import in_static_book, markdown_table
from book.companion.save import Made, make, numbers, save, svg, table_text
from book.companion.verdict import Outcome, ledger
from softgrip.provenance import Provenance

FOLDER = Path("_build/figures")
"""Where the book's build, which runs pages in the folder of the book, puts their pictures."""

MOST_FILES = 4
"""Data files that a provenance strip names; more are folded."""

ROLE, EMPHASIS = re.compile(r"\{[a-z:]+\}`([^`]*)`"), re.compile(r"\*([^*]+)\*")
"""A MyST role, which is for the book only, and what stands out."""


def _html_table(frame: pd.DataFrame) -> str:
    shown = frame.map(_cell)
    markup = str(shown.to_html(index=False, border=0, escape=False, classes="exhibit"))
    return markup.replace(' style="text-align: right;"', "")


def _cell(value: object) -> str:
    return chip(value, value) if isinstance(value, Outcome) else str(value)


def image(data: bytes, kind: str, alt: str) -> str:
    """Return the HTML of a picture that lies within the page.

    Args:
        data, kind: Content, and its type: png or svg+xml.
        alt: The picture in words.
    """
    return (
        f'<img src="data:image/{kind};base64,{b64encode(data).decode()}" '
        f'alt="{html.escape(alt)}" style="width: 100%; max-width: 640px; background: #fff">'
    )


@dataclass(frozen=True)
class Shown:
    """An exhibit made, with all that stands beside it."""

    exhibit: Exhibit
    made: Made
    numbered: bool = True
    """Whether this is the place that its number names."""

    @cached_property
    def _outcomes(self) -> Counter[Outcome]:
        item = self.exhibit
        if item.drawing or not (item.in_dissertation and self.numbered):
            return Counter()
        entries = ledger(int(item.number.split(".")[0]), [item.title])
        return Counter(entry.outcome for entry in entries)

    def _chip(self, outcome: Outcome, words: str) -> str:
        """Return a label that leads to the numbers printed here that have an outcome."""
        place = self.exhibit.title
        to = address(place=place, outcome=outcome) if self._outcomes[outcome] else ""
        return chip(outcome, words, to)

    def _cell(self, value: object) -> str:
        return self._chip(value, value) if isinstance(value, Outcome) else str(value)

    @cached_property
    def verdicts(self) -> str:
        """The verdicts on the numbers printed at this place, counted."""
        return " ".join(self._chip(found, f"{n} {found}") for found, n in self._outcomes.items())

    def _facts(self) -> list[str]:
        item, data = self.exhibit, self.made.data
        origin = f"Dissertation {item.title}" if item.in_dissertation else "Not in the dissertation"
        files = [f"{f.path.name} ({f.provenance}, sha256 {f.digest})" for f in data]
        if len(files) > MOST_FILES:
            kinds = " and ".join(sorted({str(f.provenance) for f in data}))
            words = f"<summary>{len(files)} files ({kinds})</summary>"
            files = [f"<details>{words}{', '.join(files)}</details>"]
        files += [item.sources] if item.sources else []
        # What is ours and stands on prints alone was not printed.
        ours = not item.in_dissertation and item.provenance is Provenance.PRINTED
        shown, inputs = ("computed here from", " inputs") if ours else ("shown:", "")
        seconds = round(self.made.seconds, 1)
        took = f"in {seconds} s " if seconds else ""
        return [
            f"{origin}",
            f"{shown} <b>{item.provenance}</b>{inputs}",
            *([f"data: {', '.join(files)}"] if files else []),
            *(html.escape(words) for words in item.repairs),
            f"made {took}by <code>{item.command}</code>",
        ]

    def _myst(self) -> str:
        item = self.exhibit
        source = f"{item.make.__module__}.{item.make.__name__}"
        strip = " · ".join(
            filter(
                None,
                [
                    self.verdicts,
                    *self._facts(),
                    f"{{py:func}}`source <{source}>`",
                    ""
                    if item.drawing
                    else f"{{download}}`numbers as CSV </{FOLDER}/{item.name}.csv>`",
                ],
            )
        )
        provenance = f"\n\n::::{{container}} provenance\n{strip}\n::::\n"
        if item.kind == "table":
            rows = markdown_table(self.made.shown, self._cell)
            body = f":::::{{table}} {item.caption}\n:name: {item.label}\n\n{rows}\n:::::"
        else:
            body = (
                f":::::{{figure}} /{FOLDER}/{item.name}.svg\n:name: {item.label}\n"
                f":alt: {item.alt}\n:class: exhibit\n\n{item.caption}\n:::::"
            )
        return body + provenance

    def _html(self) -> str:
        item = self.exhibit
        strip = " · ".join(filter(None, [self.verdicts, *self._facts(), *self._links()]))
        if item.kind == "table":
            body = _html_table(self.made.shown)
        else:
            body = image(svg(self.made.shown), "svg+xml", item.alt)
        words = EMPHASIS.sub(r"<em>\1</em>", html.escape(ROLE.sub(r"\1", item.caption)))
        title = f"<b>{item.title}</b>" if self.numbered else f"As {item.title}:"
        place = f' id="{item.label}"' if self.numbered else ""
        shown = f"{body}<p>{title} {words}</p><p><small>{strip}</small></p>"
        return f"{styles()}<div{place}>{shown}</div>"

    def _links(self) -> list[str]:
        """Return, for a notebook, links to what draws the exhibit and to its numbers."""
        item = self.exhibit
        page = in_book(f"api/_modules/{item.make.__module__.replace('.', '/')}.html")
        links = [f'<a href="{page}#{item.make.__name__}">source</a>']
        if not item.drawing:
            table = self.made.shown if item.kind == "table" else numbers(self.made.shown)
            data = b64encode(table_text(table).encode()).decode()
            to = f'href="data:text/csv;base64,{data}" download="{item.name}.csv"'
            links.append(f"<a {to}>numbers as CSV</a>")
        return links

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        if self.numbered and in_static_book():
            return {"text/markdown": self._myst()}
        return {"text/html": self._html()}


def show(title: str, *, logs: Sequence[Path | str] = (), numbered: bool = True) -> Shown:
    """Make a figure or table and show it with its number, caption and provenance.

    Args:
        title: Such as ``Figure 5.1``.
        logs: Logs of a rig to show in the place of those of the book, by path.
        numbered: Whether this is its place. Elsewhere it leaves the chapter's own, and its number,
            alone.
    """
    item = with_logs(exhibit(title), logs) if logs else exhibit(title)
    made = save(item, FOLDER) if numbered and in_static_book() else make(item)
    return Shown(item, made, numbered)
