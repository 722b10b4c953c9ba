"""Each page with code offers itself as a notebook, for who takes one page away."""

from pathlib import Path
from typing import Any

import jupytext
from sphinx.application import Sphinx

from book.build.lab_form import has_cells


def offer(app: Sphinx, page: str, _template: str, context: dict[str, Any], _tree: Any) -> None:
    """Write the notebook beside the source of a page, where the theme's button leads."""
    source = Path(app.srcdir) / f"{page}.md"
    if not has_cells(source):
        return
    notebook = jupytext.read(source)
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"  # else another one in each build
    file = Path(app.outdir) / "_sources" / f"{page}.ipynb"
    file.parent.mkdir(parents=True, exist_ok=True)
    jupytext.write(notebook, file)
    context["ipynb_source"] = file.name


def setup(app: Sphinx) -> None:
    """Connect it before the theme's buttons."""
    app.connect("html-page-context", offer, priority=400)
