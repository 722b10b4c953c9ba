"""Numbers in prose: computed, or those that a claim prints, and never typed.

A chapter's module ``prose`` has a table ``WORDS``: for each name what makes the text. A caption has
``{{ name }}`` in the place of a number, a page ``{glue:text}`name```. What a claim prints is
``{{ @id }}`` in a caption, ``{claim}`id``` in a page.
"""

from collections.abc import Callable, Mapping
from functools import cache
from importlib import import_module

from book.companion.claims import printed_text
from softgrip.errors import UnknownNameError


def words(chapter: int | str) -> Mapping[str, Callable[[], str]]:
    """Return what makes the text of each computed number in a chapter's prose, by name."""
    made: Mapping[str, Callable[[], str]] = import_module(f"book.chapter_{chapter}.prose").WORDS
    return made


@cache
def _computed(chapter: int | str, name: str) -> str:
    known = words(chapter)
    if name not in known:
        raise UnknownNameError(f"number in the prose of Chapter {chapter}", name, list(known))
    return known[name]()


def word(chapter: int | str, name: str) -> str:
    """Return the text of a number by its name, or what a claim prints by ``@`` and its id.

    Raises:
        UnknownNameError: If there is no such number or claim; the message lists those there are.
    """
    return printed_text(name[1:]) if name.startswith("@") else _computed(chapter, name)


def tell(chapter: int) -> None:
    """Make the computed numbers of a chapter known to its page."""
    from myst_nb import glue  # brings Sphinx, which captions do not need

    for name in words(chapter):
        glue(name, word(chapter, name), display=False)
