"""The PDF of some pages: bookmarks, figures with captions, reasons, code, links, nothing cut."""

import io
import re
import unicodedata
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from pypdf import PdfReader
from pypdf.generic import ArrayObject, DictionaryObject

from book.build import browser, pdf

pytestmark = [pytest.mark.book, pytest.mark.browser]

# What ends to the right of its place, if it is seen: the MathML of KaTeX is there to be heard, and
# what is drawn in a plot ends where the plot does.
CUT = """(width) => [...document.querySelectorAll("article *")]
  .filter((it) => !it.closest(".katex-mathml, svg svg, svg *"))
  .filter((it) => it.getBoundingClientRect().right > width + 1 || (it.clientWidth
    && it.scrollWidth > it.clientWidth + 1 && getComputedStyle(it).overflowX !== "visible"))
  .map((it) => `${it.tagName} ${it.className}: ${it.textContent.slice(0, 60)}`)"""


def bare(text: str) -> str:
    """Return a text without what the setting of lines changes: spaces, and forms of letters."""
    return re.sub(r"\s+", "", unicodedata.normalize("NFKC", text))


@dataclass(frozen=True)
class Printed:
    """The PDF of some pages, the pages as they were built, and what of them would be cut."""

    pages: list[BeautifulSoup]
    taken: list[pdf.Taken]
    reader: PdfReader
    cut: list[str]
    alone: list[str]

    @cached_property
    def texts(self) -> list[str]:
        """Text of each sheet, bare."""
        return [bare(page.extract_text()) for page in self.reader.pages]

    @cached_property
    def text(self) -> str:
        """All of it, without running heads and numbers, which may come between two lines."""
        heads = {bare(page.headings[0][1]) for page in self.taken}
        return "".join(
            text.removesuffix(str(k)).removeprefix(next(filter(text.startswith, heads), ""))
            for k, text in enumerate(self.texts, 1)
        )


def sample(html: Path) -> list[tuple[str, int]]:
    """Return the front page, a short page with all that a chapter has, and one below another."""
    texts = {name: (html / f"{name}.html").read_text(encoding="utf-8") for name, _ in pdf.pages()}
    order = sorted(pdf.pages(), key=lambda page: len(texts[page[0]]))
    whole = (
        'class="explorer"',
        "ledger numbers",
        'class="math',
        "<figcaption",
        "highlight-ipython3",
    )
    chapter = next(page for page in order if all(part in texts[page[0]] for part in whole))
    below = next(page for page in order if page[1] and page != chapter)
    chosen = {pdf.pages()[0][0], chapter[0], below[0]}
    return [(name, depth) for name, depth in pdf.pages() if name in chosen]


@pytest.fixture(scope="module")
def made(html, browser, tmp_path_factory) -> Printed:
    names = sample(html)
    page = browser.new_page(viewport={"width": pdf.WIDTH, "height": 900}, offline=True)
    page.set_default_timeout(0)  # a busy machine is no fault of a page
    page.emulate_media(media="print", color_scheme="dark")
    taken, alone = [], []
    for name, depth in names:
        taken.append(pdf.take(page, html, name, depth))
        page.reload()
        page.wait_for_load_state()
        alone += page.evaluate(CUT, pdf.WIDTH)
    aside = tmp_path_factory.mktemp("pdf") / "book.html"
    words = {"description": "Some pages", "author": "Nobody", "edition": str(pdf.edition(pdf.ROOT))}
    first = pdf.printed(page, pdf.joined(taken, words, {}), aside)
    second = pdf.printed(page, pdf.joined(taken, words, pdf.places(first)), aside)
    cut = page.evaluate(CUT, pdf.WIDTH)
    page.close()
    pages = [
        BeautifulSoup(
            (html / f"{name}.html").read_text(encoding="utf-8"), "html.parser"
        ).select_one("article")
        for name, _ in names
    ]
    return Printed(pages, taken, PdfReader(io.BytesIO(second)), cut, alone)


def outline(entries, level=1) -> list[tuple[int, str, object]]:
    found = []
    for entry in entries:
        if isinstance(entry, list):
            found += outline(entry, level + 1)
        else:
            found.append((level, bare(entry.title), entry))
    return found


def words(tag) -> str:
    """Return the words of a heading, without the sign of its link."""
    return "".join(tag.find_all(string=True)).removesuffix("#")


def tagged(item):
    """Yield all elements of the structure of a PDF below one."""
    item = item.get_object()
    if isinstance(item, ArrayObject):
        for one in item:
            yield from tagged(one)
    elif isinstance(item, DictionaryObject):
        yield item
        if "/K" in item:
            yield from tagged(item["/K"])


