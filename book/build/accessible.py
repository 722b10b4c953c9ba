"""Pages that can be heard and tabbed through: what the HTML of theme and Sphinx lacks is added."""

import re
from typing import Any

from sphinx.application import Sphinx

TOGGLE = re.compile(
    r'(<li class="toctree[^>]*><a [^>]*>((?:(?!</a>).)*)</a><details[^>]*><summary)>', re.DOTALL
)
"""What folds the pages below one in the sidebar, after the link to that one."""
TAG = re.compile("<[^>]*>")

MENDED = tuple(
    (re.compile(found), put)
    for found, put in (
        ('<summary aria-label="Toggle hidden content">', "<summary>"),
        # Three icons, of which one is seen, are not the name of the button that they are in.
        (r'(<i class="theme-switch [^>]*) title="[^"]*"', r"\1"),
        # The link to the front page stood in no part of the page.
        ('<div id="pst-primary-sidebar"', r'\g<0> role="complementary" aria-label="The book"'),
        # Over the column that names the rows stands nothing, and that is no heading.
        (r"<th\b([^>]*)>(?:<p>)?\s*(?:</p>)?</th>", r"<td\1></td>"),
        # A list of references has items; the role of an entry was taken out of the standard.
        ('role="doc-biblioentry"', 'role="listitem"'),
    )
)


def accessible(content: str) -> str:
    """Return the content of a page with the names and roles that it lacks.

    >>> accessible('<tr><th class="head"><p></p></th><th>1</th></tr>')
    '<tr><td class="head"></td><th>1</th></tr>'
    >>> accessible('<li class="toctree-l1"><a href="2.html">Touch</a><details><summary>')
    '<li class="toctree-l1"><a href="2.html">Touch</a><details><summary aria-label="Below: Touch">'
    """
    for found, put in MENDED:
        content = found.sub(put, content)
    return TOGGLE.sub(
        lambda it: f'{it[1]} aria-label="Below: {TAG.sub("", it[2]).strip()}">', content
    )


def offer(_app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: Any) -> None:
    """Give the template of pages what mends their content."""
    context["accessible"] = accessible


def setup(app: Sphinx) -> None:
    """Connect it to the writing of pages, whose template is that of the book."""
    app.connect("html-page-context", offer)
