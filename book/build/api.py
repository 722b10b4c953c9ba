"""The API page: a directive that documents all modules of a folder, from their docstrings."""

from types import UnionType
from typing import Any, ClassVar, TypeVar, get_origin

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config
from sphinx.ext.napoleon.docstring import GoogleDocstring
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


FORM = Config(
    napoleon_use_param=False,  # several names may share a line
    napoleon_use_rtype=False,
    napoleon_custom_sections=[("Attributes", "params_style")],  # else each would stand twice
)


def read_sections(
    _app: Sphinx, what: str, _name: str, _obj: object, _options: object, lines: list[str]
) -> None:
    """Turn the sections of a docstring into fields; a value's text is prose, colons and all."""
    if what not in ("attribute", "data", "property"):
        lines[:] = GoogleDocstring(lines, FORM, what=what).lines()  # type: ignore[arg-type]


def skip(_app: Sphinx, what: str, name: str, found: object, _skip: bool, _: object) -> bool | None:
    """Leave out names of types, which say nothing that their module does not."""
    alias = found is Any or isinstance(found, TypeVar | UnionType) or get_origin(found) is not None
    return True if (what == "module" and alias) or name in INHERITED else None


def know_elsewhere(_app: Sphinx, config: Any) -> None:
    """Let docstrings name what is documented in another project (YAML has no pairs)."""
    others = ("sklearn.exceptions.NotFittedError", "csv.Error")
    config.nitpick_ignore = [("py:exc", name) for name in others]


def setup(app: Sphinx) -> None:
    """Add the directive."""
    app.connect("config-inited", know_elsewhere)
    app.setup_extension("sphinx.ext.autodoc")
    app.add_directive("api", Api)
    app.connect("autodoc-process-docstring", read_sections)
    app.connect("autodoc-skip-member", skip)
