"""Figures, tables and equations bear the dissertation's numbers.

A label such as ``fig-5-1``, ``tab-5-2`` or ``eq-5-8`` carries the number; those of our own have
letters in its place (``fig-5-a``). So a reader with the dissertation open beside the book finds
each exhibit under the number that is printed there, and a gap in the numbers is a true one.
"""

import re
from typing import Any

from sphinx.application import Sphinx

from softgrip.errors import InvalidInputError

LABEL = re.compile(r"^(?:fig|tab|eq)-(\d)-(\d+|[a-z])$")


def number(label: str) -> tuple[int | str, ...] | None:
    """Return the number that a label carries, or None.

    >>> number("fig-5-1"), number("tab-5-a"), number("somewhere-else")
    ((5, 1), (5, 'A'), None)
    """
    match = LABEL.match(label)
    if match is None:
        return None
    chapter, item = match.groups()
    return int(chapter), int(item) if item.isdigit() else item.upper()


def dotted(label: str) -> str:
    """Return the number that a label carries as it is printed; another label as it is.

    >>> dotted("eq-5-14"), dotted("tab-5-a"), dotted("somewhere-else")
    ('5.14', '5.A', 'somewhere-else')
    """
    return ".".join(map(str, number(label) or (label,)))


def assign(_app: Sphinx, env: Any) -> list[str]:
    """Replace Sphinx's counts by the numbers that the labels carry."""
    labels = {
        (doc, node_id): name for name, (doc, node_id) in env.domaindata["std"]["anonlabels"].items()
    }
    changed = []
    for doc, by_kind in env.toc_fignumbers.items():
        before = repr(by_kind)
        for by_id in by_kind.values():
            for node_id in by_id:
                label = labels.get((doc, node_id), node_id.removeprefix("equation-"))
                given = number(label)
                if given is None:
                    raise InvalidInputError(
                        f"label of a numbered item in {doc}",
                        expected="fig-, tab- or eq- with a chapter and a number or letter",
                        got=label,
                    )
                by_id[node_id] = given
        if repr(by_kind) != before:
            changed.append(doc)
    return changed


def setup(app: Sphinx) -> None:
    """Run after Sphinx's own numbering, which listens to the same event."""
    app.connect("env-get-updated", assign, priority=900)
