"""``python -m book.build.sentences``: the twenty sentences of the pages that are hardest to read.

Two things make a sentence hard that a machine can see: its length, and an opening that puts last
what the sentence is about. The list says where to look; whether a sentence is bad is for a reader.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from markdown_it import MarkdownIt

from book.build.tracing import ROOT

SHOWN = 20
"""Sentences of the list."""
INVERSION = 15
"""Words that an inverted opening counts for."""
SHORT = 5
"""Words of a sentence that may begin as it likes: the lead of a paragraph."""

MARKED = re.compile(r"\{[\w:]+\}`(?:[^`<]*?)(?: ?<[^`>]*>)?`|`[^`]*`|\$[^$]+\$")
"""Roles, code and formulas: one word each, however they are written."""
MATH_BLOCK = re.compile(r"^\$\$.*?^\$\$[^\n]*$", re.DOTALL | re.MULTILINE)
DIRECTIVE = re.compile(r"^ *(?::::.*|:[\w-]+:.*)$", re.MULTILINE)
END = re.compile(r"(?<=[.!?])[)\"*]* +(?=[A-Z({\"*\[])")
SHORT_FORM = re.compile(r"\b(?:Eqs?|Fig|No|e\.g|i\.e|cf|vs)\.$")
INVERTED = re.compile(
    r"What\b(?!.*\?$)|(?:Nor|Never|Not|Hardly|Rarely|Seldom|Such|Neither)\b"
    r"|(?:Of|Beside|Below|Under|Above|Among|To|From|With|By|In|On|At) [^,]{0,40}?"
    r" (?:stands?|lies|lie|comes?|goes|go|belongs?|hangs?)\b"
    r"|Only (?:when|where|then|if|by|at|in|of)\b"
)


@dataclass(frozen=True)
class Sentence:
    """A sentence of a page.

    Attributes:
        page: Its name.
        text: As it stands there, with roles and formulas as they are written.
    """

    page: str
    text: str

    @property
    def words(self) -> int:
        """How many words it has; a formula or a role is one."""
        return len(MARKED.sub("x", self.text).split())

    @property
    def inverted(self) -> bool:
        """Whether it opens with what belongs at its end."""
        return self.words > SHORT and INVERTED.match(self.text.lstrip("*")) is not None

    @property
    def weight(self) -> int:
        """How hard it is to read, in words."""
        return self.words + INVERSION * self.inverted


def sentences(page: str, text: str) -> Iterator[Sentence]:
    """Yield the sentences of a page's prose: paragraphs, lists and cells of tables.

    Args:
        page: Its name.
        text: Its source, MyST Markdown. Code, displayed equations and options are left out.

    >>> [one.text for one in sentences("page", "One, by Eq. (2). *Two* `a. b`!")]
    ['One, by Eq. (2).', '*Two* `a. b`!']
    """
    body = re.sub(r"\A---\n.*?\n---\n", "", text, flags=re.DOTALL)
    body = DIRECTIVE.sub("\n", MATH_BLOCK.sub("\n", body))
    tokens = MarkdownIt("commonmark").enable("table").parse(body)
    for before, token in pairwise(tokens):
        if token.type != "inline" or before.type == "heading_open":
            continue
        kept = " ".join(token.content.split())
        # A full stop within a role or a formula ends no sentence.
        whole = MARKED.sub(lambda m: m[0].replace(". ", ".\0"), kept)
        found = ""
        for part in END.split(whole):
            found = f"{found} {part}".strip()
            if not SHORT_FORM.search(found):
                yield Sentence(page, found.replace("\0", " "))
                found = ""
        if found:
            yield Sentence(page, found.replace("\0", " "))


def all_sentences(folder: Path = ROOT / "book") -> list[Sentence]:
    """Return the sentences of all pages in a folder."""
    pages = sorted(folder.glob("*.md"))
    return [one for page in pages for one in sentences(page.stem, page.read_text("utf-8"))]


if __name__ == "__main__":
    every = all_sentences()
    for one in sorted(every, key=lambda one: -one.weight)[:SHOWN]:
        opening = ", inverted" if one.inverted else ""
        print(f"{one.page}, {one.words} words{opening}:\n  {one.text}")
    inverted = sum(one.inverted for one in every)
    mean = sum(one.words for one in every) / len(every)
    print(f"{len(every)} sentences of {mean:.1f} words in the mean; {inverted} open inverted.")
