"""Numbers in prose: each is a function of its chapter's module ``prose``, and never typed.

A caption has ``{{ name }}`` in the place of a number, a page ``{glue:text}`name```.
"""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from inspect import getmembers, isfunction

from softgrip.errors import UnknownNameError


def words(chapter: int | str) -> dict[str, Callable[[], str]]:
    """Return what makes the text of each number in a chapter's prose, by name."""
    module = import_module(f"book.chapter_{chapter}.prose")
    return {
        name: function
        for name, function in getmembers(module, isfunction)
        if function.__module__ == module.__name__ and not name.startswith("_")
    }


@cache
def word(chapter: int | str, name: str) -> str:
    """Return the text of one number.

    Raises:
        UnknownNameError: If the chapter's prose has no such number; the message lists those it has.
    """
    known = words(chapter)
    if name not in known:
        raise UnknownNameError(f"number in the prose of Chapter {chapter}", name, list(known))
    return known[name]()


def tell(chapter: int) -> None:
    """Make the numbers of a chapter known to its page."""
    from myst_nb import glue  # brings Sphinx, which captions do not need

    for name in words(chapter):
        glue(name, word(chapter, name), display=False)
