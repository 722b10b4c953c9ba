"""No number in a caption or in a page's prose is typed: it is computed, or it is a claim's."""

import re
import tomllib

import pytest

from book.build.typed_numbers import typed, typed_on_page
from book.companion.exhibit import BOOK, chapters
from book.companion.prose import word, words
from softgrip.errors import UnknownNameError

PAGES = {page.stem: page.read_text("utf-8") for page in sorted(BOOK.glob("*.md"))}
ROOMS = {
    # One page or several; of Chapter 1 its captions alone.
    **{one: [page for page in PAGES if re.match(rf"chapter-{one}\b", page)] for one in chapters()},
    "author": ["author"],
    "live": ["commissioning", "protocol", "rig"],
    "companion": ["index", "ledger"],
    "explore": ["change-an-input"],
    "twin": ["one-rig"],
    "beyond.drift": ["beyond-drift"],
    "beyond.design": ["beyond-design"],
    "beyond.delay": ["beyond-delay"],
}
"""Pages by the room that has their computed numbers."""


def test_a_typed_number_is_seen():
    assert typed("within 5 % by Eq. (3.10) of Section 2.3, Design 1") == ["5"]
    assert typed("{{ share }} % of {claim}`5.4-rms` and {glue:text}`x`, $2\\pi$, `a[1]`") == []
    assert typed("see [Table 3.2](page.md#t2) and Figures 2.1, 2.3 and 2.4") == []
    assert typed("On 14 September 2020, Python 3.11 and an INA126: 16 MHz") == ["16"]
    assert typed("three to eighteen times as steep, ten\ndegrees on") == [
        "eighteen times as",
        "ten degrees",
    ]
    assert typed("twice and a half the area in two fifths of the time") == [
        "twice and a half",
        "two fifths",
    ]


def test_a_typed_number_is_told_by_the_line_of_its_paragraph():
    """Front matter, cells, equations and points of lists hold numbers that are none of prose."""
    page = "---\nversion: 0.13\n---\n\n# Title\n\n1. One.\n2. Two is\n   2 mm.\n\n"
    page += "```{code-cell}\nx = 3\n\ny = 4\n```\n\n$$\nx = 5\n$$ (eq-3-1)\n\nsome\n6 N."
    lines = page.splitlines()
    assert [*typed_on_page(page)] == [(7, ["2"]), (lines.index("some") + 1, ["6"])]


@pytest.mark.parametrize("chapter", chapters())
def test_no_number_in_a_caption_is_typed(chapter):
    told = tomllib.loads((BOOK / f"chapter_{chapter}/captions.toml").read_text("utf-8"))
    texts = {f"{title}, {what}": text for title, x in told.items() for what, text in x.items()}
    assert {title: numbers for title, text in texts.items() if (numbers := typed(text))} == {}


@pytest.mark.parametrize("page", PAGES)
def test_no_line_begins_with_the_sign_of_a_comment(page):
    """A line of MyST that begins with a percent sign is left out, whatever it was to say."""
    assert re.findall(r"(?m)^ *%(?!%).*", PAGES[page]) == []


@pytest.mark.parametrize("page", PAGES)
def test_no_number_in_the_prose_of_a_page_is_typed(page):
    assert [*typed_on_page(PAGES[page])] == []


@pytest.mark.parametrize("room", ROOMS)
def test_every_computed_number_stands_somewhere(room):
    captions = BOOK / f"chapter_{room}/captions.toml"
    told = captions.read_text("utf-8") if captions.exists() else ""
    asked = [set(re.findall(r"\{glue:text\}`(\w+)`", PAGES[page])) for page in ROOMS[room]]
    assert set(re.findall(r"\{\{ (\w+) \}\}", told)).union(*asked) == set(words(room))


def test_a_page_with_computed_numbers_is_told_them():
    rooms = {page: room for room, pages in ROOMS.items() for page in pages}
    for page, text in PAGES.items():
        told = re.findall(r"^tell\(\"?([\w.]+)\"?\)$", text, re.MULTILINE)
        assert told == ([rooms[page]] if "{glue:text}" in text else []), page


def test_a_number_that_is_not_there_is_named():
    with pytest.raises(UnknownNameError, match="nowhere"):
        word(2, "nowhere")
    with pytest.raises(UnknownNameError, match="nowhere"):
        word(2, "@nowhere")
