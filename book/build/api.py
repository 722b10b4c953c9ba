"""Links into the reference: the modules of a package, and what pages name of the code."""

import ast
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.util.inventory import InventoryFile

from book.build.equations import parsed, prose
from book.build.reference import FOLDER, Reference, modules
from book.build.tracing import ROOT


def first_line(name: str) -> str:
    """Return the first line of the docstring of a module or package.

    >>> first_line("softgrip.units")
    'Factors into SI: multiply on the way in, divide on the way out.'
    """
    place = ROOT.joinpath(*name.split("."))
    file = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
    words = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
    return words.partition("\n")[0]


class Api(SphinxDirective):
    """``{api}`` with a package: what it and its modules are, each with a link to the reference."""

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {}

    def run(self) -> list[nodes.Node]:
        """Return a paragraph and a list."""
        package = self.arguments[0]
        found = [f"{prose(first_line(package))} (:py:mod:`{package}`)", ""]
        for name in modules(package):
            self.env.note_dependency(str(ROOT.joinpath(*name.split(".")).with_suffix(".py")))
            found.append(f"- :py:mod:`{name}`: {prose(first_line(name))}")
        made = parsed(self, found)
        made[-1]["classes"].append("modules")
        return made


class Links:
    """From a book into its reference, which is made while the pages run."""

    def start(self, app: Sphinx) -> None:
        """Have it made."""
        self.reference = Reference(Path(app.outdir))

    @cached_property
    def places(self) -> dict[str, str]:
        """Where each object is, by its name."""
        with self.reference.wait().open("rb") as stream:
            found = InventoryFile.load(stream, FOLDER, lambda top, rest: f"{top}/{rest}")
        kinds = [items for kind, items in found.items() if kind.startswith("py:")]
        return {name: place for items in kinds for name, (_, _, place, _) in items.items()}

    def resolve(self, _app: Sphinx, _env: Any, node: Any, words: nodes.Node) -> nodes.Node | None:
        """Link what a page names of the code."""
        if node.get("refdomain") != "py" or node["reftarget"] not in self.places:
            return None
        up = "../" * node["refdoc"].count("/")
        return nodes.reference("", "", words, refuri=up + self.places[node["reftarget"]])

    def finish(self, _app: Sphinx, error: Exception | None) -> None:
        """Have it ready when the book is."""
        if error is None:
            self.reference.wait()


def setup(app: Sphinx) -> None:
    """Add the directive, and connect the links to the stages of a build."""
    app.add_directive("api", Api)
    if (Path(app.srcdir) / "api.md").is_file():
        links = Links()
        app.connect("builder-inited", links.start)
        app.connect("missing-reference", links.resolve)
        app.connect("build-finished", links.finish)