@pytest.mark.usefixtures("local_scripts")
class TestPdf:
    def test_headings_are_bookmarks_below_those_of_their_chapter(self, made):
        expected = [
            (int(heading.name[1]) + page.depth, bare(words(heading)))
            for page, soup in zip(made.taken, made.pages, strict=True)
            for heading in soup.select("h1, h2, h3, h4")
        ]
        found = [(level, title) for level, title, _ in outline(made.reader.outline)]
        assert found == [(1, "Contents"), *expected]

    def test_contents_name_the_page_on_which_a_heading_stands(self, made):
        numbers = {
            title: made.reader.get_destination_page_number(entry) + 1
            for _, title, entry in outline(made.reader.outline)
        }
        listed = "".join(
            made.texts[1 : min(numbers[bare(p.headings[0][1])] for p in made.taken) - 1]
        )
        for page in made.taken:
            for _, title, _ in page.headings:
                number = numbers[bare(title)]
                assert f"{bare(title)}{number}" in listed
                assert bare(title) in made.texts[number - 1]

    def test_a_figure_stands_on_one_sheet_with_its_caption(self, made):
        sheets = {page.indirect_reference.idnum: k for k, page in enumerate(made.reader.pages)}
        captions = [
            bare(caption.text.removesuffix("#"))
            for soup in made.pages
            for caption in soup.select("figure > figcaption .caption-number")
        ]
        root = made.reader.trailer["/Root"]["/StructTreeRoot"]
        found = []
        for figure in [it for it in tagged(root["/K"]) if it.get("/S") == "/Figure"]:
            pictures = [it for it in tagged(figure) if it.get("/Alt")]
            if pictures and not figure.get("/Alt"):
                on = {sheets[it.raw_get("/Pg").idnum] for it in tagged(figure) if "/Pg" in it}
                assert len(on) == 1, pictures[0]["/Alt"]
                found.append(made.texts[on.pop()])
        assert len(found) == sum(
            len(soup.select("figure:has(img, .panels)")) for soup in made.pages
        )
        for caption in captions:
            assert any(caption in text for text in found), caption

    def test_reasons_and_what_is_folded_are_open(self, made):
        folded = [
            fold
            for soup in made.pages
            for fold in soup.select(
                "table.ledger details > div, .admonition.dropdown > p, details.hide"
            )
        ]
        assert folded
        for fold in folded:
            for summary in fold.select("summary"):
                summary.decompose()
            # Formulas are set in the print, and marks stand behind numbers: the text has neither.
            for other in fold.select(".math, a.claim"):
                other.replace_with("\0")
            for words in fold.get_text().split("\0"):
                assert bare(words) in made.text

    def test_no_line_of_code_is_lost(self, made):
        lines = [
            line
            for soup in made.pages
            for code in soup.select(".cell_input pre, .highlight-sh pre, .highlight-python pre")
            for line in code.get_text().splitlines()
        ]
        assert lines
        assert [line for line in lines if bare(line) not in made.text] == []

    def test_nothing_is_cut(self, made):
        assert made.cut == []

    def test_nothing_is_cut_on_a_page_that_a_reader_prints(self, made):
        assert made.alone == []

    def test_sliders_say_that_they_move_in_the_page(self, made):
        sliders = sum(len(soup.select("figure.explorer")) for soup in made.pages)
        assert made.text.count(bare("The sliders of this figure move in the page")) == sliders > 0

    def test_links_between_pages_lead_within_the_pdf(self, made):
        within, outside = set(), []
        for page in made.reader.pages:
            for note in page.get("/Annots", []):
                note = note.get_object()
                if "/Dest" in note:
                    within.add(str(note["/Dest"]).lstrip("/"))
                elif "/A" in note and "/URI" in note["/A"]:
                    outside.append(note["/A"]["/URI"])
        assert {f"{page.name}:" for page in made.taken} & within
        assert within <= {name.lstrip("/") for name in made.reader.named_destinations}
        assert [uri for uri in outside if not uri.startswith(("http", "mailto"))] == []

    def test_the_title_page_names_the_edition(self, made):
        assert bare(str(pdf.edition(pdf.ROOT))) in made.texts[0]
        assert made.reader.metadata.title == "softgrip"


def test_the_pages_are_those_of_the_book(html):
    built = {file.stem for file in html.glob("*.html")} - {"genindex", "search"}
    assert {name for name, _ in pdf.pages()} == built - {"api"}


def test_without_chromium_it_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setattr(browser.shutil, "which", lambda _: None)
    with pytest.raises(SystemExit, match="apt-get install chromium"):
        pdf.make(tmp_path, tmp_path / "book.pdf", [])
