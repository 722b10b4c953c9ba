"""MyST as the Markdown that any notebook sets: roles as text and links, boxes and numbers as HTML.

A notebook knows neither roles nor directives, and shows their source. What they say is known when a
page is built: it then stands in the notebook as text.
"""

import re
from collections.abc import Callable, Mapping

from book.build.numbering import dotted
from softgrip.errors import InvalidInputError

ROLE = re.compile(r"(?<![}`])`[^`\n]+`|\{([a-z][a-z:]*)\}`([^`]+)`")
"""A role, or code, in which there is none."""
TITLED = re.compile(r"(.+?)\s*<([^<>]+)>")
"""Of a role: its own words, and what they lead to."""
LABELLED = re.compile(r"(?ms)^\$\$\n(.*?)\n\$\$ \(([\w-]+)\)$")
TARGET = re.compile(r"(?m)^\(([\w-]+)\)=$")
PAGE = re.compile(r"\]\(([\w-]+)\.md(#[\w-]+)?\)")
ADDRESS = re.compile(r'(?<= href=")(?=[\w-]+\.html)')
FENCE = re.compile(r"^(`{3,}|:{3,})(?: *\{([\w-]+)\} *(.*))?$")
OPTION = re.compile(r"^:([\w-]+): *(.*)$")
CELL = "code-cell"
COLOURS = {"warning": "warning", "danger": "danger", "tip": "success", "hint": "success"}
"""Colours of a notebook for boxes; others are blue."""
BOXES = {"admonition", "note", "important", "seealso", "attention", "caution", "error"} | set(
    COLOURS
)

Roles = Mapping[str, Callable[[str, str], str]]
"""What sets a role, from its own words (empty if it has none) and from what it names."""


def with_roles(text: str, roles: Roles) -> str:
    r"""Return a text with its roles set.

    Raises:
        InvalidInputError: If there is a role that none of `roles` sets.

    >>> with_roles("see {doc}`there\n<page>`", {"doc": lambda words, to: f"[{words}]({to}.html)"})
    'see [there](page.html)'
    """

    def set_one(found: re.Match[str]) -> str:
        name, text = found.groups()
        if name is None:
            return found[0]
        if name not in roles:
            raise InvalidInputError("role of a page", expected=f"one of {[*roles]}", got=found[0])
        text = " ".join(text.split())  # a role may be parted by a line's end
        titled = TITLED.fullmatch(text)
        return roles[name](*(titled.groups() if titled else ("", text)))

    return ROLE.sub(set_one, text)


def with_equations(text: str) -> str:
    r"""Return a text whose equations bear the numbers of their labels, and can be linked.

    >>> print(with_equations("$$\nP V = n R T\n$$ (eq-4-3)"))
    <a id="eq-4-3"></a>
    <BLANKLINE>
    $$
    P V = n R T
    \tag{4.3}
    $$
    """

    def numbered(found: re.Match[str]) -> str:
        body, label = found.groups()
        return f'<a id="{label}"></a>\n\n$$\n{body}\n\\tag{{{dotted(label)}}}\n$$'

    return LABELLED.sub(numbered, text)


def with_links(text: str, book: str) -> str:
    """Return a text whose links to pages lead to the built ones.

    Args:
        text: In Markdown.
        book: Address of the built book, with a stroke at its end.

    >>> with_links("[the rig](rig.md#run)", "../")
    '[the rig](../rig.html#run)'
    """
    text = PAGE.sub(lambda found: f"]({book}{found[1]}.html{found[2] or ''})", text)
    return TARGET.sub(r'<a id="\1"></a>', ADDRESS.sub(lambda _: book, text))


def _opened(name: str, title: str, folded: bool) -> tuple[str, str]:
    """Return what begins and ends a box."""
    words = title or name.capitalize()
    if folded:
        return f"<details>\n<summary><b>{words}</b></summary>\n", "\n</details>"
    colour = COLOURS.get(name, "info")
    return f'<div class="alert alert-block alert-{colour}">\n\n**{words}**\n', "\n</div>"


def with_boxes(text: str) -> str:
    r"""Return a text whose boxes are set as HTML; cells stay, and what they stand in is a heading.

    Raises:
        InvalidInputError: If there is a directive that is neither a box nor a cell.

    >>> print(with_boxes(":::{tip} Look\n:class: dropdown\nHere.\n:::"))
    <details>
    <summary><b>Look</b></summary>
    <BLANKLINE>
    Here.
    <BLANKLINE>
    </details>
    """
    lines, made, at = text.split("\n"), [], 0
    while at < len(lines):
        found = FENCE.match(lines[at])
        at += 1
        if found is None or (found[1][0] == ":" and not found[2]):
            made.append(lines[at - 1])
            continue
        fence, name, title = found.groups()
        end = next((k for k in range(at, len(lines)) if lines[k] == fence), len(lines))
        inner = lines[at:end]
        if name not in BOXES:
            if name not in (None, CELL):
                raise InvalidInputError(
                    "directive of a page", expected=f"one of {[*BOXES]}", got=name
                )
            made += [lines[at - 1], *inner, *lines[end : end + 1]]
        else:
            options = {}
            while inner and (option := OPTION.match(inner[0])):
                options[option[1]] = option[2]
                inner.pop(0)
            body = with_boxes("\n".join(inner)).strip("\n")
            holds_cells = any(line.startswith(f"```{{{CELL}}}") for line in inner)
            begin, close = _opened(name, title, "dropdown" in options.get("class", ""))
            # Each cell of a notebook is a document of its own: no box reaches over several.
            made += [f"**{title}**\n", body] if holds_cells else [begin, body, close]
        at = end + 1
    return "\n".join(made)


def plain(text: str, roles: Roles, book: str) -> str:
    """Return the text of a cell as a notebook sets it.

    Args:
        text: In MyST, after `with_boxes`, which reach over cells.
        roles: What sets its roles.
        book: Address of the built book, with a stroke at its end.
    """
    return with_links(with_equations(with_roles(text, roles)), book)
