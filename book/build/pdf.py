"""``python -m book.build.pdf``: the built pages as one PDF, printed by Chromium.

Each page is opened as a reader would, so that its equations are set and its sliders stand where
they begin; what then stands there is taken and joined into one document without scripts. So no
page runs again, and all links, bookmarks and tags are Chromium's own. It knows no page numbers
ahead: the document is printed twice, the second time with those of the first in its contents.
"""

import html
import io
import sys
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from sphinx_external_toc.parsing import parse_toc_yaml

from book.build.browser import chromium
from book.build.edition import edition
from book.build.reference import FOLDER as REFERENCE
from book.build.tracing import ROOT

BUILT = ROOT / "book" / "_build"
PDF = BUILT / "softgrip.pdf"
STYLE = Path(__file__).with_suffix(".css")
WIDTH = 658
"""Width of the text on A4, in pixels of CSS: what `STYLE` leaves between the margins."""

TAKE = r"""async ([page, depth]) => {
  await document.fonts.ready;
  for (const image of document.images) image.loading = "eager";
  dispatchEvent(new Event("beforeprint"));
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const article = document.querySelector("article.bd-article");
  article.querySelectorAll("script, noscript, .headerlink, button").forEach((it) => it.remove());
  article.querySelectorAll("details").forEach((it) => { it.open = true; });
  // A reason is as wide as its table, and needs a third of the lines.
  for (const it of article.querySelectorAll("table.numbers td .more")) {
    const row = document.createElement("tr"), cell = row.insertCell(), above = it.closest("tr");
    row.className = "reason";
    cell.colSpan = above.cells.length;
    cell.append(it);
    above.after(row);
  }
  // A section may begin at the foot of a sheet, and its heading on the next: that is its place.
  for (const it of article.querySelectorAll("section[id] > :is(h1, h2, h3, h4):not([id])")) {
    it.id = it.parentElement.id;
    it.parentElement.removeAttribute("id");
  }
  const folder = location.href.slice(0, location.href.lastIndexOf("/") + 1);
  for (const it of article.querySelectorAll("*")) {
    if (it.id) it.id = `${page}:${it.id}`;
    for (const one of it.attributes)
      if (one.value.includes("url(#")) one.value = one.value.replaceAll("url(#", `url(#${page}:`);
    if (it.matches("img")) it.setAttribute("src", it.src);
    if (it.matches("a[href]") && it.href.startsWith(folder)) {
      const [other, place = ""] = it.href.slice(folder.length).split("#");
      it.setAttribute("href", `#${other.replace(/\.html$/, "")}:${decodeURIComponent(place)}`);
    }
  }
  // A page below another one is a part of it.
  const headings = [...article.querySelectorAll("h1, h2, h3, h4")];
  for (const it of depth ? headings : []) {
    const lower = document.createElement(`h${+it.tagName[1] + 1}`);
    for (const { name, value } of it.attributes) lower.setAttribute(name, value);
    lower.append(...it.childNodes);
    it.replaceWith(lower);
  }
  const parts = [...article.querySelectorAll(`h${depth + 1}, h${depth + 2}`)];
  return {
    text: article.innerHTML,
    styles: [...document.querySelectorAll("link[rel=stylesheet]")].map((link) => link.href),
    headings: parts.map((it) => [+it.tagName[1], it.textContent.trim(), it.id]),
  };
}"""
"""What a page shows, with all its ids and the links to pages below names that are its own."""

JOIN = r"""async (width) => {
  for (const link of document.querySelectorAll("a[href^='#']")) {
    const place = link.getAttribute("href").slice(1);
    if (document.getElementById(place)) continue;
    // A place that paper has not, such as the rows that a filter leaves, is on a page that it has.
    const page = place.slice(0, place.indexOf(":") + 1);
    if (document.getElementById(page)) link.setAttribute("href", `#${page}`);
    else if (!link.closest(".provenance")) link.removeAttribute("href");
    else {
      const dot = link.previousSibling;
      if (dot?.data) dot.data = dot.data.replace(/\s*·\s*$/, " ");
      link.remove();
    }
  }
  await Promise.all([...document.images].map((image) => image.decode().catch(() => {})));
  await document.fonts.ready;
  for (const it of document.querySelectorAll("table, .equation, .panels, pre"))
    if (it.scrollWidth > width) it.style.zoom = width / it.scrollWidth;
}"""
"""Lead the links that lead nowhere to a page or to nothing, and shrink what is too wide."""


@dataclass(frozen=True)
class Taken:
    """What a page of the book shows.

    Attributes:
        name, depth: Of the page; 1 is the depth of one below another.
        text: HTML of its article.
        styles: Addresses of its style sheets.
        headings: Level, words and id of those that the contents list.
    """

    name: str
    depth: int
    text: str
    styles: Sequence[str]
    headings: Sequence[tuple[int, str, str]]


