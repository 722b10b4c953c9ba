"""No number in a caption or in what a page says it found is typed: it is computed, or a claim's."""

import re
import tomllib

import pytest

from book.companion.exhibit import BOOK, chapters
from book.companion.prose import word, words
from softgrip.errors import UnknownNameError

LIST = r"(?:(?:,| and| to| or|-) ?\(?[\d.]+\w?\)?)*"
NOT_NUMBERS = re.compile(
    # Computed, code, symbols, links; then what has a number for a name.
    r"\{\{ \S+ \}\}|\{[\w:]+\}`[^`]*`|`[^`]*`|\$[^$]*\$|\]\([^)]*\)"
    rf"|(?:Sections?|Chapters?|Figures?|Tables?|Eqs?\.) \(?[\d.]+\w?\)?{LIST}"
    r"|Design \d|SPA \d|Ecoflex™? \d\d-\d\d|Dragon Skin \d\d|Mold Star \d\d\w*|SORTA-Clear \d\d"
    r"|NEMA \d\d|[Rr]ow \d\b"
    r"|\b[A-Za-z]+_\d\b|\b[EHRL]_?\d\b"
)


def typed(text: str) -> list[str]:
    """Return the numbers of a text that stand there as such."""
    return re.findall(r"\d[\d.,]*", NOT_NUMBERS.sub("", " ".join(text.split())))


PAGES = {**{chapter: f"chapter-{chapter}.md" for chapter in chapters()}, "author": "author.md"}


def found(page: str) -> str:
    """Return what a page says that it found."""
    text = (BOOK / PAGES[page]).read_text(encoding="utf-8")
    match = re.search(r"\*\*What was found\.?\*\*(.*?)\n(```\{code-cell|## )", text, re.DOTALL)
    assert match, page
    return match[1]


def test_a_typed_number_is_seen():
    assert typed("within 5 % by Eq. (3.10) of Section 2.3, Design 1") == ["5"]
    assert typed("{{ share }} % of {claim}`5.4-rms` and {glue:text}`x`, $2\\pi$, `a[1]`") == []
    assert typed("see [Table 3.2](page.md#t2) and Figures 2.1, 2.3 and 2.4") == []


@pytest.mark.parametrize("chapter", chapters())
def test_no_number_in_a_caption_is_typed(chapter):
    told = tomllib.loads((BOOK / f"chapter_{chapter}/captions.toml").read_text("utf-8"))
    texts = {f"{title}, {what}": text for title, x in told.items() for what, text in x.items()}
    assert {title: numbers for title, text in texts.items() if (numbers := typed(text))} == {}


@pytest.mark.parametrize("page", PAGES)
def test_no_number_in_what_was_found_is_typed(page):
    assert typed(found(page)) == []


@pytest.mark.parametrize("page", PAGES)
def test_every_computed_number_stands_somewhere(page):
    captions = BOOK / f"chapter_{page}/captions.toml"
    told = captions.read_text("utf-8") if captions.exists() else ""
    asked = re.findall(r"\{\{ (\w+) \}\}", told)
    asked += re.findall(r"\{glue:text\}`(\w+)`", (BOOK / PAGES[page]).read_text("utf-8"))
    assert set(asked) == set(words(page))


def test_a_number_that_is_not_there_is_named():
    with pytest.raises(UnknownNameError, match="nowhere"):
        word(2, "nowhere")
    with pytest.raises(UnknownNameError, match="nowhere"):
        word(2, "@nowhere")
