"""The reference: every module from its docstrings, with its source, as a project of its own.

It takes as long to read as all other pages, and hangs on the code alone: apart from the book it is
made while the pages run, and not again when a page's text changes. The book links into it by its
inventory (`book.build.api`).
"""

import hashlib
import subprocess
import sys
from pathlib import Path
from types import UnionType
from typing import Any, TypeVar, get_origin

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.ext.napoleon import Config
from sphinx.ext.napoleon.docstring import GoogleDocstring
from sphinx.pycode import ModuleAnalyzer

from book.build import equations
from book.build.tracing import ROOT, digest

FOLDER = "api"
"""Below the pages of the book."""
INVENTORY = "objects.inv"
STAMP = "sources.sha256"
BOOK = ROOT / "book"
STATIC = [BOOK / "_static" / name for name in ("softgrip.css", "scrolling.js", "search_key.js")]
TEMPLATE = BOOK / "_templates" / "layout.html"
"""What its pages share with those of the book."""
CODE = ("softgrip", "book", "tests")
MADE = {"_build", "_vendor"}
"""Folders among them that a build makes."""
INHERITED = {"set_score_request"}
"""What scikit-learn adds to a regressor, without a docstring that Sphinx could read."""
ELSEWHERE = ("sklearn.exceptions.NotFittedError", "csv.Error", "sphinx.errors.ExtensionError")
"""What docstrings name and another project documents."""

SETTINGS: dict[str, Any] = {
    "project": "softgrip",
    "html_title": "softgrip: the reference",
    "extensions": [
        "sphinx.ext.autodoc",
        "sphinx.ext.viewcode",
        "book.build.accessible",
        "book.build.light",
        "book.build.reference",
    ],
    "nitpicky": True,
    "nitpick_ignore": [("py:exc", name) for name in ELSEWHERE],
    "autodoc_typehints": "none",
    "autodoc_member_order": "bysource",
    "toc_object_entries": False,  # else each of hundreds of source pages copies thousands of them
    "html_theme": "sphinx_book_theme",
    "html_theme_options": {"navbar_persistent": [], "use_download_button": False},
    "html_context": {"default_mode": "auto"},  # else the theme's script complains of none
    "html_static_path": [str(file) for file in STATIC],
    "html_css_files": [STATIC[0].name],
    "html_js_files": [file.name for file in STATIC[1:]],
    "templates_path": [str(TEMPLATE.parent)],
    "html_copy_source": False,
    "html_sidebars": {"_modules/**": []},  # a tree of all pages for each of hundreds takes as long
}


def packages() -> list[str]:
    """Return all packages, each before what is in it.

    >>> packages()[:3]
    ['book.author', 'book.beyond', 'book.beyond.delay']
    """
    found = (file.parent for top in CODE[:2] for file in (ROOT / top).rglob("__init__.py"))
    return sorted({".".join(folder.relative_to(ROOT).parts) for folder in found} - {"book"})


def modules(package: str) -> list[str]:
    """Return the modules of a package, without those below its sub-packages.

    >>> modules("softgrip")[:3]
    ['softgrip.arrays', 'softgrip.checks', 'softgrip.errors']
    """
    folder = ROOT.joinpath(*package.split("."))
    names = sorted(file.stem for file in folder.glob("*.py"))
    return [f"{package}.{name}" for name in names if not name.startswith("__")]


def write_pages(folder: Path) -> None:
    """Write a page for each package, one for the tests of equations, and one that leads to all."""
    pages = {"tests": ["Tests of equations", "", *equations.listed_tests()]}
    for package in packages():
        lines = [package, "", f".. automodule:: {package}", ""]
        for name in modules(package):
            lines += [name, "-" * len(name), "", f".. automodule:: {name}", "   :members:", ""]
        pages[package] = lines
    names = [f"   {name}" for name in pages if name != "tests"]
    pages["index"] = [
        "The reference",
        "",
        ".. toctree::",
        "   :titlesonly:",
        "",
        *names,
        "   tests",
    ]
    folder.mkdir(parents=True, exist_ok=True)
    for file in folder.glob("*.rst"):
        if file.stem not in pages:
            file.unlink()
    for name, (title, *lines) in pages.items():
        text = "\n".join([title, "=" * len(title), *lines, ""])
        file = folder / f"{name}.rst"
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")


