"""The dissertation's numbered equations: who owns each, who tests it, and how a page tells.

The owner of an equation is the one function, method or class of the package whose docstring bears
the equation's number in its first line, as ``Eq. (3.10)``. Its test bears the number in its name,
as ``eq_3_10``, or in its docstring. The book's own code applies equations and owns none.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from book.build.numbering import number as label_number
from book.build.tracing import ROOT

CHAPTERS = {2: 9, 3: 30, 4: 15, 5: 17, 6: 27}
"""How many equations each chapter numbers."""

NUMBERS = tuple(f"{chapter}.{k + 1}" for chapter, count in CHAPTERS.items() for k in range(count))

MENTION = re.compile(r"Eqs?\. \(\d\.\d+\)(?:(?:,| and|, and) \(\d\.\d+\))*")


@dataclass(frozen=True)
class Place:
    """A function, method or class of the package, or a test.

    Attributes:
        module: With its packages.
        name: With its class, if it has one.
        words: First line of its docstring; empty if it has none.
        numbers: Of the equations that it owns or tests.
    """

    module: str
    name: str
    words: str
    numbers: frozenset[str]

    @property
    def full_name(self) -> str:
        """Module and name."""
        return f"{self.module}.{self.name}"

    @property
    def path(self) -> str:
        """Its module as a path without suffix."""
        return self.module.replace(".", "/")


def mentioned(text: str) -> frozenset[str]:
    """Return the equations that a text names one by one.

    >>> sorted(mentioned("Eq. (3.1) at 0.5 (2.5), then Eq. (6.24) and (6.25)"))
    ['3.1', '6.24', '6.25']
    """
    found = " ".join(MENTION.findall(text))
    return frozenset(re.findall(r"\d\.\d+", found))


@cache
def owners() -> tuple[Place, ...]:
    """Return what owns equations."""
    found = []
    for module, name, doc in documented("softgrip"):
        words = doc.partition("\n")[0]
        if numbers := mentioned(words):
            found.append(Place(module, name, words, numbers))
    return tuple(found)


@cache
def naming_tests() -> tuple[Place, ...]:
    """Return the tests that name equations."""
    found = []
    for module, name, doc in documented("tests"):
        named = {f"{c}.{k}" for c, k in re.findall(r"eq_(\d)_(\d+)", name)}
        if name.startswith("test_") and (numbers := mentioned(doc) | named):
            found.append(Place(module, name, doc.partition("\n")[0], numbers))
    return tuple(found)


def documented(folder: str) -> Iterator[tuple[str, str, str]]:
    """Yield module, name and docstring of the public functions, methods and classes of a folder."""
    for file in sorted((ROOT / folder).rglob("*.py")):
        module = ".".join(file.relative_to(ROOT).with_suffix("").parts)
        tree = ast.parse(file.read_text(encoding="utf-8"))
        for node in tree.body:
            for name, item in _definitions(node):
                if not item.name.startswith("_"):
                    yield module, name, ast.get_docstring(item) or ""


def _definitions(
    node: ast.stmt, prefix: str = ""
) -> Iterator[tuple[str, ast.FunctionDef | ast.ClassDef]]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        yield prefix + node.name, node
    if isinstance(node, ast.ClassDef):
        for inner in node.body:
            yield from _definitions(inner, f"{node.name}.")


@cache
def pairs() -> dict[str, tuple[Place, Place]]:
    """Return owner and test of each equation that has both, by its number.

    Of several tests it is one in the file that mirrors the owner's, or else in its folder.
    """
    found = {}
    for number in NUMBERS:
        owner = next((place for place in owners() if number in place.numbers), None)
        candidates = [place for place in naming_tests() if number in place.numbers]
        if owner and candidates:
            _, *folders, last = owner.module.split(".")
            folder = ".".join(["tests", *folders, ""])
            test = max(
                candidates,
                key=lambda place: (
                    place.module == f"{folder}test_{last}",
                    place.module.startswith(folder),
                ),
            )
            found[number] = owner, test
    return found


class Equations(SphinxDirective):
    """``{equations}`` with a chapter: its equations, what they are, who owns and who tests them."""

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {}

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        lines = [".. list-table::", "   :class: equations", "   :header-rows: 1"]
        lines += ["   :widths: 13 37 22 28", ""]
        rows = [("Equation", "What the code does", "Code", "Test")]
        for number, (owner, test) in pairs().items():
            if number.startswith(self.arguments[0]):
                code = owner.full_name.removeprefix("softgrip.")
                rows.append(
                    (
                        f":eq:`eq-{number.replace('.', '-')}`",
                        prose(owner.words),
                        f":py:obj:`{code} <{owner.full_name}>`",
                        f":py:obj:`{test.path}.py::{test.name} <{test.full_name}>`",
                    )
                )
        for first, *rest in rows:
            lines += [f"   * - {first}", *(f"     - {cell}" for cell in rest)]
        for folder in ("softgrip", "tests"):
            for file in (ROOT / folder).rglob("*.py"):
                self.env.note_dependency(str(file))
        return parsed(self, lines)


def listed_tests() -> list[str]:
    """Return, as reStructuredText, the tests that `Equations` names and what they say."""
    lines = []
    for test in sorted({test for _, test in pairs().values()}, key=lambda test: test.full_name):
        lines += [f".. py:function:: {test.name}", f"   :module: {test.module}"]
        lines += ["   :no-index-entry:", "   :no-contents-entry:", ""]
        lines += [f"   {prose(test.words)}", ""]
    return lines


def prose(words: str) -> str:
    r"""Return a docstring's line as reStructuredText in which nothing but code is marked up.

    >>> prose("Return the ``|W|`` of `box`, x_1.")
    'Return the ``|W|`` of ``box``, x\\_1.'
    """
    parts = re.split(r"`+([^`]+)`+", words)
    parts[::2] = [re.sub(r"([*|_\\])", r"\\\1", part) for part in parts[::2]]
    parts[1::2] = [f"``{code}``" for code in parts[1::2]]
    return "".join(parts)


def parsed(directive: SphinxDirective, lines: list[str]) -> list[nodes.Node]:
    """Return what reStructuredText says, for a directive in a page of MyST."""
    place = nodes.container()
    content = StringList(["```{eval-rst}", *lines, "```"], directive.name)
    directive.state.nested_parse(content, 0, place)
    return [*place.children]


def find_changed_links(_app: Sphinx, env: Any) -> list[str]:
    """Have the pages that set equations written anew when an owner or a test has another place."""
    places = {number: [p.full_name for p in pair] for number, pair in pairs().items()}
    if getattr(env, "equation_places", None) == places:
        return []
    env.equation_places = places
    return sorted({equation for equation, _ in env.get_domain("math").equations.values()})


def add_links(app: Sphinx, doctree: nodes.document, page: str) -> None:
    """Put links to its owner's source and to its test's under each equation."""
    if app.builder.format != "html":
        return
    for block in list(doctree.findall(nodes.math_block)):
        at = label_number(block.get("label") or "")
        pair = pairs().get(".".join(map(str, at or ())))
        if pair is None:
            continue
        links = nodes.paragraph(classes=["equation-links"])
        for word, place in zip(("code", "test"), pair, strict=True):
            uri = f"{app.builder.get_relative_uri(page, f'api/_modules/{place.path}')}#{place.name}"
            links += nodes.reference("", word, refuri=uri, internal=True, reftitle=place.full_name)
            links += nodes.Text(" ")
        block.parent.insert(block.parent.index(block) + 1, links)


def setup(app: Sphinx) -> None:
    """Add the directives and connect the links to the stages of a build."""
    app.add_directive("equations", Equations)
    app.connect("env-get-updated", find_changed_links)
    app.connect("doctree-resolved", add_links)
