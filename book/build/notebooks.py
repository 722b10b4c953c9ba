"""Each page with code offers itself as a notebook, for who takes one page away.

What only a build knows (numbers in prose, those of figures, titles of pages) stands in it as text.
"""

from ast import literal_eval
from pathlib import Path
from typing import Any

import jupytext
from myst_nb.ext.glue.crossref import read_glue_cache
from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell
from sphinx.application import Sphinx

from book.build.lab_form import has_cells
from book.build.numbering import dotted
from book.build.plain_markdown import Roles, plain, with_boxes
from book.companion.claims import printed_text
from book.companion.ledger_address import row_address

BOOK = "../"
"""Where a notebook finds the built book: it lies in a folder of it."""
HIDDEN = {"remove-input", "hide-input", "remove-cell"}
"""Tags of cells whose code is folded in a notebook."""
KINDS = {"fig": "Figure", "tab": "Table"}


def roles(env: Any, page: str) -> Roles:
    """Return what sets the roles of a page, by what the build knows.

    Args:
        env: Of Sphinx, when all pages are read.
        page: By name; what stands on it is linked within the notebook, all else in the book.
    """
    std, folder = env.get_domain("std"), env.mystnb_config.output_folder
    terms = {name.lower(): at for (kind, name), at in std.objects.items() if kind == "term"}

    def link(words: str, to: str, anchor: str = "") -> str:
        place = "" if to == page and anchor else f"{BOOK}{to}.html"
        return f"[{words}]({place}{anchor and f'#{anchor}'})"

    def numbered(words: str, label: str) -> str:
        return link(
            words or f"{KINDS[label[:3]]} {dotted(label)}",
            std.anonlabels.get(label, (page,))[0],
            label,
        )

    def equation(_: str, label: str) -> str:
        to = env.get_domain("math").equations[label][0]
        return link(f"Eq. ({dotted(label)})", to, label if to == page else f"equation-{label}")

    def section(words: str, label: str) -> str:
        to, anchor = std.anonlabels[label]  # of a box too, which has no title to be called by
        return link(words or std.labels[label][2], to, label if to == page else anchor)

    def term(words: str, name: str) -> str:
        return link(words or name, *terms[name.lower()])

    def document(words: str, name: str) -> str:
        return link(words or env.titles[name].astext(), name)

    def file(words: str, name: str) -> str:
        return f"[{words}]({BOOK}_downloads/{env.dlfiles[name.lstrip('/')][1]})"

    def claim(_: str, name: str) -> str:
        return f"[{printed_text(name)}]({BOOK}{row_address(name)})"

    def told(_: str, name: str) -> str:
        text: str = literal_eval(read_glue_cache(folder, page)[name]["data"]["text/plain"])
        return text

    def paper(words: str, key: str) -> str:
        found = next(c for c in env.get_domain("cite").citations if c.key == key)
        names = [" ".join(person.last_names) for person in found.entry.persons["author"]]
        by = " and ".join(names) if len(names) < 3 else f"{names[0]} et al."
        words = (
            words or f"{by.translate(str.maketrans('', '', '{}'))}, {found.entry.fields['year']}"
        )
        return link(words, found.bibliography_key.docname, found.citation_id)

    return {
        "cite:p": lambda _, keys: f"({'; '.join(paper('', key) for key in keys.split(','))})",
        "cite:t": paper,
        "claim": claim,
        "doc": document,
        "download": file,
        "eq": equation,
        "glue:text": told,
        "math": lambda _, formula: f"${formula}$",
        "numref": numbered,
        "ref": section,
        "term": term,
    }


def notebook(source: Path, known: Roles) -> NotebookNode:
    """Return a page as a notebook.

    Args:
        source: The page.
        known: What sets its roles.
    """
    made: NotebookNode = jupytext.reads(
        with_boxes(source.read_text(encoding="utf-8")), fmt="md:myst"
    )
    words = (
        f"*This is a copy of [a page of the book]({BOOK}{source.stem}.html), to change as you "
        "like. Run all cells first. Numbers within sentences are those of the built book.*"
    )
    made.cells.insert(0, new_markdown_cell(words))  # type: ignore[no-untyped-call]
    for count, cell in enumerate(made.cells):
        cell.id = f"cell-{count}"  # else another one in each build
        if cell.cell_type == "markdown":
            cell.source = plain(cell.source, known, BOOK)
        elif HIDDEN & set(cell.metadata.get("tags", ())):
            cell.metadata["jupyter"] = {"source_hidden": True}
    return made


def offer(app: Sphinx, page: str, _template: str, context: dict[str, Any], _tree: Any) -> None:
    """Write the notebook beside the source of a page, where the theme's button leads."""
    source = Path(app.srcdir) / f"{page}.md"
    if not has_cells(source):
        return
    file = Path(app.outdir) / "_sources" / f"{page}.ipynb"
    file.parent.mkdir(parents=True, exist_ok=True)
    jupytext.write(notebook(source, roles(app.env, page)), file)
    context["ipynb_source"] = file.name


def setup(app: Sphinx) -> None:
    """Connect it before the theme's buttons."""
    app.connect("html-page-context", offer, priority=400)
