"""The API page: a directive that documents all modules of a folder, from their docstrings."""

from types import UnionType
from typing import Any, ClassVar, TypeVar, get_origin

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from book.build.tracing import ROOT

INHERITED = {"set_score_request"}
"""What scikit-learn adds to a regressor, without a docstring that Sphinx could read."""


def modules(package: str) -> list[str]:
    """Return the modules of a package, without those below its sub-packages.

    >>> modules("softgrip")[:3]
    ['softgrip.arrays', 'softgrip.checks', 'softgrip.errors']
    """
    folder = ROOT.joinpath(*package.split("."))
    names = sorted(file.stem for file in folder.glob("*.py"))
    return [f"{package}.{name}" for name in names if not name.startswith("__")]


class Api(SphinxDirective):
    """``{api}`` with a package: its docstring, then its modules with their members."""

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {}

    def run(self) -> list[nodes.Node]:
        """Return what autodoc makes of the modules."""
        package = self.arguments[0]
        lines = ["```{eval-rst}", f".. automodule:: {package}", ""]
        for name in modules(package):
            self.env.note_dependency(str(ROOT.joinpath(*name.split(".")).with_suffix(".py")))
            lines += [f".. automodule:: {name}", "   :members:", ""]
        place = nodes.container()
        self.state.nested_parse(StringList([*lines, "```"], package), 0, place)
        return [*place.children]


def skip(_app: Sphinx, what: str, name: str, found: object, _skip: bool, _: object) -> bool | None:
    """Leave out names of types, which say nothing that their module does not."""
    alias = found is Any or isinstance(found, TypeVar | UnionType) or get_origin(found) is not None
    return True if (what == "module" and alias) or name in INHERITED else None


def setup(app: Sphinx) -> None:
    """Add the directive."""
    app.setup_extension("sphinx.ext.autodoc")
    app.add_directive("api", Api)
    app.connect("autodoc-skip-member", skip)
