"""What a search finds: sections, equations, exhibits, printed numbers, terms, names of the code.

All but the names are read from the pages as they are written, so that what is found is what a
reader sees there, verdicts and computed numbers too, and leads to the anchor where it stands.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

from bs4 import BeautifulSoup
from bs4.element import NavigableString, Tag
from docutils.utils.math import tex2unichar


class Kind(StrEnum):
    """What a document is."""

    SECTION = "section"
    EQUATION = "equation"
    EXHIBIT = "exhibit"
    CLAIM = "claim"
    TERM = "term"


@dataclass(frozen=True)
class Document:
    """One thing to be found.

    Attributes:
        kind: What it is.
        place: Address below the folder of the pages.
        title: Its first line among the results.
        section: Place of the section that it is in; empty for the first one of a page.
        text: Where words are looked for after the title, and what an excerpt is taken from.
        label: What names it: a number as printed, or a number with its kind.
        more: Of an equation its ``tex``; of a claim ``recomputed`` and ``outcome``; of a section
            the ``claims`` whose numbers stand in it.
    """

    kind: Kind
    place: str
    title: str
    section: str = ""
    text: str = ""
    label: str = ""
    more: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Name:
    """A name of the reference: its kind, its full name, its page below ``api``, what it is."""

    kind: str
    name: str
    page: str
    words: str


ARTICLE = re.compile(r"<article\b.*</article>", re.DOTALL)
"""The part of a page that is its own."""
HEADINGS = ["h1", "h2", "h3", "h4", "h5", "h6"]
INLINE = {"a", "abbr", "b", "code", "em", "i", "mark", "span", "strong", "sub", "sup"}
UNREAD = {
    *("button", "form", "nav", "noscript", "script"),
    *("select", "style", "summary", "svg", "template"),
}
UNREAD_CLASSES = {
    *("headerlink", "permalink", "cell_input", "highlight", "provenance", "equation-links"),
    *("counts", "ledger", "equations", "glossary", "explorer", "eqno", "modules"),
}
"""What has documents of its own, or what nobody looks for by its words."""
CLAIM = re.compile(r"(?:^|/)ledger\.html#claim-(.+)$")
SIGNS = {
    name: sign
    for group in ("mathalpha", "mathbin", "mathop", "mathord", "mathrel", "mathpunct")
    for name, sign in getattr(tex2unichar, group).items()
}


def plain_math(tex: str) -> str:
    r"""Return TeX as one would type it in a line.

    >>> plain_math(r"\(\tau = E\,\varepsilon^{\,1/n}\)"), plain_math(r"\frac{\mathrm dp}{T_s}")
    ('τ = E ε^1/n', 'dp/T_s')
    """
    tex = re.sub(r"\\[()\[\]]", "", tex)
    tex = re.sub(r"\\(?:mathrm|mathbf|text|operatorname|left|right|bar|hat|dot)\b\s*", "", tex)
    while (less := re.sub(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"\1/\2", tex)) != tex:
        tex = less
    tex = re.sub(r"\\([A-Za-z]+)", lambda it: SIGNS.get(it[1], ""), tex)
    tex = re.sub(r"[{}\\&$]|\\.", "", tex.replace(r"\,", " "))
    return re.sub(r"([_^]) ", r"\1", " ".join(tex.split()))


def _words(node: Tag, top: Tag) -> Iterator[str]:
    for part in node.children:
        if isinstance(part, Tag):
            if part is not top and _is_apart(part):
                continue
            if "math" in part.get_attribute_list("class"):
                yield plain_math(part.get_text())
                continue
            space = "" if part.name in INLINE else " "
            yield space
            yield from _words(part, top)
            yield space
        elif type(part) is NavigableString:  # no comment
            yield part


def _is_apart(part: Tag) -> bool:
    """Tell whether the words of a part are not those of what it stands in."""
    return (
        part.name in UNREAD
        or part.name in ("section", *HEADINGS)
        or not UNREAD_CLASSES.isdisjoint(part.get_attribute_list("class"))
        or bool(part.name in ("figure", "table") and part.find(class_="caption-number"))
        or (part.name == "div" and str(part.get("id", "")).startswith("equation-"))
    )


def words(node: Tag | None) -> str:
    """Return the words of a part of a page, without those that are looked for elsewhere."""
    return " ".join("".join(_words(node, node)).split()) if node else ""


def article(html: str) -> str:
    """Return the part of a page that is its own, without what stands around on every page."""
    found = ARTICLE.search(html)
    return found[0] if found else ""


def documents(page: str, html: str) -> list[Document]:
    """Return what a page has to find, each section before what is in it.

    Args:
        page: Its name, without suffix.
        html: Its `article`.
    """
    found: list[Document] = []
    for section in BeautifulSoup(html, "html.parser").find_all("section", id=True):
        found += _section(f"{page}.html", section)
    return found


def _section(file: str, section: Tag) -> Iterator[Document]:
    heading = section.find(HEADINGS)
    if heading is None or heading.parent is not section:
        return
    place, above = f"{file}#{section['id']}", section.find_parent("section", id=True)
    claims = {
        match[1]: None
        for link in section.find_all("a", href=CLAIM)
        if _stands_in(link) is section and (match := CLAIM.search(str(link["href"])))
    }
    yield Document(
        Kind.SECTION,
        place,
        words(heading),
        f"{file}#{above['id']}" if above else "",
        words(section),
        more={"claims": [*claims]} if claims else {},
    )
    for part in section.find_all(["div", "dl", "figure", "table"]):
        if _stands_in(part) is section:
            yield from _equation(file, place, part)
            yield from _exhibit(file, place, part)
            yield from _claims(file, place, part)
            yield from _terms(file, place, part)


def _stands_in(part: Tag) -> Tag | None:
    """Return the section of a part, or the row of a table that is linked to by itself."""
    for above in part.parents:
        if above.name == "section" or (above.name == "tr" and above.get("id")):
            return above
    return None


def _equation(file: str, section: str, part: Tag) -> Iterator[Document]:
    if part.name == "div" and str(part.get("id", "")).startswith("equation-"):
        number = part.find("span", class_="eqno")
        if number is None:
            return
        label = f"Eq. {number.find(string=True)}"
        tex = "".join(part.find_all(string=True, recursive=False)).strip()
        tex = tex.removeprefix(r"\[").removesuffix(r"\]").strip()
        before = words(part.find_previous_sibling("p", class_=False))
        yield Document(
            Kind.EQUATION, f"{file}#{part['id']}", label, section, before, label, {"tex": tex}
        )


def _exhibit(file: str, section: str, part: Tag) -> Iterator[Document]:
    if part.name not in ("figure", "table") or not part.get("id"):
        return
    if number := part.find(class_="caption-number"):
        label = words(number)
        pictures = (str(picture.get("alt", "")) for picture in part.find_all("img"))
        text = " ".join([words(part).removeprefix(label).strip(), *pictures])
        yield Document(Kind.EXHIBIT, f"{file}#{part['id']}", label, section, text, label)


def _claims(file: str, section: str, part: Tag) -> Iterator[Document]:
    if part.name != "table" or "ledger" not in part.get_attribute_list("class"):
        return
    columns = [head.get("data-sort") for head in part.find_all("th", attrs={"data-sort": True})]
    for row in part.find_all("tr", id=True):
        place = f"{file}#{row['id']}"
        if not row.find("a", class_="permalink", href=place):
            continue  # a copy of a row of the ledger
        cells = dict(zip(columns, row.find_all("td", recursive=False), strict=True))
        printed, recomputed = (words(cells[name]) for name in ("printed", "recomputed"))
        what = str(cells["what"].find(string=True)).strip()
        more = {"recomputed": recomputed, "outcome": words(cells["outcome"])}
        where = str(row.parent["data-place"]) if row.parent else ""
        yield Document(Kind.CLAIM, place, what, section, where, printed, more)


def _terms(file: str, section: str, part: Tag) -> Iterator[Document]:
    """Yield the terms of a glossary, or the rows of a table of symbols."""
    if part.name == "dl" and "glossary" in part.get_attribute_list("class"):
        for term in part.find_all("dt", id=True):
            title, text = words(term), words(term.find_next_sibling("dd"))
            yield Document(Kind.TERM, f"{file}#{term['id']}", title, section, text, title)
    elif part.name == "table" and words(part.find("th")).lower() in ("symbol", "letter"):
        for row in part.select("tbody tr"):
            title, *others = (words(cell) for cell in row.find_all(["td", "th"]))
            place = f"{file}#{row['id']}" if row.get("id") else section
            yield Document(Kind.TERM, place, title, section, "; ".join(filter(None, others)), title)


def names(
    inventory: Mapping[str, Mapping[str, tuple[str, str, str, str]]], told: Mapping[str, str]
) -> list[Name]:
    """Return the names of an inventory of Sphinx, with what their docstrings tell."""
    return [
        Name(kind.removeprefix("py:"), name, place.partition(".html")[0], told.get(name, ""))
        for kind, found in inventory.items()
        if kind.startswith("py:")
        for name, (_, _, place, _) in found.items()
    ]


def index(
    pages: Mapping[str, Iterable[Document]],
    above: Mapping[str, str],
    equations: Mapping[str, str],
    code: Iterable[Name] = (),
) -> dict[str, Any]:
    """Return the index that the search page loads.

    Args:
        pages: The documents of each page, in the order of the book.
        above: The page under which a page stands in the contents.
        equations: What an equation says, by its number.
        code: Names of the reference.

    Returns:
        dict: ``documents``, each a list of kind, place, title, number of the section that it is in
        (-1 without), text, label and what else there is; ``names``, likewise.
    """
    found = [document for documents in pages.values() for document in documents]
    first = {page: next(iter(documents), None) for page, documents in pages.items()}
    number = {d.place: k for k, d in enumerate(found) if d.kind == Kind.SECTION}
    stands: dict[str, list[int]] = {}
    for k, document in enumerate(found):
        for claim in document.more.get("claims", ()):
            stands.setdefault(claim, []).append(k)

    def row(document: Document) -> list[Any]:
        page, _, anchor = document.place.partition(".html#")
        higher = None if document.section else first.get(above.get(page, ""))
        section = document.section or (higher.place if higher else "")
        text, more = document.text, {k: v for k, v in document.more.items() if k != "claims"}
        if document.kind == Kind.EQUATION:
            text = equations.get(document.label.strip("Eq. ()"), text)
        if document.kind == Kind.CLAIM and (places := stands.get(anchor.removeprefix("claim-"))):
            more["stands"] = places
        base = [document.kind, document.place, document.title, number.get(section, -1)]
        return [*base, text, document.label, *([more] if more else [])]

    return {
        "documents": [row(document) for document in found],
        "names": [[*asdict(name).values()] for name in code],
    }


def script(made: Mapping[str, Any]) -> str:
    """Return an index as a script: a page that is opened as a file may fetch nothing."""
    text = json.dumps(made, ensure_ascii=False, separators=(",", ":"))
    return f"window.softgripSearch = {text};\n".replace("</", "<\\/")