def pages() -> list[tuple[str, int]]:
    """Return the pages of the book in their order, each with its depth; the reference stays out.

    >>> pages()[:3]
    [('index', 0), ('chapter-2', 0), ('chapter-2-kind', 1)]
    """
    site = parse_toc_yaml(ROOT / "book" / "_toc.yml")

    def below(name: str, depth: int) -> Iterator[tuple[str, int]]:
        for tree in site[name].subtrees:
            for item in tree.items:
                yield str(item), depth
                yield from below(str(item), depth + 1)

    first = site.root.docname
    return [(first, 0), *(found for found in below(first, 0) if found[0] != REFERENCE)]


def _front(words: dict[str, str]) -> str:
    return (
        '<section class="title-page"><p class="title">softgrip</p>'
        f"<p>{html.escape(words['description'])}</p>"
        f"<p>{html.escape(words['author'])}</p><p>{html.escape(words['edition'])}</p></section>"
    )


def contents(taken: Sequence[Taken], numbers: dict[str, int]) -> str:
    """Return the table of contents as HTML, with the numbers of pages that are known.

    Args:
        taken: The pages.
        numbers: Page of each place, by its id.
    """
    lines = [
        f'<li class="level-{level}"><a href="#{html.escape(place)}">'
        f"<span>{html.escape(words)}</span><b>{numbers.get(place, '')}</b></a></li>"
        for page in taken
        for level, words, place in page.headings
    ]
    return f'<nav class="whole-book"><h1 id="contents">Contents</h1><ul>{"".join(lines)}</ul></nav>'


def joined(taken: Sequence[Taken], words: dict[str, str], numbers: dict[str, int]) -> str:
    """Return the document: title page, contents and pages, with a running head for each chapter.

    Args:
        taken: The pages.
        words: Description, author and edition, for the title page.
        numbers: As `contents` takes them.
    """
    styles = dict.fromkeys([*(style for page in taken for style in page.styles), STYLE.as_uri()])
    articles: list[str] = []
    heads: list[str] = []
    chapter = ""
    for page in taken:
        if not page.depth:
            chapter = f"part-{len(heads)}"
            title = page.headings[0][1].replace("\\", "").replace('"', '\\"')
            heads.append(f'@page {chapter} {{ @top-left {{ content: "{title}" }} }}')
        articles.append(
            f'<article class="bd-article depth-{page.depth}" id="{page.name}:" '
            f'style="page: {chapter}">{page.text}</article>'
        )
    return (
        '<!DOCTYPE html><html lang="en" data-theme="light" data-mode="light"><head>'
        '<meta charset="utf-8"><title>softgrip</title>'
        + "".join(f'<link rel="stylesheet" href="{style}">' for style in styles)
        + f"<style>{''.join(heads)}</style></head><body>{_front(words)}{contents(taken, numbers)}"
        '<main class="bd-main"><div class="bd-content"><div class="bd-article-container">'
        + "".join(articles)
        + "</div></div></main></body></html>"
    )


def places(pdf: bytes) -> dict[str, int]:
    """Return the page, from 1, of each place that a link of a PDF leads to."""
    from pypdf import PdfReader

    reader = PdfReader(io.BytesIO(pdf))
    return {
        unquote(name).lstrip("/"): 1 + (reader.get_destination_page_number(found) or 0)
        for name, found in reader.named_destinations.items()
    }


def take(page: Any, folder: Path, name: str, depth: int) -> Taken:
    """Open a built page in a page of a browser, and return what it shows on paper."""
    page.goto((folder / f"{name}.html").as_uri())
    found = page.evaluate(TAKE, [name, depth])
    headings = [(level, words, place) for level, words, place in found["headings"]]
    return Taken(name, depth, found["text"], found["styles"], headings)


def printed(page: Any, document: str, aside: Path) -> bytes:
    """Print a document that lies aside meanwhile, for its pictures, and return the PDF."""
    aside.write_text(document, encoding="utf-8")
    page.goto(aside.as_uri())
    page.evaluate(JOIN, WIDTH)
    made: bytes = page.pdf(
        prefer_css_page_size=True, print_background=True, outline=True, tagged=True
    )
    return made


def make(folder: Path, pdf: Path, names: Sequence[tuple[str, int]]) -> None:
    """Print built pages as one PDF.

    Args:
        folder: Where the pages are.
        pdf: Where the PDF goes.
        names: Pages with their depths.

    Raises:
        SystemExit: Without Chromium.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    words = {
        "description": project["description"],
        "author": project["authors"][0]["name"],
        "edition": str(edition(ROOT)),
    }
    aside = pdf.with_suffix(".html")
    with chromium() as browser:
        page = browser.new_page(
            viewport={"width": WIDTH, "height": 900}, color_scheme="light", offline=True
        )
        page.set_default_timeout(0)  # a busy machine is no fault of a page
        page.emulate_media(media="print")
        taken = [take(page, folder, *name) for name in names]
        numbers = places(printed(page, joined(taken, words, {}), aside))
        pdf.write_bytes(printed(page, joined(taken, words, numbers), aside))
    aside.unlink()


def main() -> int:
    """Make the PDF of the whole book, and return the exit code."""
    make(BUILT / "html", PDF, pages())
    print(f"The PDF: {PDF.as_uri()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
