"""Every page of the built book, opened in a browser that has no network."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from urllib.parse import parse_qsl, unquote, urlsplit

import jupytext
import nbformat
import pydata_sphinx_theme
import pytest
import tinycss2
from bs4 import BeautifulSoup

from book.build.equations import NUMBERS, pairs

pytestmark = pytest.mark.book

WIDTHS = (1280, 400)


class Visit:
    """A page, opened, with all that it asked for and complained of."""

    def __init__(self, browser, file: Path):
        size = {"width": WIDTHS[0], "height": 900}
        self.context = browser.new_context(viewport=size, offline=True)
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", self._console)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on(
            "requestfailed", lambda request: self.complaints.append(f"missing: {request.url}")
        )
        self.page.goto(file.as_uri())
        self.page.wait_for_timeout(200)  # for what loads behind: fonts, the theme's own scripts

    def _console(self, message):
        if message.type == "error":
            self.complaints.append(message.text)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.context.close()


def pages(html: Path) -> list[Path]:
    """Return the pages, without the theme's templates that lie among its scripts."""
    return sorted(file for file in html.rglob("*.html") if "_static" not in file.parts)


def opened(html: Path) -> list[Path]:
    """Return the pages to open: all of the book's own, and some of the hundreds of source pages.

    Those come from one template, and each takes the browser a second.
    """
    sources = [file for file in pages(html) if "_modules" in file.parts]
    return [file for file in pages(html) if file not in sources] + sources[::20]


CUT = """async () => {
  document.querySelectorAll("article details").forEach((fold) => { fold.open = true; });
  await document.fonts.ready;
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const wide = [...document.querySelectorAll("article .equation, article pre")].filter(
    (it) => it.scrollWidth > it.clientWidth + 1 && it.checkVisibility());
  const silent = wide.filter((it) => !it.classList.contains("scrolls") || it.tabIndex !== 0);
  return [wide.length, silent.map((it) => it.textContent.slice(0, 60))];
}"""
"""Equations and pieces of code wider than their place, folds open: how many, and which say not."""


MATCHED = """(selectors) => selectors.filter((one) => document.querySelector(one))"""
FUNCTION, PSEUDO = re.compile(r"::?[\w-]+\([^()]*\)"), re.compile(r"::?[\w-]+")


def of_document(selector: str) -> str:
    """Return what a selector asks of classes, ids and tags; all that follows a colon is granted.

    >>> of_document(".a:not(.b:has(> .c)) > :first-child + b::before")
    '.a:is(*) > :is(*) + b:is(*)'
    """
    while FUNCTION.search(selector):
        selector = FUNCTION.sub("\0", selector)
    return re.sub("\0+", ":is(*)", PSEUDO.sub("\0", selector))


def selectors(file: Path) -> set[str]:
    """Return what the rules of a style sheet ask of a document, those within ``@media`` too."""

    def of_rules(rules) -> Iterator[str]:
        for rule in rules:
            if rule.type == "qualified-rule":
                commas = groupby(rule.prelude, lambda token: token == ",")
                for part in (list(part) for comma, part in commas if not comma):
                    yield of_document(tinycss2.serialize(part)).strip()
            elif rule.type == "at-rule" and rule.lower_at_keyword in ("media", "supports"):
                yield from of_rules(tinycss2.parse_rule_list(rule.content, True, True))

    sheet = tinycss2.parse_stylesheet(file.read_text(encoding="utf-8"), True, True)
    return set(of_rules(sheet))


def left_out(html: Path) -> list[str]:
    """Return what the theme's rules ask for that the built book's sheet has no more."""
    sheet = "styles/pydata-sphinx-theme.css"
    theme = Path(pydata_sphinx_theme.__file__).parent / "theme/pydata_sphinx_theme/static"
    return sorted(selectors(theme / sheet) - selectors(html / "_static" / sheet))


@dataclass(frozen=True)
class Seen:
    """What a page was once it had loaded: the same visit serves several tests."""

    schemes: set[str]
    complaints: list[str]
    equations: int
    typeset: int
    misread: int
    widths: dict[int, int]
    """Of the document, px, by that of the screen."""
    cut: int
    silent: list[str]
    """Of what is wider than its place on the narrower screen: what has no sign of it."""
    unstyled: list[str]
    """Of the rules of the theme that were left out: what the page has them match."""


@pytest.fixture(scope="module")
def seen(html, browser):
    """Open each page once."""
    gone = left_out(html)

    def look(file: Path) -> Seen:
        with Visit(browser, file) as visit:
            page, widths = visit.page, {}
            for width in WIDTHS:
                page.set_viewport_size({"width": width, "height": 900})
                widths[width] = page.evaluate("document.documentElement.scrollWidth")
            return Seen(
                {urlsplit(url).scheme for url in visit.requests},
                visit.complaints,
                page.locator(".math").count(),
                page.locator(".math .katex").count(),
                page.locator(".katex-error").count(),
                widths,
                *page.evaluate(CUT),
                page.evaluate(MATCHED, gone),
            )

    return {file: look(file) for file in opened(html)}


@pytest.mark.browser
@pytest.mark.usefixtures("local_scripts")
def test_no_page_asks_the_network_or_complains(seen):
    for file, page in seen.items():
        assert page.schemes <= {"file", "data", "blob"}, file
        assert page.complaints == [], file


@pytest.mark.browser
@pytest.mark.usefixtures("local_scripts")
def test_no_rule_of_the_theme_was_left_out_that_matches_a_part_of_a_page(seen, html):
    assert len(left_out(html)) > 3000  # of some 4,800
    assert {file: page.unstyled for file, page in seen.items() if page.unstyled} == {}


