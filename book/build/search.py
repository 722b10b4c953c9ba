"""The search: one page for the book and its reference, which finds what `search_index` has read.

It takes the place of Sphinx's own, which finds whole pages, and no number with a point. As pages
that are opened as files may fetch nothing, its index is a script, which that page alone loads.
"""

import ast
import hashlib
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.search import IndexBuilder
from sphinx.util.inventory import InventoryFile

from book.build import search_index, vendor
from book.build.equations import documented, pairs
from book.build.reference import CODE, FOLDER, INVENTORY, STAMP
from book.build.tracing import ROOT

PAGE = "search"
OWN = ROOT / "book" / "_search"
"""Script and style of the page; what lies in ``_static`` all pages load."""
INDEX, STEMMER = "search_index.js", "stemmer.js"
LAST = 900
"""Priority of what happens when all else of a build has."""


def add_page(_app: Sphinx, config: Any) -> None:
    """Have the page written with the others."""
    config.html_static_path.append(str(OWN))
    config.html_additional_pages[PAGE] = f"{PAGE}.html"


def equip(app: Sphinx, page: str, _template: str, context: dict[str, Any], _tree: Any) -> None:
    """Lead each page to the search, and give that page what it needs."""
    context["search_address"] = context["pathto"](PAGE)
    if page != PAGE:
        return
    folder = Path(app.srcdir) / "_vendor"
    katex, minisearch = (vendor.address(folder, p) for p in (vendor.EQUATIONS, vendor.SEARCH))
    context["title"] = "Search"
    context["search_scripts"] = [katex, minisearch, STEMMER, INDEX, f"{PAGE}.js"]
    for style in (vendor.address(folder, vendor.EQUATIONS, 1), f"{PAGE}.css"):
        app.add_css_file(style)


def contents(includes: dict[str, list[str]], page: str) -> Iterator[tuple[str, str]]:
    """Yield the pages below one with the page that each stands under, in the order of the book.

    >>> [*contents({"a": ["b", "d"], "b": ["c"]}, "a")]
    [('b', 'a'), ('c', 'b'), ('d', 'a')]
    """
    for below in includes.get(page, ()):
        yield below, page
        yield from contents(includes, below)


def plain(doc: str) -> str:
    """Return the first line of a docstring without its marks of code."""
    return doc.partition("\n")[0].replace("`", "")


def first_lines() -> dict[str, str]:
    """Return the first lines of all docstrings, by full name."""
    found = {}
    for folder in CODE:
        for file in (ROOT / folder).rglob("*.py"):
            module = ".".join(file.relative_to(ROOT).with_suffix("").parts)
            tree = ast.parse(file.read_text(encoding="utf-8"))
            found[module.removesuffix(".__init__")] = ast.get_docstring(tree) or ""
        found |= {f"{module}.{name}": doc for module, name, doc in documented(folder)}
    return {name: plain(doc) for name, doc in found.items()}


def names(reference: Path) -> list[search_index.Name]:
    """Return the names of a reference; none where there is no reference."""
    if not (reference / INVENTORY).is_file():
        return []
    with (reference / INVENTORY).open("rb") as stream:
        inventory = InventoryFile.load(stream, "", lambda _, place: place.lstrip("/"))
    return search_index.names(inventory, first_lines())


class Kept:
    """What was read of pages that have not changed since, by page.

    Args:
        file: Where it is kept.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        self.code = Path(search_index.__file__).read_bytes() + Path(__file__).read_bytes()
        try:
            self.former: dict[str, Any] = pickle.loads(file.read_bytes())
        except (OSError, ValueError, EOFError, AttributeError, ImportError, pickle.PickleError):
            self.former = {}
        self.current: dict[str, Any] = {}

    def get(self, name: str, source: str, read: Any) -> Any:
        """Return what was kept of a source, or else what is read of it."""
        key = hashlib.sha256(source.encode() + self.code).hexdigest()
        kept = self.former.get(name)
        self.current[name] = kept if kept and kept[0] == key else (key, read())
        return self.current[name][1]

    def write(self) -> None:
        """Keep what was asked for, and no more."""
        if self.current != self.former:
            self.file.write_bytes(pickle.dumps(self.current))


def write_index(app: Sphinx, error: Exception | None) -> None:
    """Write the index of the pages as they are."""
    if error or app.builder.name != "html":
        return
    pages, root = Path(app.outdir), app.config.root_doc
    above = dict(contents(app.env.toctree_includes, root))
    kept, found = Kept(pages.parent / "search.pickle"), {}
    for page in [root, *above]:
        article = search_index.article((pages / f"{page}.html").read_text(encoding="utf-8"))
        found[page] = kept.get(
            page, article, lambda page=page, text=article: search_index.documents(page, text)
        )
    stamp = pages / FOLDER / STAMP
    source = stamp.read_text() if stamp.is_file() else ""
    code = kept.get(FOLDER + "/", source, lambda: names(pages / FOLDER))
    kept.write()
    words = {number: plain(owner.words) for number, (owner, _) in pairs().items()}
    # The book's own page is above all others, and says nothing of where one is.
    nearest = {page: over for page, over in above.items() if over != root}
    made = search_index.script(search_index.index(found, nearest, words, code))
    (pages / "_static" / INDEX).write_text(made, encoding="utf-8")
    stemmer = IndexBuilder(app.env, "en", {}, "").get_js_stemmer_code()
    (pages / "_static" / STEMMER).write_text(stemmer, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Connect the page to the stages of a build."""
    app.connect("config-inited", add_page)
    app.connect("html-page-context", equip)
    app.connect("build-finished", write_index, priority=LAST)