def sources() -> str:
    """Return a digest of what the reference is made of."""
    files = sorted(file for top in CODE for file in (ROOT / top).rglob("*.py"))
    files = [file for file in files if not MADE & {*file.relative_to(ROOT).parts}]
    shared = [*STATIC, *sorted(TEMPLATE.parent.glob("*.html"))]
    lines = [f"{file.relative_to(ROOT)} {digest(file)}" for file in [*files, *shared]]
    lines += [sys.version, digest(ROOT / "environment.lock")]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


class Reference:
    """The reference of a book, made by a process beside its own.

    Args:
        pages: Folder of the book's pages.
    """

    def __init__(self, pages: Path) -> None:
        self.folder, self.sources = pages / FOLDER, sources()
        self.stamp = self.folder / STAMP
        kept = self.stamp.is_file() and self.stamp.read_text() == self.sources
        command = [sys.executable, "-m", "book.build.reference", str(self.folder)]
        self.process = None if kept else subprocess.Popen(command, cwd=ROOT)

    def wait(self) -> Path:
        """Wait until it is made, and return its inventory.

        Raises:
            sphinx.errors.ExtensionError: If it cannot be made; why was printed.
        """
        if self.process:
            if self.process.wait():
                raise ExtensionError("The reference could not be made: see above.")
            self.stamp.write_text(self.sources)
            self.process = None
        return self.folder / INVENTORY


def build(folder: Path) -> int:
    """Make the reference, and return the exit code of Sphinx."""
    aside = folder.parent.parent / "reference"
    write_pages(aside)
    app = Sphinx(
        aside, None, folder, aside / "doctrees", "html",
        confoverrides=SETTINGS, status=None, warningiserror=True, keep_going=True,
    )  # fmt: skip
    app.build()
    return app.statuscode


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


def source_of_tests(_app: Sphinx, module: str) -> tuple[str, dict[str, Any]] | None:
    """Give the source pages a test module without importing it."""
    if not module.startswith("tests."):
        return None
    file = ROOT.joinpath(*module.split(".")).with_suffix(".py")
    analyzer = ModuleAnalyzer.for_file(str(file), module)
    return analyzer.code, analyzer.find_tags()


def home(_app: Sphinx, module: str | None, _name: str) -> str | None:
    """Say that all is defined where it is listed: properties too, which know no module."""
    return module


def lead_back(
    _app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: Any
) -> None:
    """Lead from each page to the book, and to its search."""
    context["theme_logo"] = {"text": "softgrip", "link": context["pathto"]("../index.html", 1)}
    context["search_address"] = context["pathto"]("../search.html", 1)


def remove_former_modules(app: Sphinx, _error: Exception | None) -> None:
    """Remove pages of what is no more: a build adds, but never takes away."""
    for page in Path(app.outdir).glob("*.html"):
        if page.stem not in {*app.env.found_docs, "genindex", "py-modindex"}:
            page.unlink()
    pages = Path(app.outdir) / "_modules"
    for page in [page for top in CODE for page in (pages / top).rglob("*.html")]:
        source = ROOT / page.relative_to(pages).with_suffix("")
        if not (source.is_dir() or source.with_suffix(".py").is_file()):
            page.unlink()


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the parts to the stages of a build of the reference."""
    app.connect("autodoc-process-docstring", read_sections)
    app.connect("autodoc-skip-member", skip)
    app.connect("viewcode-find-source", source_of_tests)
    app.connect("viewcode-follow-imported", home)
    app.connect("html-page-context", lead_back)
    app.connect("build-finished", remove_former_modules)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


if __name__ == "__main__":
    sys.exit(build(Path(sys.argv[1])))