@pytest.mark.browser
@pytest.mark.usefixtures("local_scripts")
def test_equations_are_typeset(seen):
    for file, page in seen.items():
        assert page.typeset >= page.equations, file
        assert page.misread == 0, file
    assert sum(page.equations for page in seen.values()) > 10


@pytest.mark.browser
@pytest.mark.usefixtures("local_scripts")
def test_what_is_cut_on_a_narrow_screen_shows_it_and_is_reached_by_the_keyboard(seen):
    own = {file: page for file, page in seen.items() if "_modules" not in file.parts}
    assert {file: page.silent for file, page in own.items() if page.silent} == {}
    assert sum(page.cut for page in own.values()) > 20


@pytest.mark.browser
@pytest.mark.parametrize("width", WIDTHS)
def test_no_page_is_wider_than_the_screen(seen, width):
    for file, page in seen.items():
        if "_modules" not in file.parts:
            assert page.widths[width] <= width, file


@pytest.fixture(scope="module")
def soups(html):
    """The text of each page, read once."""
    return {f.resolve(): BeautifulSoup(f.read_text(), "html.parser") for f in pages(html)}


def test_links_lead_somewhere(soups):
    ids = {file: {tag["id"] for tag in soup.find_all(id=True)} for file, soup in soups.items()}
    choices = {
        (file, f"{choice['name']}={option.text}")
        for file, soup in soups.items()
        for choice in soup.select("form.ledger-filter select")
        for option in choice("option")
    }
    for file, soup in soups.items():
        for link in soup.find_all("a", href=True):
            target = urlsplit(link["href"])
            if target.scheme or target.netloc:
                continue
            path = (file.parent / unquote(target.path)).resolve() if target.path else file
            assert path.exists(), (file.name, link["href"])
            if "=" in target.fragment:  # of the ledger: the rows that a filter leaves
                for name, value in parse_qsl(target.fragment):
                    assert (path, f"{name}={value}") in choices, (file.name, link["href"])
            elif target.fragment and path in ids:
                assert unquote(target.fragment) in ids[path], (file.name, link["href"])


def test_pictures_have_words(soups):
    for file, soup in soups.items():
        for image in soup.find_all("img"):
            assert image.get("alt"), (file.name, image.get("src"))


def test_exhibits_bear_their_own_numbers_and_provenance(html, soups, read_alone):
    from book.companion.exhibit import exhibits
    from softgrip.provenance import data_file

    for item in exhibits():
        place = soups[(html / f"{item.page}.html").resolve()].find(id=item.label)
        assert place is not None, item.title
        caption = place.find(class_="caption-number")
        assert caption.text.strip() == item.title
        strip = place.find_next(class_="provenance").text
        for part in (f"make {item.name}", str(item.provenance)):
            assert part in strip, item.title
        digests = re.findall("sha256 ([0-9a-f]+)", strip)
        assert digests == [data_file(name).digest for name in read_alone[item.title]], item.title


def test_api_page_lists_every_package(root):
    listed = re.findall(r"\{api\} (\S+)", (root / "book" / "api.md").read_text())
    folders = [p.parent for top in ("softgrip", "book") for p in (root / top).rglob("__init__.py")]
    packages = {".".join(folder.relative_to(root).parts) for folder in folders} - {"book"}
    assert sorted(listed) == sorted(packages)


def test_chapters_open_as_notebooks(root):
    for file in (root / "book").glob("*.md"):
        if cells := file.read_text().count("```{code-cell}"):
            found = [cell for cell in jupytext.read(file).cells if cell.cell_type == "code"]
            assert len(found) == cells, file.name


def test_each_page_with_code_offers_itself_as_a_notebook(html, root):
    for file in (root / "book").glob("*.md"):
        if cells := file.read_text().count("```{code-cell}"):
            link = f'href="_sources/{file.stem}.ipynb"'
            assert link in (html / f"{file.stem}.html").read_text(), file.name
            found = nbformat.read(html / "_sources" / f"{file.stem}.ipynb", as_version=4)
            nbformat.validate(found)
            assert sum(cell.cell_type == "code" for cell in found.cells) == cells, file.name


def test_lines_of_code_fit_a_page(root):
    for file in (root / "book").glob("*.md"):
        for cell in jupytext.read(file).cells:
            if cell.cell_type == "code":
                assert max(map(len, cell.source.splitlines()), default=0) <= 80, file.name


def test_each_equation_has_its_links_and_its_row(html, soups):
    soups = {file.relative_to(html.resolve()).as_posix(): soup for file, soup in soups.items()}
    rows = list(soups["equations.html"].select("table.equations tbody tr"))
    assert [row.td.text.strip() for row in rows] == [f"Eq. ({number})" for number in NUMBERS]
    for chapter in html.glob("chapter-*.html"):
        for block in soups[chapter.name].select("div.math[id^=equation-eq-]"):
            number = block["id"].removeprefix("equation-eq-").replace("-", ".")
            links = block.find_next_sibling("p")
            assert links["class"] == ["equation-links"], number
            assert [link.text for link in links("a")] == ["code", "test"], number
            for link, place in zip(links("a"), pairs()[number], strict=True):
                file, _, name = link["href"].partition("#")
                assert name == place.name
                assert place.name.split(".")[-1] in soups[file].find(id=name).text, number
            rows.remove(next(row for row in rows if f"({number})" in row.td.text))
    assert rows == []
