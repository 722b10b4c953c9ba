"""Addresses of the ledger: of a row, and of the rows that a filter leaves."""

import os
from urllib.parse import urlencode

from book.companion.markdown import in_static_book

BOOK = "SOFTGRIP_BOOK_ADDRESS"
"""Variable with the address of the built book, for notebooks: they lie elsewhere."""
PAGE = "ledger.html"
NONE = "none"
"""In an address, the basis of a number that has none."""


def in_book(page: str) -> str:
    """Return the address of a page of the book."""
    return page if in_static_book() else os.environ.get(BOOK, "") + page


def row_address(claim: str) -> str:
    """Return the address of a claim's row.

    >>> row_address("3.4-plateau")
    'ledger.html#claim-3.4-plateau'
    """
    return f"{in_book(PAGE)}#claim-{claim}"


def address(**fields: object) -> str:
    """Return the address of the rows that have all of some fields, by the names of the form's.

    >>> address(place="Table 5.2", outcome="close")
    'ledger.html#place=Table+5.2&outcome=close'
    """
    return f"{in_book(PAGE)}#{urlencode({name: str(value) for name, value in fields.items()})}"
