"""Numbers in prose: computed, or those that a claim prints, and never typed.

The module ``prose`` of a page's room (a chapter's, or another by its name) has a table ``WORDS``:
for each name what makes the text. A caption has ``{{ name }}`` in the place of a number, a page
``{glue:text}`name```. What a claim prints is ``{{ @id }}`` in a caption, ``{claim}`id``` in a page.
"""

import os
import re
from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module

from book.companion.claims import printed_text
from book.companion.markdown import in_static_book
from book.companion.verdict import CLOSE
from softgrip.errors import UnknownNameError

USED = "SOFTGRIP_NUMBERS_USED"
"""Variable with the names that the page uses which is built, parted by blanks."""
NAME = re.compile(r"\{glue:text\}`([^`:]+)")
WORDS = {"close": lambda: f"{100 * CLOSE:g}"}
"""Of the pages on the ledger itself, whose room this is."""


def words(page: int | str) -> Mapping[str, Callable[[], str]]:
    """Return what makes the text of each computed number in a page's prose, by name.

    Args:
        page: A chapter's number, or a room of the book, such as "author".
    """
    room = f"chapter_{page}" if str(page).isdigit() else page
    made: Mapping[str, Callable[[], str]] = import_module(f"book.{room}.prose").WORDS
    return made


@cache
def _computed(page: int | str, name: str) -> str:
    known = words(page)
    if name not in known:
        raise UnknownNameError(f"number in the prose of page {page}", name, list(known))
    return known[name]()


def word(page: int | str, name: str) -> str:
    """Return the text of a number by its name, or what a claim prints by ``@`` and its id.

    Raises:
        UnknownNameError: If there is no such number or claim; the message lists those there are.
    """
    return printed_text(name[1:]) if name.startswith("@") else _computed(page, name)


def used(text: str) -> list[str]:
    """Return the names of the numbers that the text of a page uses.

    >>> used("From {glue:text}`low` to {glue:text}`high`, {glue:text}`low` again")
    ['high', 'low']
    """
    return sorted(set(NAME.findall(text)))


def tell(page: int | str) -> None:
    """Make the computed numbers of a room known to the page that is built, of those that it uses.

    A notebook has them in its text.
    """
    if not in_static_book():
        return
    from myst_nb import glue  # brings Sphinx, which captions do not need

    asked = os.environ.get(USED)
    for name in words(page) if asked is None else words(page).keys() & asked.split():
        glue(name, word(page, name), display=False)
